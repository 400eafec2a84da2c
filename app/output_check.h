#pragma once
/// Checks, before long computations, that the results can be written.

#include <filesystem>
#include <memory>
#include <string>

#include "model/output/file_lock.h"
#include "model/output/folder_lock.h"
#include "model/output/output_files.h"

namespace halyard {

/// Locks a file for the output of a command, and makes its folder if it is missing. Removes what a killed run left
/// beside the file. Throws InputError if another run writes it, and for an empty path, a folder, a parent that is a
/// file, or one without permission to write.
[[nodiscard]] std::unique_ptr<FileLock> lock_output_file(const std::filesystem::path& path);

/// Throws InputError if `out` is a file that the command has read, because writing would replace it.
void check_not_input(const std::filesystem::path& out);

/// Gives the outputs their names (OutputFiles::commit). Throws InputError instead if one would replace an input.
void commit_outputs(OutputFiles& files);

/// Locks a folder for the outputs of a command, and makes it if it is missing. Throws InputError if another run writes
/// into it, or unless files can be written into it. part: see FolderLock.
[[nodiscard]] std::unique_ptr<FolderLock> lock_output_folder(const std::filesystem::path& path,
                                                             const std::string& part = "");

}  // namespace halyard
