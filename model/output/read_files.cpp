#include "model/output/read_files.h"

#include <mutex>
#include <set>
#include <system_error>

namespace halyard {
namespace {

std::mutex mutex;

std::set<std::filesystem::path>& all() {
  static std::set<std::filesystem::path> files;
  return files;
}

}  // namespace

void note_read(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(path, error);
  const std::lock_guard lock(mutex);
  if (!error) all().insert(file);
}

bool was_read(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex);
  for (const std::filesystem::path& file : all())
    if (std::error_code error; std::filesystem::equivalent(file, path, error) && !error) return true;
  return false;
}

}  // namespace halyard
