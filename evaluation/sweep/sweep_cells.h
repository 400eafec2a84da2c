#pragma once
/// The results of a sweep's points, in journals: DIR/cells/all.jsonl, or DIR/cells/2_of_5.jsonl of a shard.
///
/// A journal is a text file. Its first line names the sweep and the program (this_program.h), each further line is the
/// result of one point:
///
///   {"sweep":"5f0c...","points":9,"program":"halyard 0.1.0, build 1f2e3d4c, avx2"}
///   {"point":3,"failed":0,"results":[{"failure":"","joints":[[1001,3.2e-4,4.1e-4]]}]}
///
/// results: one for each estimator or effect; joints: one list for each joint, with the columns of the measures
/// (measures/sweep_measure.h); null for NaN. A line counts once its line break is
/// on the disk, so a run that is killed loses no point that it has finished.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/sweep/sweep_grid.h"
#include "evaluation/this_program.h"
#include "model/output/descriptor.h"

namespace halyard {

/// The results at one point of the grid.
struct SweepCell {
  /// The result of one estimator, or of one effect.
  struct Result {
    std::string failure;                      ///< why it was not measured; empty: no failure
    std::vector<std::vector<double>> values;  ///< [n_joints][grid.n_columns()]
  };

  std::size_t point = 0;
  std::vector<Result> results;  ///< [grid.n_subjects()]

  /// Number of results with a failure.
  std::size_t failures() const;
  /// What the m-th measure shows of the i-th result at joint k; NaN after a failure.
  double shown(const SweepGrid& grid, std::size_t m, std::size_t i, std::size_t k) const;
};

std::filesystem::path journal_path(const std::filesystem::path& folder, const Shard& shard);
/// All journals of a folder, in the order of their names.
std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder);

/// First line of a journal, and the line of a cell; both with their line break.
std::string journal_header(const SweepGrid& grid, const std::string& program);
std::string journal_line(const SweepCell& cell);

/// Appends cells to the journal of a shard.
class CellJournal {
 public:
  /// Writes nothing yet.
  CellJournal(const std::filesystem::path& folder, const SweepGrid& grid, const Shard& shard,
              const std::string& program = this_program());

  /// The cell is on the disk when this returns; from any thread. What a killed run left of a line is cut off first.
  /// Throws std::runtime_error, such as for a full disk or a journal that somebody removed; from then on, every call
  /// throws.
  void add(const SweepCell& cell);

 private:
  void open();
  void append(const std::string& text);
  void bring_to_disk(std::uint64_t written);
  /// Lines behind the first `kept` bytes are taken away: nobody knows whether they are on the disk.
  [[noreturn]] void fail(std::uint64_t kept);

  const std::filesystem::path path_;
  const std::string header_;
  std::mutex writing_, syncing_;
  Descriptor file_;
  std::uint64_t written_ = 0;  ///< bytes; guarded by writing_
  std::uint64_t synced_ = 0;   ///< of them on the disk; guarded by syncing_
  std::string failure_;        ///< guarded by writing_
};

/// How messages name the program of a journal.
std::string name_of_program(const std::string& program);

/// The cells in the journals of some folders. Memory: 16 bytes for each point of the grid, for any size of the cells.
class StoredCells {
 public:
  /// Of several results of a point the first without a failure counts, or else the last. Journals may grow meanwhile;
  /// what comes later does not count. Throws InputError for a journal that is damaged or of another sweep, and
  /// std::runtime_error for one that cannot be read to its end. left_out: a journal that is not read.
  StoredCells(const std::vector<std::filesystem::path>& folders, const SweepGrid& grid,
              const std::filesystem::path& left_out = {});

  std::size_t size() const { return places_.size(); }  ///< points of the grid
  bool has(std::size_t point) const { return places_.at(point).length > 0; }
  bool has_failed(std::size_t point) const { return failed_.at(point); }
  std::size_t count() const;         ///< points that are there
  std::size_t count_failed() const;  ///< of them with a failure
  /// The programs that wrote the journals, each once, in the order of the journals. Empty: one that did not say so.
  std::vector<std::string> programs() const;

  /// The journal of a point that is there.
  const std::filesystem::path& journal(std::size_t point) const { return journals_.at(places_.at(point).journal).path; }
  /// The line of a point that is there, with its line break. Throws std::runtime_error if it cannot be read.
  std::string line(std::size_t point) const;
  /// The cell of that point. Throws InputError if the line is damaged.
  SweepCell read(std::size_t point) const;

 private:
  struct Place {
    std::uint64_t offset = 0;
    std::uint32_t length = 0;  ///< 0: the point is not there
    std::uint32_t journal = 0;
  };
  struct Journal {
    std::filesystem::path path;
    std::optional<std::string> program;  ///< nothing: its first line is not complete
    Descriptor file;                     ///< of the first kMostOpen; others are opened when they are read
  };
  static constexpr std::size_t kMostOpen = 256;  ///< a process may have 1024 open files
  void scan(std::size_t journal, int file, const SweepGrid& grid);
  /// The program that the first line of a journal names.
  std::string program_in(std::string_view header, const std::filesystem::path& path, const SweepGrid& grid) const;
  [[noreturn]] void damaged(const std::filesystem::path& path, std::uint64_t offset) const;

  std::size_t n_subjects_, n_joints_, n_columns_;
  std::vector<Journal> journals_;
  std::vector<Place> places_;
  std::vector<bool> failed_;
};

}  // namespace halyard
