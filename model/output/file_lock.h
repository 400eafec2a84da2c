#pragma once

#include <filesystem>

#include "model/output/descriptor.h"
#include "model/output/unfinished.h"

namespace halyard {

/// Keeps other runs off a single output file, for the life of the object: FolderLock does so for a folder. The lock is
/// that of the operating system on the file .halyard.NAME.lock beside the output (locked_file.h). It is removed at the
/// end; a run that was killed leaves it behind without a lock, and the next run into the same output removes it.
class FileLock {
 public:
  /// Makes missing folders; those that are still empty at the end are removed. A link to a file is followed.
  /// Throws InputError if another run holds the file, or if its folder cannot be written.
  explicit FileLock(const std::filesystem::path& file);

 private:
  Descriptor file_;
  Unfinished made_;  ///< after file_: the lock is removed while it is held
};

}  // namespace halyard
