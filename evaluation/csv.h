#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace halyard {

/// Builds a CSV file cell by cell. A row ends when it is as long as the header.
class CsvTable {
 public:
  /// Each line of comment becomes a comment line at the top.
  explicit CsvTable(const std::vector<std::string>& header, const std::string& comment = "");

  /// 9 significant digits; NaN is an empty cell.
  void add(double value);
  /// 12 significant digits, enough for microseconds in a record of days.
  void add_time(double seconds);
  /// Quoted where it holds a comma, a quote or a line break.
  void add(std::string_view text);
  void add(const char* text) { add(std::string_view(text)); }

  /// The text since the last call, for a table that is written in parts. Throws as text() does.
  std::string take();
  /// The text so far. Throws std::logic_error if the last row is incomplete.
  const std::string& text() const;
  /// Throws as text() and write_file_whole() do.
  void write(const std::filesystem::path& path) const;

 private:
  void end_cell();

  std::size_t columns_;
  std::size_t column_ = 0;
  std::string text_;
};

}  // namespace halyard
