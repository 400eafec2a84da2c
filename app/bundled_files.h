#pragma once
/// What comes with the program: the examples, of its installation or of the source tree that it was built from.

#include <filesystem>
#include <string>

namespace halyard {

/// The folder of the examples: `given`, or if that is empty the program's own. Throws InputError, for the command
/// named, if there is none.
std::filesystem::path examples_folder(const std::filesystem::path& given, const std::string& command);

/// Where recordings of real rigs are looked for: shared/data beside the source tree. It need not exist.
std::filesystem::path default_recordings_folder();

}  // namespace halyard
