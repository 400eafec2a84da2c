#include "app/commands/sweep_command.h"

#include <fmt/core.h>

#include <charconv>
#include <optional>
#include <string>

#include "app/output_check.h"
#include "app/pages/sweep_report.h"
#include "app/progress.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_merge.h"
#include "evaluation/sweep/sweep_table.h"
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

void print_result(const fs::path& folder, const SweepGrid& grid, const std::vector<SweepCell>& cells) {
  fmt::print("sweep \"{}\": {} points, {} estimators\n", grid.name, grid.size(), grid.estimators.size());
  if (const std::size_t failures = count_failures(cells); failures > 0) {
    fmt::print("{} of {} runs of estimators failed; the column failure of sweep.csv says why\n", failures,
               cells.size() * grid.estimators.size());
  }
  fmt::print("table: {}\nreport: {}\n", (folder / "sweep.csv").string(), (folder / "report.html").string());
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
  const auto lock = lock_output_folder(options.out);
  const Sweep sweep = read_sweep(options.sweep);
  {
    std::optional<Progress> line;
    SweepRunOptions run = options.run;
    run.progress = [&line](std::size_t done, std::size_t total) {
      if (done == 0) line.emplace("sweep", static_cast<double>(total), "points");
      else line->add(1);
    };
    run_sweep(sweep, options.out, run);
  }
  if (options.run.shard.count > 1) {
    fmt::print("sweep \"{}\": part {} of {} is done; put the parts together with: halyard merge DIR... --out DIR\n",
               sweep.grid.name, options.run.shard.index, options.run.shard.count);
    return;
  }
  const std::vector<SweepCell> cells = collect_cells({options.out}, sweep.grid);
  OutputFiles files;
  write_sweep_report(files, options.out, sweep.grid, cells);
  files.commit();
  print_result(options.out, sweep.grid, cells);
}

void run_merge_command(const MergeCommandOptions& options) {
  const auto lock = lock_output_folder(options.out);
  OutputFiles files;
  const auto [grid, cells] = merge_sweep(files, options.parts, options.out);
  write_sweep_report(files, options.out, grid, cells);
  files.commit();
  print_result(options.out, grid, cells);
}

}  // namespace halyard
