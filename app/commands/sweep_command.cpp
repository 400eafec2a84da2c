#include "app/commands/sweep_command.h"

#include <fmt/core.h>

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/interruption.h"
#include "app/output_check.h"
#include "app/pages/comparison_figures.h"
#include "app/pages/sweep/sweep_report.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_merge.h"
#include "evaluation/sweep/sweep_store.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return value;
}

void print_result(const fs::path& folder, const SweepGrid& grid, const SweepSummary& summary) {
  print_out("sweep \"{}\": {} points, {} {}\n", grid.name, grid.size(), grid.n_subjects(),
            grid.measures_limits() ? "effects" : "estimators");
  if (summary.failures > 0)
    print_out("{} of {} {} failed; the column failure of sweep.csv says why\n", summary.failures,
              grid.size() * grid.n_subjects(), grid.measures_limits() ? "limits" : "runs of estimators");
  print_out("table: {}\nreport: {}\n", (folder / "sweep.csv").string(), (folder / "report.html").string());
}

/// What was measured of the i-th estimator or effect.
void print_measured(const SweepGrid& grid, const SweepCell& cell, std::size_t i) {
  const std::string name = grid.subjects()[i];
  for (std::size_t m = 0; m < grid.measures.size(); ++m)
    for (std::size_t k = 0; k < (grid.measures[m]->is_of_joint ? grid.units.size() : 1); ++k) {
      const JointUnit unit = grid.shown_unit(m, i, k);
      print_out("{}: {}: {} {}{}\n", name,
                grid.measures[m]->is_of_joint ? fmt::format("joint {}", k + 1) : "all joints",
                grid.measures[m]->shown_as, shown_number(cell.shown(grid, m, i, k), unit),
                unit.shown.empty() ? "" : " " + unit.shown);
    }
}

}  // namespace

Shard parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != text.npos) {
    const auto index = whole_number(text.substr(0, slash)), count = whole_number(text.substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count) return {*index, *count};
  }
  throw InputError("halyard sweep: --shard " + in_quotes(text) + ": expected i/n with i from 1 to n, such as 2/5");
}

void run_sweep_command(const SweepCommandOptions& options) {
  const Shard& shard = options.run.shard;
  // Other shards may compute into the same folder at the same time, but none beside a run of the whole sweep.
  const auto lock =
      lock_output_folder(options.out, shard.is_whole() ? "" : fmt::format("{}_of_{}", shard.index, shard.count));
  const auto parts = shard.is_whole() ? lock_output_folder(options.out, FolderLock::kAllParts) : nullptr;
  const Sweep sweep = read_sweep(options.sweep);
  {
    std::optional<Progress> line;
    SweepRunOptions run = options.run;
    run.progress = [&line](std::size_t done, std::size_t total) {
      if (done == 0) line.emplace("sweep", static_cast<double>(total), "points");
      else line->add(1);
    };
    run.discarding = [](std::size_t points) {
      tell(fmt::format("note: {} finished point{} of this sweep will be computed again; --resume keeps them", points,
                       points == 1 ? "" : "s"));
    };
    const KeptOnInterruption kept("finished points are kept: go on with the same command and --resume");
    run_sweep(sweep, options.out, run);
  }
  if (!shard.is_whole()) {
    print_out("sweep \"{}\": part {} of {} is done; put the parts together with: halyard merge DIR... --out DIR\n",
              sweep.grid.name, shard.index, shard.count);
    return;
  }
  const StoredCells cells = collect_cells({options.out}, sweep.grid);
  OutputFiles files;
  write_cells(files, options.out, sweep.grid, cells);
  const SweepSummary summary = write_sweep_report(files, options.out, sweep.grid, cells);
  commit_outputs(files);
  print_result(options.out, sweep.grid, summary);
}

void run_sweep_point(const SweepCommandOptions& options, std::size_t point) {
  const Sweep sweep = read_sweep_definition(options.sweep);
  const SweepGrid& grid = sweep.grid;
  if (point >= grid.size())
    throw InputError(
        fmt::format("halyard sweep: --point {}: expected a point of the sweep, 0 to {}", point, grid.size() - 1));
  print_out("point {}: {}\n", point, grid.description(point));
  const SweepCell cell = run_point(sweep, point, options.run.containment);
  for (std::size_t i = 0; i < cell.results.size(); ++i) {
    const SweepCell::Result& result = cell.results[i];
    if (!result.failure.empty()) print_out("{}: failed: {}\n", grid.subjects()[i], result.failure);
    else print_measured(grid, cell, i);
  }
  if (cell.failures() > 0)
    throw std::runtime_error(fmt::format("halyard sweep: {} of {} {} failed at point {}", cell.failures(),
                                         cell.results.size(), grid.measures_limits() ? "limits" : "estimators", point));
}

void run_merge_command(const MergeCommandOptions& options) {
  const auto lock = lock_output_folder(options.out);
  // The journals of the folder are read once and removed at the end: none may be written meanwhile.
  const auto parts = lock_output_folder(options.out, FolderLock::kAllParts);
  OutputFiles files;
  const SweepResult whole = merge_sweep(files, options.parts, options.out);
  const SweepSummary summary = write_sweep_report(files, options.out, whole.grid, whole.cells);
  commit_outputs(files);
  print_result(options.out, whole.grid, summary);
}

}  // namespace halyard
