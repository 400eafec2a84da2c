#include "evaluation/sweep/sweep_cells.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "evaluation/json.h"
#include "model/input_error.h"
#include "model/name_list.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string one_line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// Whole numbers without a point, NaN as null.
ordered_json cell_value(double value) {
  const bool is_negative_zero = value == 0 && std::signbit(value);
  if (std::abs(value) < 1e15 && value == std::trunc(value) && !is_negative_zero) return std::int64_t(value);
  return number_or_null(value);
}

double cell_value_from(const ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// The numbers at the start of a line: {"point":3,"failed":0,
struct LineStart {
  std::size_t point = 0, failed = 0;
};
std::optional<LineStart> parse_start(std::string_view line) {
  LineStart start;
  for (const auto& [prefix, value] :
       {std::pair<std::string_view, std::size_t*>{"{\"point\":", &start.point}, {",\"failed\":", &start.failed}}) {
    if (!line.starts_with(prefix)) return std::nullopt;
    line.remove_prefix(prefix.size());
    const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), *value);
    if (error != std::errc()) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(rest - line.data()));
  }
  return line.starts_with(",") && line.ends_with("}") ? std::optional(start) : std::nullopt;
}

/// Calls `line(text, offset)` for each complete line of a file; a last line without line break does not count. Returns
/// the length of the complete lines. Throws std::runtime_error if the file cannot be read to its end.
template <class Line>
std::uint64_t for_each_line(int file, const fs::path& path, const Line& line) {
  std::string rest;
  std::uint64_t offset = 0;  // of rest in the file
  std::vector<char> block(1 << 20);
  for (std::uint64_t at = 0;;) {
    const ssize_t n = ::pread(file, block.data(), block.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw std::runtime_error(path.string() + ": cannot be read: " + reason(errno));
    if (n == 0) return offset;
    at += static_cast<std::uint64_t>(n);
    rest.append(block.data(), static_cast<std::size_t>(n));
    std::size_t begin = 0;
    for (std::size_t end; (end = rest.find('\n', begin)) != rest.npos; begin = end + 1)
      line(std::string_view(rest).substr(begin, end - begin), offset + begin);
    rest.erase(0, begin);
    offset += begin;
  }
}

}  // namespace

std::size_t SweepCell::failures() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(results, [](const Result& result) { return !result.failure.empty(); }));
}

double SweepCell::shown(const SweepGrid& grid, std::size_t m, std::size_t i, std::size_t k) const {
  return results.at(i).values.at(k).at(grid.n_columns(m) + grid.measures.at(m)->shown);
}

fs::path journal_path(const fs::path& folder, const Shard& shard) {
  return folder / "cells" / (shard.is_whole() ? "all.jsonl" : fmt::format("{}_of_{}.jsonl", shard.index, shard.count));
}

std::vector<fs::path> journals_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "cells", none))
    if (entry.path().extension() == ".jsonl") paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

std::string journal_header(const SweepGrid& grid, const std::string& program) {
  return one_line({{"sweep", grid.id}, {"points", grid.size()}, {"program", program}});
}

std::string journal_line(const SweepCell& cell) {
  ordered_json results = ordered_json::array();
  for (const SweepCell::Result& result : cell.results) {
    ordered_json joints = ordered_json::array();
    for (const std::vector<double>& values : result.values) {
      ordered_json& joint = joints.emplace_back(ordered_json::array());
      for (const double value : values) joint.push_back(cell_value(value));
    }
    results.push_back({{"failure", result.failure}, {"joints", joints}});
  }
  return one_line({{"point", cell.point}, {"failed", cell.failures()}, {"results", results}});
}

std::string name_of_program(const std::string& program) {
  return program.empty() ? "an earlier one, which did not write its build" : shortened(program);
}

CellJournal::CellJournal(const fs::path& folder, const SweepGrid& grid, const Shard& shard, const std::string& program)
    : path_(journal_path(folder, shard)), header_(journal_header(grid, program)) {}

void CellJournal::add(const SweepCell& cell) {
  const std::string line = journal_line(cell);
  std::uint64_t written = 0;
  {
    const std::lock_guard lock(writing_);
    if (!failure_.empty()) throw std::runtime_error(failure_);
    if (!file_) open();
    append(line);
    written = written_;
  }
  bring_to_disk(written);
}

void CellJournal::open() {
  fs::create_directories(path_.parent_path());
  Descriptor file(path_, O_RDWR | O_CREAT);
  if (!file) fail(0);
  std::uint64_t length = 0;
  try {
    length = for_each_line(*file, path_, [](std::string_view, std::uint64_t) {});
  } catch (const std::runtime_error& error) {
    failure_ = error.what();
    throw;
  }
  if (::ftruncate(*file, static_cast<off_t>(length)) != 0) fail(length);
  // Only now: what is added goes behind the lines that are there. No other thread syncs before the first line is added.
  file_ = std::move(file);
  written_ = synced_ = length;
  if (written_ == 0) append(header_);
  // The names of the file and of its folder have to be on the disk too.
  for (const fs::path& folder : {path_.parent_path(), path_.parent_path().parent_path()})
    if (const Descriptor names(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY); names) ::fsync(*names);
}

void CellJournal::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::pwrite(*file_, text.data() + done, text.size() - done, static_cast<off_t>(written_ + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(written_);
    done += static_cast<std::size_t>(n);
  }
  written_ += text.size();
}

/// One thread's sync serves all lines that were written before it.
void CellJournal::bring_to_disk(std::uint64_t written) {
  const std::lock_guard lock(syncing_);
  if (synced_ >= written) return;
  std::uint64_t covered = 0;
  {
    const std::lock_guard reading(writing_);
    if (written_ < written) throw std::runtime_error(failure_);  // another thread's sync failed, and took the line away
    covered = written_;
  }
  struct stat status;
  const bool is_written = ::fdatasync(*file_) == 0 || errno == EINVAL || errno == EROFS;
  if (!is_written || ::fstat(*file_, &status) != 0) {
    const std::lock_guard reading(writing_);
    fail(synced_);
  }
  if (status.st_nlink == 0) {
    const std::lock_guard reading(writing_);
    failure_ = path_.string() + ": was removed while the sweep ran, with the points that were finished; run it again";
    throw std::runtime_error(failure_);
  }
  synced_ = covered;
}

void CellJournal::fail(std::uint64_t kept) {
  failure_ = path_.string() + ": not written: " + reason(errno) +
             "; the points before are kept: make room and run again with --resume";
  written_ = kept;
  if (file_) [[maybe_unused]]
    const int ignored = ::ftruncate(*file_, static_cast<off_t>(kept));
  throw std::runtime_error(failure_);
}

StoredCells::StoredCells(const std::vector<fs::path>& folders, const SweepGrid& grid, const fs::path& left_out)
    : n_subjects_(grid.n_subjects()),
      n_joints_(grid.units.size()),
      n_columns_(grid.n_columns()),
      places_(grid.size()),
      failed_(grid.size()) {
  for (const fs::path& folder : folders) {
    for (const fs::path& path : journals_in(folder)) {
      if (path == left_out) continue;
      Descriptor file(path, O_RDONLY);
      if (!file) throw InputError(path.string() + ": cannot be read: " + reason(errno));
      journals_.push_back({path, {}, {}});
      scan(journals_.size() - 1, *file, grid);
      if (journals_.size() <= kMostOpen) journals_.back().file = std::move(file);
    }
  }
}

std::string StoredCells::program_in(std::string_view header, const fs::path& path, const SweepGrid& grid) const {
  try {
    const ordered_json json = ordered_json::parse(header);
    if (json.at("sweep") == grid.id && whole_number(json.at("points")) == grid.size())
      return json.value("program", "");  // earlier programs wrote none
  } catch (const ordered_json::exception&) {
    damaged(path, 0);
  }
  throw InputError(path.string() + ": belongs to another sweep; remove it, or give a folder of its own to each sweep");
}

void StoredCells::scan(std::size_t journal, int file, const SweepGrid& grid) {
  const fs::path& path = journals_[journal].path;
  for_each_line(file, path, [&](std::string_view line, std::uint64_t offset) {
    if (offset == 0) {
      journals_[journal].program = program_in(line, path, grid);
      return;
    }
    const std::optional<LineStart> start = parse_start(line);
    if (!start || start->point >= places_.size()) damaged(path, offset);
    Place& place = places_[start->point];
    if (place.length > 0 && !failed_[start->point]) return;
    place = {offset, static_cast<std::uint32_t>(line.size() + 1), static_cast<std::uint32_t>(journal)};
    failed_[start->point] = start->failed > 0;
  });
}

void StoredCells::damaged(const fs::path& path, std::uint64_t offset) const {
  throw InputError(
      fmt::format("{}: is no result of halyard sweep or is damaged at byte {}; remove it and run the "
                  "sweep again with --resume",
                  path.string(), offset));
}

std::size_t StoredCells::count() const {
  return static_cast<std::size_t>(std::ranges::count_if(places_, [](const Place& p) { return p.length > 0; }));
}

std::size_t StoredCells::count_failed() const { return static_cast<std::size_t>(std::ranges::count(failed_, true)); }

std::vector<std::string> StoredCells::programs() const {
  std::vector<std::string> programs;
  for (const Journal& journal : journals_)
    if (journal.program && std::ranges::find(programs, *journal.program) == programs.end())
      programs.push_back(*journal.program);
  return programs;
}

std::string StoredCells::line(std::size_t point) const {
  const Place& place = places_.at(point);
  const Journal& journal = journals_.at(place.journal);
  const Descriptor opened = journal.file ? Descriptor() : Descriptor(journal.path, O_RDONLY);
  std::string text(place.length, '\0');
  const ssize_t n =
      ::pread(journal.file ? *journal.file : *opened, text.data(), text.size(), static_cast<off_t>(place.offset));
  if (n != static_cast<ssize_t>(text.size())) throw std::runtime_error(journal.path.string() + ": cannot be read");
  return text;
}

SweepCell StoredCells::read(std::size_t point) const {
  const Place& place = places_.at(point);
  const auto check = [&](bool holds) {
    if (!holds) damaged(journals_.at(place.journal).path, place.offset);
  };
  try {
    const ordered_json json = ordered_json::parse(line(point));
    SweepCell cell{whole_number(json.at("point")), {}};
    for (const ordered_json& result : json.at("results")) {
      SweepCell::Result& read = cell.results.emplace_back();
      read.failure = result.at("failure").get<std::string>();
      for (const ordered_json& joint : result.at("joints")) {
        std::vector<double>& values = read.values.emplace_back();
        for (const ordered_json& value : joint) values.push_back(cell_value_from(value));
        check(values.size() == n_columns_);
      }
      check(read.values.size() == n_joints_);
    }
    check(cell.results.size() == n_subjects_);
    return cell;
  } catch (const ordered_json::exception&) {
    damaged(journals_.at(place.journal).path, place.offset);
  }
}

}  // namespace halyard
