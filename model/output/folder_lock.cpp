#include "model/output/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

#include "model/input_error.h"
#include "model/output/locked_file.h"

namespace halyard {
namespace {

std::filesystem::path lock_path(const std::filesystem::path& folder, const std::string& part) {
  return folder / (".halyard" + (part.empty() ? "" : "-" + part) + ".lock");
}

bool is_held(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  return file && ::flock(*file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// Whether a run holds the lock of a part, but for this one.
bool any_part_is_held(const std::filesystem::path& folder, const std::filesystem::path& but = {}) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_of_part = name.starts_with(".halyard-") && name.ends_with(".lock") && name != but.filename();
    if (is_of_part && is_held(entry.path())) return true;
  }
  return false;
}

/// Whether a run of all parts goes on beside one of a part.
bool is_computed_twice(const std::filesystem::path& folder, const std::string& part) {
  const std::filesystem::path all = lock_path(folder, FolderLock::kAllParts);
  if (part.empty()) return false;
  return part == FolderLock::kAllParts ? any_part_is_held(folder, all) : is_held(all);
}

[[noreturn]] void refuse_shared(const std::filesystem::path& folder) {
  throw InputError("--out " + in_quotes(folder.string()) +
                   ": another run writes into this folder; wait for its end, or give another folder");
}

[[noreturn]] void refuse(const std::filesystem::path& folder, int error) {
  throw InputError("--out " + in_quotes(folder.string()) + ": cannot be written: " + reason(error) +
                   "; give another folder");
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& part) {
  try {
    made_.create_folders(folder);
  } catch (const std::filesystem::filesystem_error& error) {
    refuse(folder, error.code().value());
  }
  const std::filesystem::path path = lock_path(folder, part);
  file_ = locked_file(path);
  if (!file_ && errno == EWOULDBLOCK) refuse_shared(folder);
  if (!file_) refuse(folder, errno);
  made_.add(path);
  // Both look after they hold their own: at most one goes on.
  if (is_computed_twice(folder, part)) refuse_shared(folder);
}

bool is_in_use(const std::filesystem::path& folder) {
  return is_held(lock_path(folder, "")) || any_part_is_held(folder);
}

}  // namespace halyard
