#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace halyard {

/// Files and folders that this process has made and that stay only if it finishes what they belong to. They are
/// removed at the end of the object's life, and by remove_everything_unfinished(). Safe to use from several threads.
class Unfinished {
 public:
  Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();

  /// Call before the file is made. A folder is removed only if it is empty.
  void add(std::filesystem::path path);
  /// Makes missing folders, and adds those that it makes. Throws std::filesystem::filesystem_error.
  void create_folders(const std::filesystem::path& folder);
  /// Calls `action`; if it returns, what was added stays. remove_everything_unfinished() waits for the end of it.
  void finish(const std::function<void()>& action);

 private:
  friend void remove_everything_unfinished();
  void remove_all();

  std::vector<std::filesystem::path> paths_;
};

/// For a process that is about to end: removes what every Unfinished object of the process holds. From then on, a
/// thread that adds or finishes something waits for ever.
void remove_everything_unfinished();

}  // namespace halyard
