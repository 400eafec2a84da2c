#include "app/output_check.h"

#include <unistd.h>

#include <string>
#include <system_error>

#include "model/input_error.h"
#include "model/output/read_files.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError("--out " + in_quotes(path.string()) + ": " + what);
}

/// Unless files can be written into that folder, which need not exist yet.
void check_output_folder(const fs::path& path) {
  if (path.empty()) fail(path, "is empty; give a path");
  std::error_code error;
  // Missing folders are created: the nearest one that exists decides.
  fs::path existing = fs::absolute(path, error);
  while (!fs::exists(existing, error) && existing.has_parent_path() && existing != existing.parent_path()) {
    existing = existing.parent_path();
  }
  if (!fs::is_directory(existing, error))
    fail(path, in_quotes(existing.string()) + " is not a folder; give another path");
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    fail(path, "no permission to write in " + in_quotes(existing.string()) + "; give another path");
  }
}

}  // namespace

std::unique_ptr<FolderLock> lock_output_folder(const fs::path& path, const std::string& part) {
  check_output_folder(path);
  auto lock = std::make_unique<FolderLock>(path, part);
  remove_leftovers(path);
  return lock;
}

std::unique_ptr<FileLock> lock_output_file(const fs::path& path) {
  if (path.empty()) fail(path, "is empty; give a file name");
  std::error_code error;
  if (fs::is_directory(path, error) || !path.has_filename()) fail(path, "is a folder; give a file name");
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    fail(path, "is no plain file; give another file name");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  check_output_folder(folder);
  auto lock = std::make_unique<FileLock>(path);
  remove_leftovers(folder);
  return lock;
}

void check_not_input(const fs::path& out) {
  if (was_read(out)) fail(out, "would replace an input of this command; give another path");
}

void commit_outputs(OutputFiles& files) {
  for (const fs::path& path : files.paths()) check_not_input(path);
  files.commit();
}

}  // namespace halyard
