#pragma once

#include <filesystem>

namespace halyard {

/// halyard check: validates a model, scenario or sweep file and prints what it is. Throws InputError if it is invalid.
void run_check(const std::filesystem::path& file);

}  // namespace halyard
