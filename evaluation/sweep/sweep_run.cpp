#include "evaluation/sweep/sweep_run.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <boost/algorithm/string/replace.hpp>
#include <exception>
#include <functional>
#include <string_view>

#include "evaluation/comparison/compare.h"
#include "evaluation/run/contained_run.h"
#include "evaluation/sweep/measures/sweep_limits.h"
#include "evaluation/sweep/parameters/estimator_option.h"
#include "evaluation/sweep/sweep_store.h"
#include "model/input_error.h"
#include "model/machine/first_failure.h"
#include "model/name_list.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// this_program() without its last word, the instruction set.
std::string_view build_of(std::string_view program) { return program.substr(0, program.rfind(", ")); }

/// What another journal holds of the shard's points could count instead of the new results.
void refuse_other_journals(const SweepGrid& grid, const fs::path& folder, const Shard& shard) {
  const StoredCells others({folder}, grid, journal_path(folder, shard));
  refuse_other_programs(others, folder);
  for (std::size_t point = 0; point < grid.size(); ++point)
    if (shard.holds(point) && others.has(point))
      throw InputError(
          fmt::format("{}: holds results of part {} of {}, such as of point {}, which would count instead of new ones; "
                      "keep them with --resume, or remove the folder {}",
                      others.journal(point).string(), shard.index, shard.count, point, folder.string()));
}

/// Points of the shard that are still to be computed; a journal that does not count is removed.
std::vector<std::size_t> points_to_do(const SweepGrid& grid, const fs::path& folder, const SweepRunOptions& options) {
  if (!options.resume && !options.shard.is_whole()) refuse_other_journals(grid, folder, options.shard);
  const StoredCells stored({folder}, grid);
  if (options.resume) refuse_other_programs(stored, folder);
  std::vector<std::size_t> todo;
  std::size_t discarded = 0;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    if (!options.shard.holds(point)) continue;
    const bool is_done = stored.has(point) && !stored.has_failed(point);
    if (!(options.resume && is_done)) todo.push_back(point);
    discarded += !options.resume && stored.has(point);
  }
  if (discarded > 0 && options.discarding) options.discarding(discarded);
  if (!options.resume) {
    if (options.shard.is_whole())
      for (const fs::path& journal : journals_in(folder)) fs::remove(journal);
    fs::remove(journal_path(folder, options.shard));
  }
  return todo;
}

/// Calls `number(column, joint)` for each column of the measures and each joint.
template <class Number>
SweepCell::Result result_of(const SweepGrid& grid, const std::string& failure, const Number& number) {
  SweepCell::Result result{failure, std::vector<std::vector<double>>(grid.units.size())};
  for (std::size_t k = 0; k < result.values.size(); ++k)
    for (const SweepMeasure* measure : grid.measures)
      for (const MeasuredColumn& column : measure->columns) result.values[k].push_back(number(column, k));
  return result;
}

SweepCell::Result result_of(const SweepGrid& grid, const Comparison& comparison) {
  return result_of(grid, "", [&](const MeasuredColumn& column, std::size_t k) { return column.value(comparison, k); });
}

SweepCell::Result failure(const SweepGrid& grid, const std::string& reason) {
  return result_of(grid, reason, [](const MeasuredColumn& column, std::size_t) { return column.after_failure; });
}

/// Does the work of a point. Returns why it failed, or an empty text. A fault of the machine is no result of the point
/// and is thrown.
template <class Work>
std::string failure_of(const Work& work) {
  try {
    work();
    return "";
  } catch (const std::exception& error) {
    if (is_fault_of_the_machine(error)) throw;
    return error.what();
  }
}

/// Results do not depend on the folder in which the sweep is started.
ArmModel model_of_point(const Sweep& sweep, std::size_t point) {
  ArmModel model = sweep.model_at(point);
  model.source = sweep.grid.model;
  return model;
}

SweepCell limits_at(const Sweep& sweep, std::size_t point) {
  SweepCell cell{point, {}};
  const std::string reason = failure_of([&] {
    check_point(sweep, point, "the sweep");
    for (auto& limits : limits_of(sweep.grid.effects, sweep.scenario_at(point), model_of_point(sweep, point)))
      cell.results.push_back({"", std::move(limits)});
  });
  if (!reason.empty()) cell.results.assign(sweep.grid.n_subjects(), failure(sweep.grid, reason));
  return cell;
}

/// A module says its name only when it is opened, so that the definition could not check it. One that cannot be opened
/// in do_check has the name of its file.
template <class DoCheck>
void check_names_of_options(const Sweep& sweep, const ContainmentOptions& containment, const DoCheck& do_check) {
  std::vector<std::string> names;
  for (const SweepAxis& axis : sweep.grid.axes)
    for (const std::string& key : axis.parameters) {
      const auto option = parse_option_key(key);
      if (!option) continue;
      if (names.empty())
        for (const std::string& estimator : sweep.grid.estimators) {
          names.push_back(fs::path(estimator).stem().string());
          do_check([&] { names.back() = stated_name(sweep.opened_by(estimator), containment); });
        }
      if (std::ranges::find(names, option->estimator) == names.end())
        throw InputError(fmt::format("parameter {}: the sweep does not run this estimator; expected one of {}",
                                     in_quotes(key), listed(names)));
    }
}

}  // namespace

void refuse_other_programs(const StoredCells& stored, const fs::path& folder, bool on_any_processor) {
  for (const std::string& program : stored.programs())
    if (on_any_processor ? build_of(program) != build_of(this_program()) : program != this_program())
      throw InputError(fmt::format(
          "{}: holds points of another program ({}) than this one ({}); go on with that one, or run the whole sweep "
          "again, in another folder or without --resume",
          folder.string(), name_of_program(program), this_program()));
}

SweepCell run_point(const Sweep& sweep, std::size_t point, const ContainmentOptions& containment) {
  if (sweep.grid.measures_limits()) return limits_at(sweep, point);
  SweepCell cell{point, {}};
  ArmModel model;
  SimulationResult data;
  const std::string no_data = failure_of([&] {
    check_point(sweep, point, "the sweep");
    model = model_of_point(sweep, point);
    data = simulate_homed(faster(sweep.scenario_at(point)), model);
  });
  if (!no_data.empty()) {
    cell.results.assign(sweep.grid.estimators.size(), failure(sweep.grid, "simulation: " + no_data));
    return cell;
  }
  data.measured.source = "the simulated log";
  for (const std::string& estimator : sweep.grid.estimators) {
    const std::string opened_by = sweep.opened_by(estimator);
    const std::string reason = failure_of([&] {
      const Comparison comparison =
          compare_estimators(model, {opened_by}, data.measured, data.truth,
                             {.skip_s = sweep.grid.skip_s, .make_all_first = false, .containment = containment});
      cell.results.push_back(result_of(sweep.grid, comparison));
    });
    if (!reason.empty())
      cell.results.push_back(failure(sweep.grid, boost::replace_all_copy(reason, opened_by, estimator)));
  }
  return cell;
}

void check_estimators(const Sweep& sweep, const ContainmentOptions& containment, bool keep_going) {
  const SweepGrid& grid = sweep.grid;
  const auto do_check = [&](const std::function<void()>& check) {
    return keep_going ? leave_failures_to_the_runs(check) : check();
  };
  const auto check_all = [&](const ArmModel& model) {
    for (const std::string& name : grid.estimators)
      do_check([&] { check_estimator(sweep.opened_by(name), model, containment); });
  };
  const ArmModel first = sweep.model_at(0);
  try {
    check_all(first);
    check_names_of_options(sweep, containment, do_check);
  } catch (const InputError& error) {
    throw InputError(grid.file.empty() ? error.what() : grid.file + ": " + error.what());
  }
  for (const SweepAxis& axis : grid.axes)
    for (const std::string& key : axis.parameters) {
      const auto option = parse_option_key(key);
      if (!option) continue;
      const auto [least, greatest] = std::ranges::minmax(axis.values);
      for (const double value : {least, greatest}) {
        ArmModel model = first;
        set_option(model, *option, axis.is_factor ? value * option_number(sweep.model, *option).value() : value);
        try {
          check_all(model);
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}, at {} = {:g}: {}", grid.file, axis.label(), value, error.what()));
        }
      }
    }
}

void run_sweep(const Sweep& sweep, const fs::path& folder, const SweepRunOptions& options) {
  check_estimators(sweep, options.containment, true);  // a wrong one is found now, not in every cell
  store_grid(folder, sweep.grid);
  const std::vector<std::size_t> todo = points_to_do(sweep.grid, folder, options);

  CellJournal journal(folder, sweep.grid, options.shard);
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
  std::atomic<std::size_t> done = 0;
  if (options.progress) options.progress(0, todo.size());
  FirstFailure failure;
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for_each(todo, [&](std::size_t point) {
      failure.keep(point, [&] {
        journal.add(run_point(sweep, point, options.containment));
        if (const std::size_t now = ++done; options.progress) options.progress(now, todo.size());
      });
    });
  });
  failure.rethrow();
}

}  // namespace halyard
