/// halyard sweep on a cluster: --slurm and --status.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "app/commands/sweep_command.h"
#include "app/output_check.h"
#include "app/slurm/slurm_array.h"
#include "app/terminal/terminal.h"
#include "evaluation/shell_words.h"
#include "evaluation/sweep/sweep_file.h"
#include "evaluation/sweep/sweep_run.h"
#include "evaluation/sweep/sweep_store.h"
#include "model/input_error.h"
#include "model/output/folder_lock.h"
#include "plugins/host/effect_module.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// Points of a shard, how many of them are there, and how many of these with a failure.
struct PartState {
  std::size_t points = 0, done = 0, failed = 0;

  bool is_done() const { return done == points; }
};

std::vector<PartState> part_states(const StoredCells& cells, std::size_t parts) {
  std::vector<PartState> states(parts);
  for (std::size_t point = 0; point < cells.size(); ++point) {
    PartState& part = states[point % parts];
    ++part.points;
    part.done += cells.has(point);
    part.failed += cells.has_failed(point);
  }
  return states;
}

/// The shards, 1-based, that have points to do; failed ones are tried again.
std::vector<std::size_t> open_parts(const std::vector<PartState>& states) {
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (!states[i].is_done() || states[i].failed > 0) parts.push_back(i + 1);
  return parts;
}

/// "halyard sweep S.xml --out DIR", and what else this sweep needs to be understood.
std::string sweep_command(const fs::path& sweep, const fs::path& out) {
  return fmt::format("halyard sweep {} --out {}{}", in_shell_quotes(sweep.string()), in_shell_quotes(out.string()),
                     effects_options(loaded_effect_modules()));
}

std::string merge_command(const fs::path& out) { return "halyard merge " + in_shell_quotes(out.string()); }

/// Whether the table is of all points that are stored. A part that ran later left a journal of its own, and a run that
/// was ended before it wrote the table left a newer one.
bool has_current_table(const fs::path& out) {
  const fs::path table = out / "sweep.csv", all = journal_path(out, {});
  std::error_code none;
  return journals_in(out) == std::vector{all} && fs::exists(table) &&
         fs::last_write_time(table, none) >= fs::last_write_time(all, none);
}

/// Prints a line for each part that Slurm got; returns whether any of them is still active, as far as is known.
bool print_parts(const StoredCells& cells, const SubmittedArray& array) {
  std::vector<ActiveTask> active;
  std::string unknown;
  try {
    active = active_tasks(array.job);
  } catch (const std::runtime_error& error) {
    unknown = error.what();
  }
  const std::vector<PartState> states = part_states(cells, array.parts);
  print_out("Slurm job {}:{}\n", array.job.label(), unknown.empty() ? "" : " " + unknown);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto task = std::ranges::find(active, i + 1, &ActiveTask::task);
    const std::string state = task != active.end()                      ? ", " + task->state
                              : states[i].is_done() || !unknown.empty() ? ""
                                                                        : ", not running";
    print_out("  part {} of {}: {} of {} done{}\n", i + 1, states.size(), states[i].done, states[i].points, state);
  }
  return !active.empty() || !unknown.empty();
}

}  // namespace

void run_sweep_slurm(const SweepSlurmOptions& options) {
  const Sweep sweep = read_sweep(options.sweep);
  SlurmArray array{sweep.grid.id,         options.sweep, options.out, std::min(options.nodes, sweep.grid.size()), {},
                   options.sbatch_options};
  if (options.print_script) {
    array.tasks.resize(array.parts);
    std::iota(array.tasks.begin(), array.tasks.end(), 1);
    // A file gets the script to the last byte; a terminal must not obey what is in its paths.
    const std::string script = slurm_script(array);
    fmt::print("{}", ::isatty(STDOUT_FILENO) ? without_controls(script) : script);
    return;
  }
  check_estimators(sweep);  // a wrong one is found now, not by each part
  const auto lock = lock_output_folder(options.out);
  refuse_other_sweep(options.out, sweep.grid);
  if (const auto before = submitted_array(options.out, sweep.grid.id); before && !active_tasks(before->job).empty())
    throw InputError(
        fmt::format("--out {}: Slurm job {} still computes this sweep; wait for its end, or end it with: {}",
                    in_quotes(options.out.string()), before->job.label(), cancel_command(before->job)));
  store_grid(options.out, sweep.grid);
  const StoredCells cells({options.out}, sweep.grid);
  array.tasks = open_parts(part_states(cells, array.parts));
  if (array.tasks.empty()) {
    print_out("sweep \"{}\": all {} points are done\nnext: {}\n", sweep.grid.name, sweep.grid.size(),
              merge_command(options.out));
    return;
  }
  refuse_other_programs(cells, options.out, true);  // each part would, when it has waited for its nodes
  const SlurmJob job = submit(array);
  print_out("sweep \"{}\": {} points, {} of {} parts submitted as Slurm job {}\n", sweep.grid.name, sweep.grid.size(),
            array.tasks.size(), array.parts, job.label());
  if (const std::size_t failed = cells.count_failed(); failed > 0)
    print_out("{} failed point{} will be tried again\n", failed, failed == 1 ? "" : "s");
  print_out("progress: {} --status\nnext: {}\n", sweep_command(options.sweep, options.out), merge_command(options.out));
}

void run_sweep_status(const fs::path& sweep, const fs::path& out) {
  const SweepGrid grid = read_sweep_definition(sweep).grid;
  read_grid(out);
  refuse_other_sweep(out, grid);
  const StoredCells cells({out}, grid);
  const std::size_t done = cells.count(), failed = cells.count_failed();
  print_out("sweep \"{}\": {} of {} points are done ({:.1f} %)", grid.name, done, grid.size(),
            100.0 * double(done) / double(grid.size()));
  print_out("{}\n", failed > 0 ? fmt::format(", {} of them with a failure", failed) : "");
  if (const std::vector<std::string> programs = cells.programs(); programs.size() > 1)
    print_out("the points are of {} programs, which halyard merge refuses: {}; {}\n", programs.size(),
              name_of_program(programs[0]), name_of_program(programs[1]));
  const auto array = submitted_array(out, grid.id);
  const bool is_active = array && print_parts(cells, *array);
  if (!is_active && is_in_use(out)) {
    print_out("running: a run writes into {}\n", out.string());
  } else if (done == grid.size()) {
    if (has_current_table(out)) print_out("table: {}\n", (out / "sweep.csv").string());
    else print_out("next: {}\n", merge_command(out));
  } else if (!is_active) {
    std::string rest = "--resume";
    if (array) {
      rest = fmt::format("--slurm --nodes {}", array->parts);
      for (const std::string& option : array->options) rest += " --sbatch " + in_shell_quotes(option);
    }
    print_out("to continue: {} {}\n", sweep_command(sweep, out), rest);
  }
}

}  // namespace halyard
