#include "model/homing.h"

#include <cmath>
#include <limits>

#include "model/input_error.h"
#include "model/statistics/quantile.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kHomingTime = 1;  ///< s from the first sample at which both sides have readings

/// The last readings of a log's sensors, which need not share their rows. NaN: none yet.
struct Latest {
  Eigen::VectorXd motor, joint;

  explicit Latest(int n)
      : motor(Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN())), joint(motor) {}
  void see(const Log& log, std::size_t row) {
    const auto take = [row](const std::vector<double>& column, double& last) {
      if (!column.empty() && !std::isnan(column[row])) last = column[row];
    };
    for (int k = 0; k < log.n_joints; ++k) take(log.motor_position[k], motor(k)), take(log.joint_position[k], joint(k));
  }
};

/// The arm as its filters know it: with the changes of the model's effects.
struct KnownArm {
  ArmParameters<double> parameters;
  Eigen::VectorXd home;
};

/// Joint positions by the motors.
Eigen::VectorXd by_motors(const Latest& latest, const KnownArm& known) {
  const ArmParameters<double>& arm = known.parameters;
  Eigen::VectorXd q_m(arm.n), undriven = known.home;
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    q_m(k) = j.drive == Drive::none ? 0 : latest.motor(k) - j.motor_encoder_offset;
    if (!std::isnan(latest.joint(k))) undriven(k) = latest.joint(k) - j.joint_encoder_offset;
  }
  return unstretched_joints(arm, q_m, undriven);
}

/// What motor k's encoder would read by the joints' sensors, or by the motors where a joint inboard has none. NaN
/// before its own joint has a reading.
double told_of_motor(const Latest& latest, const KnownArm& known, int k) {
  const ArmParameters<double>& arm = known.parameters;
  if (std::isnan(latest.joint(k))) return latest.joint(k);
  Eigen::VectorXd q = by_motors(latest, known);
  for (int j = 0; j < arm.n; ++j) {
    const bool is_told = !std::isnan(latest.joint(j)) && arm.joint[j].joint_zero_known;
    if (is_told) q(j) = latest.joint(j) - arm.joint[j].joint_encoder_offset;
    if (j > k) q(j) = 0;  // a cable's path runs over its own joint and those inboard
  }
  return unstretched_motors(arm, q)(k) + arm.joint[k].motor_encoder_offset;
}

void home_one(Log& log, const KnownArm& known, int k, bool motor) {
  Latest latest(known.parameters.n);
  std::vector<double> zero;
  double end = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < log.size() && log.time[i] <= end; ++i) {
    latest.see(log, i);
    const bool is_new = !log.joint_position[k].empty() && !std::isnan(log.joint_position[k][i]);
    if (!is_new) continue;  // the motor has moved since an older reading
    const double z =
        motor ? latest.motor(k) - told_of_motor(latest, known, k)
              : latest.joint(k) - by_motors(latest, known)(k) - known.parameters.joint[k].joint_encoder_offset;
    if (!std::isfinite(z)) continue;
    if (zero.empty()) end = log.time[i] + kHomingTime;
    zero.push_back(z);
  }
  if (zero.empty())
    throw InputError(
        log.source + ": the readings of motors and joint " + std::to_string(k + 1) +
        " that tell the zero of its encoder are missing; give a log with them, or the offset in the model");
  const double usual = median(std::move(zero));
  for (double& reading : motor ? log.motor_position[k] : log.joint_position[k]) reading -= usual;
}

}  // namespace

void home_encoders(Log& log, const ArmModel& model) {
  const KnownArm known{arm_with_effects(model), model.home()};
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    const std::string number = std::to_string(k + 1);
    if (!j.motor_zero_known && !log.has_joint_position(k))
      throw InputError(log.source + ": the model does not know the zero of motor encoder " + number +
                       " (motor_offset=\"unknown\"), and the log has no joint_position_" + number +
                       " to tell it; give the joint's sensor, or the offset in the model");
    if (!j.motor_zero_known) home_one(log, known, k, true);
    if (!j.joint_zero_known && log.has_joint_position(k)) home_one(log, known, k, false);
  }
}

}  // namespace halyard
