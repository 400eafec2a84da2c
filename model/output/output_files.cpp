#include "model/output/output_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

#include "model/output/descriptor.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

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

/// ".part-HOST-N-": N is the number of the space in which process numbers count, such as a container's. Machines that
/// share a folder do not know each other's processes.
const std::string& part_mark() {
  static const std::string mark = [] {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    struct stat processes {};
    ::stat("/proc/self/ns/pid", &processes);
    return ".part-" + std::string(host) + "-" + std::to_string(processes.st_ino) + "-";
  }();
  return mark;
}

/// In the same folder, so that the rename stays within one file system; unique among machines, processes and threads.
fs::path sibling(fs::path path) {
  static std::atomic<unsigned> count{0};
  path += part_mark() + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return path;
}

/// The process that a sibling() of this machine belongs to, if the name is of one.
std::optional<pid_t> owner_of(const std::string& name) {
  const std::size_t at = name.rfind(part_mark());
  if (at == name.npos) return std::nullopt;
  const char *begin = name.data() + at + part_mark().size(), *end = name.data() + name.size();
  pid_t owner = 0;
  unsigned count = 0;
  const auto [dash, no_owner] = std::from_chars(begin, end, owner);
  if (no_owner != std::errc() || dash == end || *dash != '-' || owner <= 0) return std::nullopt;
  const auto [rest, no_count] = std::from_chars(dash + 1, end, count);
  return no_count == std::errc() && rest == end ? std::optional(owner) : std::nullopt;
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = ::write(file, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Where a file is; "." for a name alone.
fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Onto the disk: a crash of the machine must not leave an empty file under the new name. Some file systems cannot.
bool sync(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == EROFS; }

}  // namespace

void OutputFiles::add(const fs::path& path, std::string_view content) {
  add_in_parts(path, [content](const Append& append) { append(content); });
}

void OutputFiles::add_in_parts(const fs::path& path, const std::function<void(const Append&)>& write) {
  const fs::path target = replaceable(path);
  try {
    unfinished_.create_folders(target.parent_path());
  } catch (const fs::filesystem_error& error) {
    fail(path, "cannot create its folder: " + error.code().message());
  }
  if (files_.empty() || folder_of(files_.back().path) != folder_of(target)) remove_leftovers(folder_of(target));
  const fs::path temporary = sibling(target);
  unfinished_.add(temporary);
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL);
  if (!file) fail(path, "cannot be written: " + reason(errno));
  const auto check = [&path](bool written) {
    if (!written) fail(path, "not written: " + reason(errno));
  };
  write([&](std::string_view part) { check(write_all(*file, part)); });
  check(sync(*file) && file.close());
  files_.push_back({target, temporary});
}

std::vector<fs::path> OutputFiles::paths() const {
  std::vector<fs::path> paths;
  for (const File& f : files_) paths.push_back(f.path);
  return paths;
}

/// Returns 0, or the error number.
int OutputFiles::give_name(File& f) {
  std::error_code ignored;
  if (fs::is_directory(f.path, ignored)) return EISDIR;
  const char *from = f.temporary.c_str(), *to = f.path.c_str();
  f.exchanged = ::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_EXCHANGE) == 0;
  if (f.exchanged) return 0;
  f.replaced = fs::exists(f.path, ignored);
  return ::rename(from, to) == 0 ? 0 : errno;
}

void OutputFiles::take_back(const File& f) {
  if (f.replaced) return;
  const unsigned flags = f.exchanged ? RENAME_EXCHANGE : 0;
  ::renameat2(AT_FDCWD, f.path.c_str(), AT_FDCWD, f.temporary.c_str(), flags);
}

void OutputFiles::give_names() {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const int error = give_name(files_[i]);
    if (error == 0) continue;
    for (std::size_t k = 0; k < i; ++k) take_back(files_[k]);
    fail(files_[i].path, "not written: " + reason(error));
  }
  std::error_code ignored;
  for (const File& f : files_)
    if (f.exchanged) fs::remove(f.temporary, ignored);
  for (const fs::path& path : obsolete_)
    if (std::ranges::none_of(files_, [&](const File& f) { return fs::equivalent(f.path, path, ignored); }))
      fs::remove(path, ignored);
}

void OutputFiles::commit() {
  unfinished_.finish([this] { give_names(); });
  std::set<fs::path> folders;
  for (const File& f : files_) folders.insert(folder_of(f.path));
  for (const fs::path& path : folders)
    if (const Descriptor folder(path, O_RDONLY | O_DIRECTORY); folder) sync(*folder);
}

void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<pid_t> owner = owner_of(entry.path().filename().string());
    if (owner && ::kill(*owner, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

void write_file_whole(const fs::path& path, std::string_view content) {
  OutputFiles files;
  files.add(path, content);
  files.commit();
}

}  // namespace halyard
