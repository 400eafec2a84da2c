#pragma once
/// A log prepared for diagnosis, on one uniform time grid. Motions, rates, accelerations and torques are filtered by
/// the same zero-phase low-pass filter, so that they stay comparable.
///
///   q_m = K_m * reading,  q_m' = K_m' * reading,  q_m'' = K_m'' * reading,  τ = K_m * command
///   e   = K_c * (measured - predicted)
///
///   K_m, K_c   Gaussian kernels of standard deviation σ_t = 1 / (2π f), f = motion_hz and compare_hz, normalised
///              so that constants, ramps and parabolas keep their value, slope and curvature
///
/// Differentiating the kernel instead of the reading keeps encoder quantisation out of q_m''. Filtering the
/// torque with the same kernel keeps J q_m'' = τ - ... valid (Gautier, 1997). The band of the motion is wide, so
/// that friction reverses when the motor does; K_c removes the additional noise from the residual.
///
/// Sensors may have different sample rates. The grid is that of the fastest. Other signals are interpolated by cubic
/// Hermite polynomials, but residuals are compared only at measured samples: K_c uses those alone.
///
/// A joint without a motor (drive none) follows its own sensor, or stays at home if the log has none.

#include <cmath>
#include <optional>
#include <vector>

#include "diagnosis/motion/chebyshev.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// A reading of a sensor.
struct SensorSample {
  double time = 0, value = 0;
};

/// How the motors move at the first sample of a record that starts in motion; empty: it starts at rest.
struct StartOfMotion {
  std::vector<double> angle, rate, acceleration;  ///< [n_joints], of the motors
  bool is_there() const { return !angle.empty(); }
};

/// [n_joints][n_samples] everywhere; weights are 0 or 1.
struct Record {
  int n = 0;
  double dt = 0;           ///< s
  double start = 0;        ///< time of the first sample, s
  double clock_shift = 0;  ///< s, from the log's clock to the common one (common_clock.h)
  std::size_t size = 0;
  /// Readings, including encoder offsets. For a joint without a motor: the joint's own motion, rad | m.
  Signals motor_angle, motor_rate, motor_acceleration;
  Signals torque;     ///< of the motor, N m; a command is shifted by half the time for which it is held
  Signals joint;      ///< joint reading through K_m; empty: no sensor
  Signals joint_raw;  ///< the reading itself, interpolated between its samples
  Signals external;   ///< measured load on the joint; empty: none
  Signals joint_measured, torque_measured;               ///< 1 at the grid points nearest to the signal's own samples
  std::vector<std::vector<SensorSample>> joint_samples;  ///< [n_joints] the readings as they were taken
  Signals joint_valid, torque_valid;                     ///< 0 where a sample cannot be compared
  double motion_sigma = 0;                               ///< σ_t of K_m, s
  double compare_sigma = 0;                              ///< σ_t of K_c, s; 0: residuals are not filtered
  std::vector<double> compare;                           ///< K_c on this grid, [2 reach + 1]
  std::string source;
  int most_stages = RungeKuttaChebyshev::kUsualStages;  ///< of the integration by a hypothesis, see chebyshev.h
  StartOfMotion first_motion;                           ///< see start_of_motion.h
  std::optional<std::size_t> place;                     ///< index among the records of an Evidence that it belongs to

  /// Of both filters together: a compared reading has passed K_m and K_c.
  double filter_sigma() const { return std::hypot(motion_sigma, compare_sigma); }
  double time(std::size_t i) const { return start + dt * static_cast<double>(i); }
  bool has_joint(int k) const { return !joint[k].empty(); }
  bool has_torque(int k) const { return !torque[k].empty(); }
};

struct RecordOptions {
  double motion_hz = 60;   ///< of K_m
  double compare_hz = 20;  ///< of K_c; 0: residuals are not filtered
  /// Start of a record that is not compared, because its past is unknown; longer for an arm that swings longer, see
  /// settling.h. 0: all is compared.
  double settle_s = 0.5;
  /// largest grid step; the grid step is the fastest sensor's interval, multiplied or divided by a whole number
  double step_s = 0.002;
  double slow_sensors_late_s = 0;  ///< readings of joint sensors slower than their motor's are moved earlier by this
  double longest_gap_s = 0.05;     ///< longer gaps in a motor's position split a log into several records
};

/// One record per stretch of the log without a long gap; encoders of unknown zero are homed first.
///
/// These signals are left out: sensors that are stuck, see stuck_joint_sensors(); a joint sensor that never changes and
/// whose resolution the model does not state; a torque that is always 0.
/// A command is assumed to be held for seconds_held().
///
/// Hypotheses may take more stages than usual if the model itself needs them, as with a joint that is light for its
/// friction.
///
/// Throws InputError if a motor's position is not in the log, if no stretch is at least a second longer than the
/// settling time, or if there are fewer than ten samples a second; and as home_encoders() does.
std::vector<Record> make_records(const Log& log, const ArmModel& model, const RecordOptions& options);

/// For how long a motor's torque is that of its sample, s: until the next sample, but at most for kLongestHold, since a
/// longer interval is assumed to be the logger's and not the controller's. 0 for a torque that is measured.
/// interval: the usual time from one of its samples to the next, s.
double seconds_held(double interval, TorqueSource source);
inline constexpr double kLongestHold = 0.002;  ///< s
/// Before a record that starts in motion the arm is taken to have moved with the same acceleration for so long, s.
inline constexpr double kRunIn = 0.12;

/// True if the sensor of joint k is slower than its motor's encoder, and so has a clock of its own: one reading in
/// fifty or more comes after a reading of the encoder that the sensor lacks.
bool has_slow_joint_sensor(const Log& log, const ArmModel& model, int k);

/// 0-based joints whose sensor does not change by a single bit while the motors move the joint by more than 5 % of its
/// range.
std::vector<int> stuck_joint_sensors(const Log& log, const ArmModel& model);

}  // namespace halyard
