#include "model/output/file_lock.h"

#include <cerrno>
#include <string>
#include <system_error>

#include "model/input_error.h"
#include "model/output/locked_file.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_file(const fs::path& file, const std::string& why) {
  throw InputError("--out " + in_quotes(file.string()) + ": " + why + "give another file name");
}

/// Beside the file that a link leads to.
fs::path path_of_file_lock(const fs::path& file) {
  std::error_code error;
  const fs::path target = fs::canonical(file, error);  // of a file that exists
  const fs::path& output = error ? file : target;
  return output.parent_path() / (".halyard." + output.filename().string() + ".lock");
}

}  // namespace

FileLock::FileLock(const fs::path& file) {
  try {
    made_.create_folders(file.parent_path());
  } catch (const fs::filesystem_error& error) {
    refuse_file(file, "cannot be written: " + error.code().message() + "; ");
  }
  const fs::path path = path_of_file_lock(file);
  file_ = locked_file(path);
  if (!file_ && errno == EWOULDBLOCK) refuse_file(file, "another run writes this file; wait for its end, or ");
  if (!file_) refuse_file(file, "cannot be written: " + reason(errno) + "; ");
  made_.add(path);
}

}  // namespace halyard
