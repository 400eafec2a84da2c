#include "evaluation/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "model/output/output_files.h"

namespace halyard {

CsvTable::CsvTable(const std::vector<std::string>& header, const std::string& comment) : columns_(header.size()) {
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text_ += "# " + line + "\n";
  for (const std::string& name : header) add(std::string_view(name));
}

void CsvTable::add(double value) {
  if (!std::isnan(value)) fmt::format_to(std::back_inserter(text_), "{:.9g}", value);
  end_cell();
}

void CsvTable::add_time(double seconds) {
  // Microseconds, on the clock of the Unix epoch too.
  fmt::format_to(std::back_inserter(text_), fmt::runtime(std::abs(seconds) < 1e5 ? "{:.12g}" : "{:.6f}"), seconds);
  end_cell();
}

void CsvTable::add(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
    text_ += text;
  } else {
    text_ += '"';
    for (const char c : text) {
      if (c == '"') text_ += '"';
      text_ += c;
    }
    text_ += '"';
  }
  end_cell();
}

void CsvTable::end_cell() {
  column_ = (column_ + 1) % columns_;
  text_ += column_ == 0 ? '\n' : ',';
}

const std::string& CsvTable::text() const {
  if (column_ != 0) throw std::logic_error("CsvTable: the last row is not complete");
  return text_;
}

std::string CsvTable::take() {
  text();
  return std::exchange(text_, {});
}

void CsvTable::write(const std::filesystem::path& path) const { write_file_whole(path, text()); }

}  // namespace halyard
