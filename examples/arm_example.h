#pragma once
/// Shared by the examples: the RAVEN-II arm following sines, and the errors of an estimator.

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "estimators/log_sample.h"
#include "model/model_file.h"
#include "plant/simulate.h"

namespace halyard {

inline ArmModel raven2() { return read_model(HALYARD_EXAMPLES "/raven2/raven2.xml"); }

/// The arm follows the paper's sines, faded in over 1 s, with encoders rounded. Deterministic.
inline Scenario on_sines(const ArmModel& robot, double duration_s) {
  Scenario scenario;
  scenario.robot = robot;
  scenario.duration_s = duration_s;
  scenario.fade_in_s = 1;
  const double frequency_hz[] = {0.3424, 0.3852, 0.4565};
  for (int k = 0; k < robot.n(); ++k) {
    JointTrajectory path;
    path.kind = JointTrajectory::Kind::sines;
    path.center = robot.joints[k].home;
    const bool turns = robot.nominal.joint[k].type == JointType::revolute;
    path.sines = {{turns ? 25 * std::numbers::pi / 180 : 0.040, frequency_hz[k % 3], 0}};
    scenario.trajectory.push_back(path);
  }
  return scenario;
}

/// RMS error of an estimator's joint positions over a run, [n], rad | m; the first half second is left out.
inline Eigen::VectorXd rms_error(Estimator& estimator, const SimulationResult& run) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(run.truth.n_joints);
  long count = 0;
  estimator.reset(sample_of(run.measured, 0));
  for (std::size_t i = 1; i < run.measured.size(); ++i) {
    estimator.update(sample_of(run.measured, i));
    if (run.measured.time[i] < 0.5) continue;
    const Eigen::VectorXd q = estimator.estimate().joint_position;
    for (int k = 0; k < q.size(); ++k) sum(k) += std::pow(q(k) - run.truth.joint_position[k][i], 2);
    ++count;
  }
  return (sum / static_cast<double>(count)).cwiseSqrt();
}

/// A joint coordinate as text, in degrees or millimetres: "0.2310 deg", "0.2200 mm".
inline std::string in_units(const ArmModel& arm, int k, double value) {
  return arm.nominal.joint[k].type == JointType::revolute ? fmt::format("{:.4f} deg", value * 180 / std::numbers::pi)
                                                          : fmt::format("{:.4f} mm", value * 1e3);
}

}  // namespace halyard
