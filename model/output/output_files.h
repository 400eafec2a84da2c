#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "model/output/unfinished.h"

namespace halyard {

/// The files that a command writes. They appear together, each complete, or not at all: each is written under a
/// temporary name in its own folder and brought to the disk; commit() gives all of them their names. Older files of
/// these names stay unchanged until then. Without commit(), temporary files and new folders are removed.
///
/// If one name cannot be given, the names given before are taken back. A file system without an atomic exchange of two
/// names (Linux, RENAME_EXCHANGE) keeps those that replaced an older file.
class OutputFiles {
 public:
  /// Makes missing parent folders. A link to a file is followed. Removes what killed runs left in the file's folder.
  /// Throws std::runtime_error with path and reason: the path is a folder or a device, no permission, a full disk.
  void add(const std::filesystem::path& path, std::string_view content);

  /// The same for a file that is too large for the memory: `write` calls `append` with the parts of its content.
  using Append = std::function<void(std::string_view)>;
  void add_in_parts(const std::filesystem::path& path, const std::function<void(const Append& append)>& write);

  /// Has commit() remove an older file that has no place beside the new ones, unless a new one has its name.
  void remove(const std::filesystem::path& path) { obsolete_.push_back(path); }

  /// Of the files that were added, links followed.
  std::vector<std::filesystem::path> paths() const;

  /// Call once, last. Throws std::runtime_error with path and reason.
  void commit();

 private:
  struct File {
    std::filesystem::path path, temporary;
    bool exchanged = false;  ///< `temporary` is now the older file
    bool replaced = false;   ///< the older file is gone: the file system cannot exchange names
  };
  static int give_name(File& f);
  static void take_back(const File& f);
  void give_names();

  std::vector<File> files_;
  std::vector<std::filesystem::path> obsolete_;
  Unfinished unfinished_;
};

/// Writes a single file. Throws as OutputFiles does.
void write_file_whole(const std::filesystem::path& path, std::string_view content);

/// Removes what processes that were killed (SIGKILL, power) left of their temporary files in this folder, not below it.
/// Files of processes that still run stay, and those of other machines.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace halyard
