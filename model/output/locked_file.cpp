#include "model/output/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>

namespace halyard {
namespace {

/// Whether the path still names the open file: the run that held the lock before removes its file.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat opened, named;
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

Descriptor locked_file(const std::filesystem::path& path) {
  for (;;) {  // until the file is not one that another run removed meanwhile
    Descriptor file(path, O_RDWR | O_CREAT);
    if (!file) return file;
    if (::flock(*file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      file.close();
      errno = EWOULDBLOCK;
      return file;
    }
    if (is_named(*file, path)) return file;
  }
}

}  // namespace halyard
