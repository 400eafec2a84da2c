#pragma once
/// Residuals of a joint, and signals that they may depend on.
///
///   joint position   q measured - q predicted                                               rad | m
///   motor torque     τ commanded - τ required by the motors' motion                         N m
///   transmission     q implied by the motors without stretch - q measured                   rad | m
///   joint torque     force of cables, friction and load along the measured motion of motors
///                    and joints - M q'' - h                                                 N m | N
///
/// A diagnosis fits the first two. If the cable's model is right, the transmission residual is the stretch alone. The
/// joint torque residual exists only if all joints have a cable and a sensor; effects' states start at 0 in it. The
/// other signals are computed from the motors' motion and the model, independently of the residuals.

#include <array>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

enum class ResidualKind { joint_position, motor_torque, transmission, joint_torque };
inline constexpr std::array kResidualKinds = {ResidualKind::joint_position, ResidualKind::motor_torque,
                                              ResidualKind::transmission, ResidualKind::joint_torque};

/// [samples] each, all records joined end to end; NaN where a sample cannot be compared; empty: unknown for this joint.
struct ResidualSignals {
  double dt = 0;  ///< s, between samples
  std::array<std::vector<double>, kResidualKinds.size()> residual;
  std::vector<double> time;                              ///< on the common clock (common_clock.h), s
  std::vector<double> joint_position;                    ///< implied by the motors, rad | m
  std::vector<double> joint_rate, motor_rate;            ///< rad/s | m/s, rad/s
  std::vector<double> joint_direction, motor_direction;  ///< 1 | -1: direction of the last motion above noise
  std::vector<double> load;                              ///< cable force required by the motion, without friction, N
  std::vector<double> stretch;                           ///< predicted, m
  std::vector<double> motor_angle, capstan_angle;        ///< rad, not wrapped

  const std::vector<double>& of(ResidualKind kind) const { return residual[static_cast<std::size_t>(kind)]; }
};

/// Signals of one 0-based joint at about 100 Hz; hypothesis: the one that made the predictions.
ResidualSignals residual_signals(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions,
                                 const Hypothesis& hypothesis, int joint);

}  // namespace halyard
