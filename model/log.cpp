#include "model/log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "model/input/cell_text.h"
#include "model/input/text_file.h"
#include "model/input_error.h"
#include "model/name_list.h"
#include "model/output/number_text.h"
#include "model/output/output_files.h"

namespace halyard {
namespace {

std::string read_text(const std::filesystem::path& path) {
  return read_text_file(path, {.name = "a CSV log", .if_too_large = "cut the log into shorter ones"});
}

bool is_binary(unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

/// The lines of a text without blank and comment lines, numbered from 1 as an editor does.
class Lines {
 public:
  Lines(std::string_view text, std::string source) : rest_(text), source_(std::move(source)) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  /// False at the end of the text.
  bool next() {
    while (!rest_.empty()) {
      const auto end = std::min(rest_.find('\n'), rest_.size());
      line_ = trim(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!line_.empty() && line_.front() != '#') return true;
    }
    return false;
  }

  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(source_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  std::string_view rest_, line_;
  std::string source_;
  std::size_t number_ = 0;
};

/// In SI units. Squares of readings and squares of those, as statistics of errors take them, are finite.
constexpr double kLargestReading = 1e50;

/// A column of a log, and where its values come from.
class Target {
 public:
  Target(std::vector<double>& values, const ColumnSource& source) : values_(&values), source_(source) {}

  /// Appends the value of a raw reading, NaN if it is missing. False if the value is beyond kLargestReading.
  bool append(double raw) {
    if (source_.wrap > 0 && !std::isnan(raw)) {
      if (!std::isnan(last_)) laps_ -= std::round((raw - last_) / source_.wrap);
      last_ = raw;
    }
    values_->push_back(source_.scale * (raw + laps_ * source_.wrap) + source_.offset);
    return !(std::abs(values_->back()) > kLargestReading);
  }

 private:
  std::vector<double>* values_;
  ColumnSource source_;
  double last_ = std::numeric_limits<double>::quiet_NaN();  ///< raw reading before, without missing ones
  double laps_ = 0;                                         ///< since the first reading
};

struct Column {
  std::string name;
  std::vector<Target> targets;            // none: the column is ignored
  std::vector<std::string> read_as = {};  // the standard names of the targets
};

/// "motor_position" of "motor_position_2".
std::string_view signal_of(std::string_view name) { return name.substr(0, name.find_last_not_of("0123456789") + 1); }

std::vector<Column> read_header(const Lines& header) {
  std::vector<std::string_view> names;
  split(header.line(), names);
  if (names.size() == 1 && names[0].find_first_of(";\t") != std::string_view::npos) {
    header.fail("the columns are separated by semicolons or tabs; separate them by commas");
  }
  if (parse_number(names[0])) {
    header.fail("the first row starts with the number " + in_quotes(names[0]) + "; put a row of column names above it");
  }
  std::vector<Column> columns;
  for (std::string_view name : names) {
    const bool has_quotes = name.size() > 1 && name.front() == '"' && name.back() == '"';
    columns.push_back({std::string(has_quotes ? trim(name.substr(1, name.size() - 2)) : name), {}});
  }
  return columns;
}

bool is_required(const std::string& name, const ReadOptions& options) {
  return name.starts_with("motor_position_") || (options.torque_required && name.starts_with("motor_torque_"));
}

/// Whether a column is of a motor that the arm does not have.
bool has_no_motor(const std::string& name, const ReadOptions& options) {
  const std::string_view joint = std::string_view(name).substr(name.rfind('_') + 1);
  return name.starts_with("motor_") &&
         std::ranges::any_of(options.without_motor, [&](int k) { return joint == std::to_string(k + 1); });
}

/// Connects the columns of a file to those of a log.
void bind_columns(std::vector<Column>& columns, Log& log, const ColumnMap& map, const ReadOptions& options,
                  const Lines& header) {
  std::vector<std::string> missing, present;
  std::string example, optional;
  const auto bind_one = [&](const std::string& name, std::vector<double>& values) {
    if (has_no_motor(name, options)) return;
    const auto mapped = map.sources().find(name);
    const bool is_mapped = mapped != map.sources().end(), is_left_out = is_mapped && mapped->second.column.empty();
    if (is_left_out && is_required(name, options))
      header.fail(in_quotes(name) + " is left out but needed here; say which column of the file it is by --column " +
                  name + "=NAME, or do not leave it out");
    if (is_left_out) return;
    const ColumnSource source = is_mapped ? mapped->second : ColumnSource{name};
    const auto n_found = std::ranges::count(columns, source.column, &Column::name);
    if (n_found > 1) {
      header.fail("column " + in_quotes(source.column) + " stands twice in the header; rename one of the two");
    } else if (n_found == 1) {
      const auto found = std::ranges::find(columns, source.column, &Column::name);
      for (const std::string& other : found->read_as)
        if (signal_of(other) == signal_of(name))
          header.fail("column " + in_quotes(source.column) + " is read as " + other + " and as " + name +
                      "; map each of them to a column of its own");
      found->targets.emplace_back(values, source);
      found->read_as.push_back(name);
    } else if (is_mapped) {
      missing.push_back(in_quotes(source.column) + " (mapped to " + name + ")");
      if (example.empty()) example = name;
      if (optional.empty() && name != "time" && !is_required(name, options)) optional = name;
    } else if (name == "time" || is_required(name, options)) {
      missing.push_back(in_quotes(name));
      if (example.empty()) example = name;
    }
  };
  bind_one("time", log.time);
  for_each_column(log, bind_one);
  if (missing.empty()) return;
  for (const Column& column : columns) present.push_back(in_quotes(column.name));
  const auto has = [&](const std::string& name) { return std::ranges::count(columns, name, &Column::name) > 0; };
  const bool is_mapped_in_vain =
      map.sources().contains("time") && has("time") && has("motor_position_1") &&
      std::ranges::none_of(map.sources(), [&](const auto& m) { return has(m.second.column); });
  if (is_mapped_in_vain)
    header.fail(
        "has the column names of halyard's own logs, but none of the columns that <columns> or --column ask for; read "
        "it with a model without <columns>, and without --column");
  header.fail("no column " + listed(missing) + "; the file has " + listed(present) +
              "; say which column of the file it is, in the model file or by --column " + example + "=NAME" +
              (optional.empty() ? "" : ", or by --column " + optional + "= that the log lacks it"));
}

void read_cell(std::string_view cell, Column& column, const Lines& row) {
  const auto fail = [&](const char* what) {
    row.fail("column " + in_quotes(column.name) + ": " + in_quotes(cell) + what +
             ", or leave the cell empty for a missing sample");
  };
  const std::optional<double> number = parse_number(cell);
  if (!number && !cell.empty()) fail(" is not a number; write a finite decimal number");
  const double raw = number.value_or(std::numeric_limits<double>::quiet_NaN());
  for (Target& target : column.targets)
    if (!target.append(raw))
      fail(" is too large once scaled; expected a magnitude of at most 1e50 in SI units; correct it");
}

void read_row(std::vector<Column>& columns, const Lines& row, std::vector<std::string_view>& cells) {
  split(row.line(), cells);
  if (cells.size() != columns.size()) {
    row.fail("the row has " + std::to_string(cells.size()) + " cells, the header " + std::to_string(columns.size()) +
             "; complete the row, or remove it if the recording was cut off there");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!columns[i].targets.empty()) read_cell(cells[i], columns[i], row);
  }
}

std::string time_text(double time) {
  std::string text = with_decimals(time, 6);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

void check_last_time(const std::vector<double>& time, const Lines& row) {
  if (std::isnan(time.back())) row.fail("the time is missing; give every row its time, or remove the row");
  if (time.size() > 1 && !(time.back() > time.end()[-2])) {
    row.fail("time " + time_text(time.back()) + " s follows " + time_text(time.end()[-2]) +
             " s; time must increase: sort the rows and remove repeated ones");
  }
}

}  // namespace

std::vector<std::string> column_names(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  Lines lines(text, path.string());
  std::vector<std::string> names;
  if (!lines.next()) return names;
  for (Column& column : read_header(lines)) names.push_back(std::move(column.name));
  return names;
}

Log read_log(const std::filesystem::path& path, int n_joints, const ColumnMap& map, const ReadOptions& options) {
  if (n_joints < 1) throw std::invalid_argument("read_log: n_joints must be at least 1");
  map.check_joints(n_joints);
  const std::string text = read_text(path);
  Log log(n_joints);
  log.source = path.string();
  if (std::ranges::any_of(text, is_binary)) throw InputError(log.source + ": is not text; give a CSV log in UTF-8");
  Lines lines(text, log.source);
  if (!lines.next()) throw InputError(log.source + ": is empty; give a CSV log with a header row and samples");
  std::vector<Column> columns = read_header(lines);
  bind_columns(columns, log, map, options, lines);
  for (const Column& column : columns) {
    if (column.targets.empty()) log.ignored_columns.emplace_back(column.name);
  }

  std::vector<std::string_view> cells;
  while (lines.next()) {
    read_row(columns, lines, cells);
    check_last_time(log.time, lines);
  }
  if (log.time.empty()) throw InputError(log.source + ": has a header but no samples; give a log with samples");
  // s: of a clock that began long before the log. Instants of effects, and what a drift was at 0, are sought near 0.
  constexpr double kFarFromZero = 100;
  if (std::abs(log.time.front()) > kFarFromZero) {
    log.clock_start = log.time.front();
    for (double& t : log.time) t -= log.clock_start;
  }
  for_each_column(log, [&](const std::string& name, std::vector<double>& values) {
    if (!std::ranges::all_of(values, [](double value) { return std::isnan(value); })) return;
    if (!values.empty() && is_required(name, options)) {
      throw InputError(log.source + ": " + name + " is empty in every row; give a log that has this signal");
    }
    values = {};
  });
  const bool sees = std::ranges::any_of(log.marker, [](const auto& axis) { return !axis.empty(); });
  for (std::size_t i = 0; sees && i < log.marker.size(); ++i) {
    if (!log.marker[i].empty()) continue;
    throw InputError(log.source + ": no " + std::string(kMarkerNames[i]) +
                     " beside the marker's other axes; give all three of marker_x, marker_y, marker_z, or none");
  }
  return log;
}

std::size_t line_of_sample(const Log& log, std::size_t sample) {
  try {
    const std::string text = read_text(log.source);
    Lines lines(text, log.source);
    for (std::size_t i = 0; lines.next(); ++i)  // the header is not a sample
      if (i == sample + 1) return lines.number();
  } catch (const InputError&) {}
  return 0;
}

std::string log_csv(const Log& log, const std::string& comment) {
  std::string text;
  std::istringstream comment_lines(comment);
  for (std::string line; std::getline(comment_lines, line);) text += "# " + line + "\n";
  text += "time";
  std::vector<const std::vector<double>*> columns;
  for_each_column(log, [&](const std::string& name, const std::vector<double>& values) {
    if (values.empty()) return;
    if (values.size() != log.size() || std::ranges::any_of(values, [](double value) { return std::isinf(value); })) {
      throw std::invalid_argument("write_log: " + name + " has an infinite value or not one value for each time");
    }
    text += "," + name;
    columns.push_back(&values);
  });
  text += "\n";

  std::string previous;
  for (std::size_t i = 0; i < log.size(); ++i) {
    std::string time = time_text(log.clock_start + log.time[i]);
    if (!std::isfinite(log.time[i]) || (i > 0 && (log.time[i] <= log.time[i - 1] || time == previous))) {
      throw std::invalid_argument("write_log: time " + time + " s after " + previous + " s does not increase");
    }
    text += time;
    for (const auto* values : columns) {
      text += ',';
      if (!std::isnan((*values)[i])) text += with_digits((*values)[i], 9);
    }
    text += "\n";
    previous = std::move(time);
  }
  return text;
}

void write_log(const std::filesystem::path& path, const Log& log, const std::string& comment) {
  write_file_whole(path, log_csv(log, comment));
}

Log slice(const Log& log, std::size_t begin, std::size_t end) {
  if (begin > end || end > log.size()) throw std::out_of_range("slice: expected begin <= end <= size of the log");
  const auto cut = [&](std::vector<double>& values) {
    if (!values.empty()) values = std::vector<double>(values.begin() + begin, values.begin() + end);
  };
  Log part = log;
  cut(part.time);
  for_each_column(part, [&](const std::string&, std::vector<double>& values) { cut(values); });
  return part;
}

std::pair<Log, Log> split_log(const Log& log, double fraction) {
  const double at = log.time.front() + fraction * log.duration();
  const auto middle =
      static_cast<std::size_t>(std::lower_bound(log.time.begin(), log.time.end(), at) - log.time.begin());
  return {slice(log, 0, middle), slice(log, middle, log.size())};
}

}  // namespace halyard
