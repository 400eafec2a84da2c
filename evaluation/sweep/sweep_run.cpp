#include "evaluation/sweep/sweep_run.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for_each.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "evaluation/comparison/compare.h"
#include "evaluation/run/contained_run.h"
#include "evaluation/sweep/measures/sweep_limits.h"
#include "evaluation/sweep/parameters/estimator_option.h"
#include "evaluation/sweep/sweep_store.h"
#include "model/input_error.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// Points of the shard that are still to be computed; a journal that does not count is removed.
std::vector<std::size_t> points_to_do(const SweepGrid& grid, const fs::path& folder, const SweepRunOptions& options) {
  const StoredCells stored({folder}, grid);
  std::vector<std::size_t> todo;
  std::size_t discarded = 0;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    if (!options.shard.holds(point)) continue;
    if (!(options.resume && stored.has(point))) todo.push_back(point);
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

SweepCell limits_at(const Sweep& sweep, std::size_t point) {
  SweepCell cell{point, {}};
  try {
    check_point(sweep, point, "the sweep");
    for (auto& limits : limits_of(sweep.grid.effects, sweep.scenario_at(point), sweep.model_at(point)))
      cell.results.push_back({"", std::move(limits)});
  } catch (const std::exception& error) {
    cell.results.assign(sweep.grid.n_subjects(), failure(sweep.grid, error.what()));
  }
  return cell;
}

}  // namespace

SweepCell run_point(const Sweep& sweep, std::size_t point, const ContainmentOptions& containment) {
  if (sweep.grid.measures_limits()) return limits_at(sweep, point);
  SweepCell cell{point, {}};
  SimulationResult data;
  try {
    check_point(sweep, point, "the sweep");
    data = simulate(faster(sweep.scenario_at(point)));
  } catch (const std::exception& error) {
    cell.results.assign(sweep.grid.estimators.size(), failure(sweep.grid, std::string("simulation: ") + error.what()));
    return cell;
  }
  data.measured.source = "the simulated log";
  const ArmModel model = sweep.model_at(point);
  for (const std::string& estimator : sweep.grid.estimators) {
    try {
      const Comparison comparison = compare_estimators(model, {estimator}, data.measured, data.truth,
                                                       {.skip_s = sweep.grid.skip_s, .containment = containment});
      cell.results.push_back(result_of(sweep.grid, comparison));
    } catch (const std::exception& error) {
      cell.results.push_back(failure(sweep.grid, error.what()));
    }
  }
  return cell;
}

void check_estimators(const Sweep& sweep, const ContainmentOptions& containment) {
  const SweepGrid& grid = sweep.grid;
  const ArmModel first = sweep.model_at(0);
  try {
    for (const std::string& estimator : grid.estimators) check_estimator(estimator, first, containment);
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
          for (const std::string& estimator : grid.estimators) check_estimator(estimator, model, containment);
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}, at {} = {:g}: {}", grid.file, axis.label(), value, error.what()));
        }
      }
    }
}

void run_sweep(const Sweep& sweep, const fs::path& folder, const SweepRunOptions& options) {
  check_estimators(sweep, options.containment);  // a wrong one is found now, not in every cell

  if (options.resume) check_same_sweep(folder, sweep.grid);
  store_grid(folder, sweep.grid);
  const std::vector<std::size_t> todo = points_to_do(sweep.grid, folder, options);

  CellJournal journal(folder, sweep.grid, options.shard);
  namespace tbb = oneapi::tbb;
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
  std::atomic<std::size_t> done = 0;
  if (options.progress) options.progress(0, todo.size());
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for_each(todo, [&](std::size_t point) {
      journal.add(run_point(sweep, point, options.containment));
      if (const std::size_t now = ++done; options.progress) options.progress(now, todo.size());
    });
  });
}

}  // namespace halyard
