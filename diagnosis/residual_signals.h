#pragma once
/// Residuals of a joint, and what they may go with.
///
///   joint position   q measured - q predicted                                               rad | m
///   motor torque     τ commanded - τ that the motors' motion needs                          N m
///   transmission     q that the motors imply without any stretch - q measured               rad | m
///   joint torque     force of cables, friction and load along the measured motion of motors
///                    and joints - M q'' - h                                                 N m | N
///
/// The first two are what a diagnosis weighs. The transmission residual is the stretch of a cable that is right, and
/// more than that of one that is not. The joint torque residual is there for arms whose joints all have a cable and a
/// sensor; effects' states start at 0 in it, without a past. What residuals may go with is told by the motors' motion
/// and the model: nothing of a residual is in it.

#include <array>

#include "diagnosis/prediction.h"

namespace halyard {

enum class ResidualKind { joint_position, motor_torque, transmission, joint_torque };
inline constexpr std::array kResidualKinds = {ResidualKind::joint_position, ResidualKind::motor_torque,
                                              ResidualKind::transmission, ResidualKind::joint_torque};

/// [samples] each, all records one after another; NaN where a sample cannot be compared; empty: not known of this
/// joint.
struct ResidualSignals {
  double dt = 0;  ///< s, between samples
  std::array<std::vector<double>, kResidualKinds.size()> residual;
  std::vector<double> time;                              ///< s
  std::vector<double> joint_position;                    ///< as the motors imply it, rad | m
  std::vector<double> joint_rate, motor_rate;            ///< rad/s | m/s, rad/s
  std::vector<double> joint_direction, motor_direction;  ///< 1 | -1: of the last motion that was one
  std::vector<double> load;                              ///< cable's force that the motion needs, friction aside, N
  std::vector<double> stretch;                           ///< predicted, m
  std::vector<double> motor_angle, capstan_angle;        ///< rad, not wrapped

  const std::vector<double>& of(ResidualKind kind) const { return residual[static_cast<std::size_t>(kind)]; }
};

/// Signals of joint k (0-based) at about a hundred samples a second; the hypothesis is the one that predicted.
ResidualSignals residual_signals(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions,
                                 const Hypothesis& hypothesis, int joint);

}  // namespace halyard
