#pragma once

#include <filesystem>
#include <string>

#include "model/output/descriptor.h"
#include "model/output/unfinished.h"

namespace halyard {

/// Keeps other runs out of the folder of a run's outputs, for the life of the object. The lock is that of the operating
/// system on the file .halyard.lock in the folder (flock), so a run that was killed leaves no lock behind, only the
/// file. Where the file system has no locks, nothing is kept out.
///
/// part: runs that compute different parts of one result may share a folder; each keeps out other runs of its part. A
/// run of kAllParts and one of a part keep out each other. Runs without a part keep out each other alone: what submits
/// the parts may do so while they run.
class FolderLock {
 public:
  static constexpr const char* kAllParts = "all";

  /// Makes missing folders; those that are still empty at the end are removed.
  /// Throws InputError if another run holds the folder, or if it cannot be written.
  explicit FolderLock(const std::filesystem::path& folder, const std::string& part = "");

 private:
  Descriptor file_;
  Unfinished made_;  ///< after file_: the file is removed while it is locked
};

/// Whether a run holds the lock of this folder, or of a part of it.
bool is_in_use(const std::filesystem::path& folder);

}  // namespace halyard
