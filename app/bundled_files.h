#pragma once
/// Files that come with the program: the examples of its installation, or of the source tree that it was built from.

#include <filesystem>
#include <string>

namespace halyard {

/// The folder of the examples: `given`, or the program's own if `given` is empty. Throws InputError, naming the
/// command, if there is none.
std::filesystem::path examples_folder(const std::filesystem::path& given, const std::string& command);

/// Default folder of recordings of real rigs: shared/data beside the source tree. It need not exist.
std::filesystem::path default_recordings_folder();

}  // namespace halyard
