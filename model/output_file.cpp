#include "model/output_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <locale>
#include <stdexcept>
#include <string>
#include <system_error>

namespace halyard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

/// The file that a rename may replace: a rename would otherwise put a plain file in place of a link or a device.
fs::path replaceable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  if (fs::is_directory(status)) fail(path, "cannot be written: it is a folder; give a file name");
  if (!fs::is_regular_file(status)) fail(path, "cannot be written: it is not a plain file");
  fs::path target = fs::canonical(path, error);
  if (error) fail(path, "cannot be written: " + error.message());
  return target;
}

/// In the same folder, so that the rename stays within one file system; unique among processes and threads.
fs::path sibling(fs::path path) {
  static std::atomic<unsigned> count{0};
  path += ".part-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return path;
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : path_(replaceable(path)), temporary_(sibling(path_)) {
  std::error_code error;
  if (path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
  if (error) fail(path_, "cannot create its folder: " + error.message());
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail(path_, "cannot be written: " + reason(errno));
  stream_.imbue(std::locale::classic());
}

OutputFile::~OutputFile() {
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void OutputFile::commit() {
  const bool failed_earlier = !stream_;
  errno = 0;
  stream_.close();
  if (failed_earlier) fail(path_, "not written: a write failed; is the disk full?");
  if (!stream_) fail(path_, "not written: " + reason(errno));
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) fail(path_, "not written: " + error.message());
}

void write_file_whole(const fs::path& path, std::string_view content) {
  OutputFile file(path);
  file.stream() << content;
  file.commit();
}

}  // namespace halyard
