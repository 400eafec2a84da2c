#include "model/output/unfinished.h"

#include <algorithm>
#include <mutex>
#include <system_error>

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// Of the process. Never destroyed: threads may still write while the process ends.
struct Registry {
  std::recursive_mutex mutex;
  std::vector<Unfinished*> all;  ///< the oldest first
};
Registry& registry() {
  static auto* const only = new Registry;
  return *only;
}

}  // namespace

Unfinished::Unfinished() {
  const std::lock_guard lock(registry().mutex);
  registry().all.push_back(this);
}

Unfinished::~Unfinished() {
  const std::lock_guard lock(registry().mutex);
  remove_all();
  std::erase(registry().all, this);
}

void Unfinished::add(fs::path path) {
  const std::lock_guard lock(registry().mutex);
  paths_.push_back(std::move(path));
}

void Unfinished::create_folders(const fs::path& folder) {
  if (folder.empty() || fs::is_directory(folder)) return;
  if (fs::exists(folder))
    throw fs::filesystem_error("create_folders", folder, std::make_error_code(std::errc::not_a_directory));
  create_folders(folder.parent_path());
  const std::lock_guard lock(registry().mutex);
  if (fs::create_directory(folder)) paths_.push_back(folder);
}

void Unfinished::finish(const std::function<void()>& action) {
  const std::lock_guard lock(registry().mutex);
  action();
  paths_.clear();
}

/// The last first: a folder after what is in it.
void Unfinished::remove_all() {
  std::error_code ignored;
  for (; !paths_.empty(); paths_.pop_back()) fs::remove(paths_.back(), ignored);
}

void remove_everything_unfinished() {
  registry().mutex.lock();
  // The newest first: its files may be in a folder of an older one.
  std::vector<Unfinished*>& all = registry().all;
  std::for_each(all.rbegin(), all.rend(), [](Unfinished* unfinished) { unfinished->remove_all(); });
}

}  // namespace halyard
