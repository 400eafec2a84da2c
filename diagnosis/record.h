#pragma once
/// A log made ready for diagnosis: one uniform time grid, and motions, rates, accelerations and
/// torques that all went through one zero-phase low-pass filter, so that they stay comparable.
///
///   q_m = K_m * reading,  q_m' = K_m' * reading,  q_m'' = K_m'' * reading,  τ = K_m * command
///   e   = K_c * (measured - predicted)
///
///   K_m, K_c   Gaussian kernels of standard deviation σ_t = 1 / (2π f), f = motion_hz and compare_hz, normalised
///              so that constants, ramps and parabolas keep their value, slope and curvature
///
/// Differentiating the kernel instead of the reading is what keeps encoder quantisation out of
/// q_m''; filtering the torque with the same kernel keeps J q_m'' = τ - ... true (Gautier, 1997). The band of the
/// motion is wide, so that friction turns where the motor turns; what noise that lets in, K_c takes out of the
/// residual.
///
/// Sensors need not share a sample rate. The grid is that of the fastest; between samples of its own a signal goes on
/// by cubic Hermite interpolation, but only where a sample was measured it is compared: K_c runs over those alone.
///
/// A joint without a motor (drive none) moves as its own sensor says, or stands at home if the log has none.

#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// [n_joints][n_samples] everywhere; weights are 0 or 1.
struct Record {
  int n = 0;
  double dt = 0;     ///< s
  double start = 0;  ///< time of the first sample, s
  std::size_t size = 0;
  /// Readings: encoder offsets still inside. Of a joint without a motor: the joint's own motion, rad | m.
  Signals motor_angle, motor_rate, motor_acceleration;
  Signals torque;                           ///< commanded, N m; the hold's half sample of delay removed
  Signals joint;                            ///< joint reading through K_m; empty: no sensor
  Signals joint_raw;                        ///< the reading itself, interpolated between its samples
  Signals external;                         ///< measured load on the joint; empty: none
  Signals joint_measured, torque_measured;  ///< 1 at the grid points nearest to the signal's own samples
  Signals joint_valid, torque_valid;        ///< 0 where a sample cannot be compared
  double motion_sigma = 0;                  ///< σ_t of K_m, s
  std::vector<double> compare;              ///< K_c on this grid, [2 reach + 1]
  std::string source;
  int place = -1;  ///< among the records of an Evidence; -1: of none

  double time(std::size_t i) const { return start + dt * static_cast<double>(i); }
  bool has_joint(int k) const { return !joint[k].empty(); }
  bool has_torque(int k) const { return !torque[k].empty(); }
};

struct RecordOptions {
  double motion_hz = 60;   ///< of K_m
  double compare_hz = 20;  ///< of K_c; 0: residuals as they are
  double settle_s = 0.5;   ///< from the start of a record: its unknown past fades out, not compared
  double step_s = 0.002;   ///< grid, at most: a whole number of the fastest sensor's samples, or a whole share of one
  double longest_gap_s = 0.05;  ///< longer gaps in a motor's position split a log into several records
};

/// One record per stretch of the log without a long gap; encoders of unknown zero are homed first.
///
/// Left out as telling nothing: sensors that are stuck, see stuck_joint_sensors(); a joint sensor that never changes
/// and whose resolution the model does not state; a torque that is 0 throughout.
/// A command is taken as held for its sample, at most kLongestHold: a slower log is that of a slower logger.
///
/// Throws InputError if no stretch is longer than a second beyond the settling time, or for fewer than ten samples a
/// second; and as home_encoders().
std::vector<Record> make_records(const Log& log, const ArmModel& model, const RecordOptions& options);
inline constexpr double kLongestHold = 0.002;  ///< s

/// Joints, from 0, whose sensor stays where it is to the last bit while its motors would move the joint by more than 5
/// % of its range.
std::vector<int> stuck_joint_sensors(const Log& log, const ArmModel& model);

}  // namespace halyard
