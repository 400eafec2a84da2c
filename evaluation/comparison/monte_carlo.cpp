#include "evaluation/comparison/monte_carlo.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/comparison/compare.h"
#include "model/input_error.h"
#include "model/machine/first_failure.h"
#include "model/statistics/quantile.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Instants of a run that the mean NEES over all runs is taken at.
constexpr std::size_t kInstants = 500;
/// Runs whose NEES are in memory at a time.
constexpr int kBatch = 256;

/// What one estimator made of one run.
struct OneRun {
  std::string failure;
  std::vector<ErrorStatistics> errors;
  Judgement judgement;
  Signals nees;  ///< [joint][instant]
};

OneRun run_one(const ArmModel& model, const std::string& name, const SimulationResult& simulation,
               const MonteCarloOptions& options) {
  const Comparison c = compare_estimators(
      model, {name}, simulation.measured, simulation.truth,
      {.skip_s = options.skip_s, .keep_going = true, .make_all_first = false, .containment = options.containment});
  OneRun one{c.runs[0].failure, c.errors[0], c.judgements[0], {}};
  if (!one.failure.empty()) return one;
  const std::size_t size = c.truth.size(), first = first_counted_sample(c.truth.time, options.skip_s);
  const std::size_t step = std::max<std::size_t>(1, (size - first) / kInstants);
  for (int k = 0; k < c.n_joints(); ++k) {
    const std::vector<double> squares =
        normalised_squares(c.compared[0][k], c.truth.joint_position[k], c.runs[0].joint_position_std[k]);
    one.nees.emplace_back();
    for (std::size_t i = first; i < size; i += step) one.nees.back().push_back(squares[i]);
  }
  return one;
}

ErrorStatistics together(const std::vector<const OneRun*>& runs, int k) {
  ErrorStatistics all;
  double square = 0, absolute = 0, bias = 0, within = 0;
  all.peak = runs.empty() ? kNan : 0;
  for (const OneRun* run : runs) {
    const ErrorStatistics& e = run->errors[k];
    all.samples += e.samples;
    square += e.rms * e.rms, absolute += e.mean_absolute, bias += e.bias, within += e.within_two_std;
    all.peak = std::max(all.peak, e.peak);
  }
  const double n = static_cast<double>(runs.size());
  all.rms = std::sqrt(square / n);
  all.mean_absolute = absolute / n;
  all.bias = bias / n;
  all.within_two_std = within / n;
  return all;
}

/// Adds the NEES of a run to those of the runs before, and forgets them.
void take_nees(OneRun& run, Signals& sum) {
  if (sum.empty()) sum.resize(run.nees.size());
  for (std::size_t k = 0; k < run.nees.size(); ++k) {
    sum[k].resize(run.nees[k].size());
    for (std::size_t i = 0; i < sum[k].size(); ++i) sum[k][i] += run.nees[k][i];
  }
  run.nees.clear();
}

double share_in_band(const std::vector<double>& sum_of_nees, std::size_t n_runs) {
  const double n = static_cast<double>(n_runs);
  const auto [lower, upper] = chi_square_band(n);
  double inside = 0;
  for (const double sum : sum_of_nees) {
    if (std::isnan(sum)) return kNan;
    inside += sum / n >= lower && sum / n <= upper;
  }
  return inside / static_cast<double>(sum_of_nees.size());
}

RunsOfEstimator summed_up(const std::string& name, const std::vector<OneRun>& all, const Signals& sum_of_nees, int n) {
  RunsOfEstimator sum;
  sum.name = name;
  std::vector<const OneRun*> runs;
  for (const OneRun& run : all) {
    if (run.failure.empty()) {
      runs.push_back(&run);
      continue;
    }
    if (sum.failures++ == 0) sum.first_failure = run.failure;
  }
  std::vector<Consistency> nis;
  for (const OneRun* run : runs) nis.push_back(run->judgement.nis);
  sum.nis = consistency_of_runs(nis);
  for (int k = 0; k < n; ++k) {
    std::vector<Consistency> nees;
    std::vector<double> rms;
    for (const OneRun* run : runs) nees.push_back(run->judgement.nees[k]), rms.push_back(run->errors[k].rms);
    sum.nees.push_back(consistency_of_runs(nees));
    sum.errors.push_back(together(runs, k));
    sum.rms_lower.push_back(quantile(rms, 0.025));
    sum.rms_upper.push_back(quantile(rms, 0.975));
    sum.in_band.push_back(runs.empty() ? kNan : share_in_band(sum_of_nees[k], runs.size()));
  }
  return sum;
}

/// Does the work of a run. What is wrong with the run is told with its seed.
template <class Work>
void naming_seed(std::uint64_t seed, const Work& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    if (is_fault_of_the_machine(error)) throw;
    const std::string message = fmt::format("seed {}: {}", seed, error.what());
    if (dynamic_cast<const InputError*>(&error)) throw InputError(message);
    throw std::runtime_error(message);
  }
}

/// Runs that both ended count.
PairedRatio paired(const std::vector<OneRun>& a, const std::vector<OneRun>& b, int k) {
  std::vector<std::pair<double, double>> squares;
  for (std::size_t r = 0; r < a.size(); ++r)
    if (a[r].failure.empty() && b[r].failure.empty())
      squares.push_back({std::pow(a[r].errors[k].rms, 2), std::pow(b[r].errors[k].rms, 2)});
  return paired_ratio_of_runs(squares);
}

}  // namespace

MonteCarlo run_monte_carlo(const Scenario& scenario, const ArmModel& model, const std::vector<std::string>& estimators,
                           const MonteCarloOptions& options) {
  // A wrong name must not cost the runs' time.
  for (const std::string& name : estimators)
    leave_failures_to_the_runs([&] { check_estimator(name, model, options.containment); });
  std::vector<std::vector<OneRun>> all(estimators.size(), std::vector<OneRun>(options.runs));
  std::vector<Signals> sums_of_nees(estimators.size());
  for (int first = 0; first < options.runs; first += kBatch) {
    const int end = std::min(first + kBatch, options.runs);
    for_each_in_parallel(static_cast<std::size_t>(end - first), [&](std::size_t i) {
      const std::size_t r = static_cast<std::size_t>(first) + i;
      Scenario of_run = faster(scenario);
      of_run.seed = scenario.seed + r;
      naming_seed(of_run.seed, [&] {
        const SimulationResult simulation = simulate_homed(of_run, model);
        for (std::size_t e = 0; e < estimators.size(); ++e)
          all[e][r] = run_one(model, estimators[e], simulation, options);
      });
      if (options.run_done) options.run_done(1);
    });
    for (std::size_t e = 0; e < estimators.size(); ++e)
      for (int r = first; r < end; ++r) take_nees(all[e][r], sums_of_nees[e]);
  }

  MonteCarlo result;
  result.runs = options.runs;
  const auto base = std::ranges::find(estimators, "kinematics") - estimators.begin();
  for (std::size_t e = 0; e < estimators.size(); ++e) {
    result.estimators.push_back(summed_up(estimators[e], all[e], sums_of_nees[e], model.n()));
    for (int k = 0; k < model.n(); ++k) {
      const bool has_base = base < std::ssize(estimators) && base != static_cast<std::ptrdiff_t>(e);
      result.estimators.back().against_kinematics.push_back(has_base ? paired(all[e], all[base], k)
                                                                     : PairedRatio{kNan, kNan, kNan, 0});
    }
  }
  return result;
}

}  // namespace halyard
