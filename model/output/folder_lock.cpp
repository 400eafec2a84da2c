#include "model/output/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "model/input_error.h"

namespace halyard {
namespace {

/// Whether the path still names the open file: the run that held the lock before removes its file.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

[[noreturn]] void refuse(const std::filesystem::path& folder, int error) {
  throw InputError("--out " + in_quotes(folder.string()) +
                   ": cannot be written: " + std::generic_category().message(error) + "; give another folder");
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& part) {
  try {
    made_.create_folders(folder);
  } catch (const std::filesystem::filesystem_error& error) {
    refuse(folder, error.code().value());
  }
  const std::filesystem::path path = folder / (".halyard" + (part.empty() ? "" : "-" + part) + ".lock");
  for (;;) {  // until the file is not one that another run removed meanwhile
    file_ = Descriptor(path, O_RDWR | O_CREAT);
    if (!file_) refuse(folder, errno);
    if (::flock(*file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw InputError("--out " + in_quotes(folder.string()) +
                       ": another run writes into this folder; wait for its end, or give another folder");
    if (is_named(*file_, path)) break;
  }
  made_.add(path);
}

}  // namespace halyard
