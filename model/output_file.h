#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string_view>

namespace halyard {

/// A file that appears complete or not at all: it is written as a temporary sibling and renamed by commit(). An older
/// file of that name stays unchanged until commit() is called. Numbers are written in the classic locale, whatever the
/// global locale is.
class OutputFile {
 public:
  /// Creates missing parent folders. A link to a file is followed.
  /// Throws std::runtime_error with path and reason, also if the path is a folder or a device.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  std::ostream& stream() { return stream_; }

  /// Call once, last. Throws std::runtime_error with path and reason if a write or the rename failed.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

/// Writes an OutputFile with this content and commits it. Throws as OutputFile does.
void write_file_whole(const std::filesystem::path& path, std::string_view content);

}  // namespace halyard
