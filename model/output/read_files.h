#pragma once
/// The models, scenarios, logs and modules that this process has read. A command does not replace them by its outputs.

#include <filesystem>

namespace halyard {

/// May be called by several threads.
void note_read(const std::filesystem::path& path);

/// True for the same file under any name.
bool was_read(const std::filesystem::path& path);

}  // namespace halyard
