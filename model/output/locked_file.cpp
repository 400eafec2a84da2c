#include "model/output/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace halyard {
namespace {

/// Whether the path still names the open file: the run that held the lock before removes its file.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// Tries for some milliseconds: a question whether a file is locked holds the lock for an instant.
bool lock(int file) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
  }
  return false;
}

}  // namespace

Descriptor locked_file(const std::filesystem::path& path) {
  for (;;) {  // until the file is not one that another run removed meanwhile
    Descriptor file(path, O_RDWR | O_CREAT);
    if (!file) return file;
    if (!lock(*file)) {
      file.close();
      errno = EWOULDBLOCK;
      return file;
    }
    if (is_named(*file, path)) return file;
  }
}

}  // namespace halyard
