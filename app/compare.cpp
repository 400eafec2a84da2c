#include "app/compare.h"

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>

#include "plugins/loader.h"

namespace halyard {
namespace {

std::vector<ErrorStatistics> joint_errors(const EstimatorRun& run, const Log& truth, double skip_s) {
  const std::size_t first = first_counted_sample(truth.time, skip_s);
  std::vector<ErrorStatistics> errors(truth.n_joints);
  for (int k = 0; k < truth.n_joints; ++k) {
    if (!truth.has_joint_position(k)) continue;
    const auto counted = [first](const std::vector<double>& column) { return std::span(column).subspan(first); };
    errors[k] = error_statistics(counted(run.estimates.joint_position[k]), counted(truth.joint_position[k]),
                                 counted(run.joint_position_std[k]));
  }
  return errors;
}

}  // namespace

int Comparison::baseline() const {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].name == "kinematics") return static_cast<int>(i);
  }
  return -1;
}

double Comparison::improvement_of(std::size_t run, int k) const {
  const int base = baseline();
  if (base < 0) return std::numeric_limits<double>::quiet_NaN();
  return improvement(errors[run][k], errors[base][k]);
}

Comparison compare_estimators(const ArmModel& model, const std::vector<std::string>& estimators, const Log& measured,
                              const Log& truth, const CompareOptions& options) {
  if (measured.time != truth.time) throw std::invalid_argument("compare_estimators: times of truth and log differ");
  Comparison result;
  result.skip_s = options.skip_s;
  result.units = joint_units(model);
  result.truth = truth;

  // All are made first: a wrong name must not cost the time of the others' runs.
  std::vector<std::unique_ptr<Estimator>> made;
  for (const std::string& name : estimators) made.push_back(make_estimator(name, model));
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    EstimateOptions estimate{.use_joint_torque = options.use_joint_torque, .progress = {}};
    if (options.progress) {
      estimate.progress = [&](double fraction) {
        options.progress((double(i) + fraction) / double(estimators.size()));
      };
    }
    result.runs.push_back(run_estimator(*made[i], estimators[i], measured, estimate));
    made[i].reset();
    result.errors.push_back(joint_errors(result.runs.back(), truth, options.skip_s));
  }
  return result;
}

}  // namespace halyard
