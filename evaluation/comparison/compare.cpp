#include "evaluation/comparison/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "estimators/process/noise.h"
#include "evaluation/run/sensor_readings.h"
#include "model/input_error.h"

namespace halyard {
namespace {

/// What counts: from skip_s after the first sample on.
class Counted {
 public:
  Counted(const Log& truth, double skip_s) : first_(first_counted_sample(truth.time, skip_s)) {}
  std::span<const double> operator()(const std::vector<double>& column) const {
    return std::span(column).subspan(std::min(first_, column.size()));
  }

 private:
  std::size_t first_;
};

/// Standard deviations [n][samples] of what is compared, 0 where the estimator has none: if a joint sensor counts as
/// the truth, together with the rounding and the noise that the model states for it.
Signals deviations_of(const EstimatorRun& run, const ArmModel& model, bool truth_is_sensed) {
  Signals deviations = run.joint_position_std;
  if (!truth_is_sensed) return deviations;
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& joint = model.nominal.joint[k];
    const double sensor = reading_deviation(joint.joint_encoder_resolution, joint.joint_encoder_noise);
    for (double& deviation : deviations[k])
      if (deviation > 0) deviation = std::hypot(deviation, sensor);
  }
  return deviations;
}

std::vector<ErrorStatistics> joint_errors(const Signals& compared, const Signals& deviations, const Log& truth,
                                          const Counted& counted) {
  std::vector<ErrorStatistics> errors(truth.n_joints);
  for (int k = 0; k < truth.n_joints; ++k)
    if (truth.has_joint_position(k))
      errors[k] = error_statistics(counted(compared[k]), counted(truth.joint_position[k]), counted(deviations[k]));
  return errors;
}

/// Harmonic mean of the numbers of motors that an update used, over the samples with a NIS.
double readings_of_an_update(const EstimatorRun& run, const Counted& counted) {
  const std::span<const double> nis = counted(run.nis);
  double updates = 0, inverse = 0;
  for (std::size_t i = 0; i < nis.size(); ++i) {
    if (std::isnan(nis[i])) continue;
    const auto used = std::ranges::count_if(
        run.innovation, [&](const std::vector<double>& motor) { return !std::isnan(counted(motor)[i]); });
    updates += 1, inverse += 1 / static_cast<double>(std::max<std::ptrdiff_t>(1, used));
  }
  return updates > 0 ? updates / inverse : 1;
}

Judgement judge(const EstimatorRun& run, const Signals& compared, const Signals& deviations, const Log& measured,
                const Log& truth, const Counted& counted) {
  Judgement judgement;
  judgement.nis = consistency(counted(run.nis), readings_of_an_update(run, counted));
  for (int k = 0; k < truth.n_joints; ++k) {
    std::vector<double> squares;
    if (truth.has_joint_position(k))
      squares = normalised_squares(counted(compared[k]), counted(truth.joint_position[k]), counted(deviations[k]));
    judgement.nees.push_back(consistency(squares));
    judgement.whiteness.push_back(whiteness(counted(run.innovation[k]), counted(measured.motor_torque[k])));
  }
  return judgement;
}

std::vector<double> errors_of(const Signals& compared, const Log& truth, int k, const Counted& counted) {
  const auto estimate = counted(compared[k]), right = counted(truth.joint_position[k]);
  std::vector<double> errors;
  for (std::size_t i = 0; i < estimate.size(); ++i) errors.push_back(estimate[i] - right[i]);
  return errors;
}

/// What the action returns; if the estimator fails and that is to leave a row without numbers, such a row.
template <class Action>
EstimatorRun attempt(const std::string& name, const Log& measured, bool keep_going, const Action& action) {
  try {
    return action();
  } catch (const std::exception& error) {
    if (!keep_going || !is_failure_of_the_estimator(error)) throw;
    EstimatorRun none = no_run(name, measured);
    none.failure = error.what();
    none.refused = dynamic_cast<const EstimatorRefusal*>(&error);
    return none;
  }
}

std::vector<EstimatorRun> run_all(const std::vector<Contestant>& contestants, const Log& measured,
                                  const CompareOptions& options) {
  std::vector<EstimatorRun> runs;
  for (const Contestant& c : contestants)
    runs.push_back(attempt(c.name, measured, options.keep_going, [&] {
      if (options.make_all_first) check_estimator(c.estimator, *c.model, options.containment);
      return EstimatorRun{};
    }));
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Contestant& c = contestants[i];
    EstimateOptions estimate{.use_joint_torque = options.use_joint_torque, .progress = {}};
    if (options.progress)
      estimate.progress = [&](double fraction) {
        options.progress((double(i) + fraction) / double(contestants.size()));
      };
    if (runs[i].failure.empty())
      runs[i] = attempt(c.name, measured, options.keep_going,
                        [&] { return run_contained(c.estimator, *c.model, measured, estimate, options.containment); });
    runs[i].name = c.name;
  }
  return runs;
}

/// RMS errors of each run over those of each other one.
void compare_pairs(Comparison& result, const Counted& counted) {
  const std::size_t n_runs = result.runs.size();
  result.paired.assign(n_runs, {n_runs, std::vector<PairedRatio>(result.units.size())});
  for (std::size_t a = 0; a < n_runs; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (int k = 0; k < result.n_joints(); ++k) {
        if (!result.has_truth(k)) continue;
        result.paired[a][b][k] = paired_ratio(errors_of(result.compared[a], result.truth, k, counted),
                                              errors_of(result.compared[b], result.truth, k, counted));
        result.paired[b][a][k] = result.paired[a][b][k].inverse();
      }
}

}  // namespace

std::optional<std::size_t> Comparison::baseline() const {
  const auto found = std::ranges::find(runs, "kinematics", &EstimatorRun::name);
  if (found == runs.end()) return std::nullopt;
  return static_cast<std::size_t>(found - runs.begin());
}

double Comparison::improvement_of(std::size_t run, int k) const {
  const std::optional<std::size_t> base = baseline();
  if (!base) return std::numeric_limits<double>::quiet_NaN();
  return improvement(errors[run][k], errors[*base][k]);
}

void check_skip(double skip_s, double duration_s, const std::string& of) {
  if (skip_s < duration_s) return;
  throw InputError(
      fmt::format("{}: lasts {:g} s, and the first {:g} s are skipped; nothing is left to count errors in: "
                  "skip less",
                  of, duration_s, skip_s));
}

Comparison compare_estimators(const ArmModel& model, const std::vector<std::string>& estimators, const Log& measured,
                              const Log& truth, const CompareOptions& options) {
  std::vector<Contestant> contestants;
  for (const std::string& name : estimators) contestants.push_back({name, &model, name});
  return compare_estimators(contestants, measured, truth, options);
}

Comparison compare_estimators(const std::vector<Contestant>& contestants, const Log& measured, const Log& truth,
                              const CompareOptions& options) {
  if (contestants.empty()) throw std::invalid_argument("compare_estimators: no estimator");
  if (measured.time != truth.time) throw std::invalid_argument("compare_estimators: times of truth and log differ");
  const Counted counted(truth, options.skip_s);
  Comparison result;
  result.skip_s = options.skip_s;
  result.with_joint_torque = options.use_joint_torque;
  result.with_marker = measured.has_marker();
  result.units = joint_units(*contestants.front().model);
  result.truth = truth;
  result.runs = run_all(contestants, measured, options);
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const EstimatorRun& run = result.runs[i];
    result.compared.push_back(options.truth_is_sensed ? sensor_readings(*contestants[i].model, run)
                                                      : run.estimates.joint_position);
    const Signals deviations = deviations_of(run, *contestants[i].model, options.truth_is_sensed);
    result.errors.push_back(joint_errors(result.compared[i], deviations, truth, counted));
    result.judgements.push_back(judge(run, result.compared[i], deviations, measured, truth, counted));
  }
  compare_pairs(result, counted);
  return result;
}

}  // namespace halyard
