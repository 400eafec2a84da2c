#pragma once
/// What the sensors of a trial make of the joints' motion and of the motors' torques.
///
///   reading_j = round(q(t_j - latency + jitter_j) + noise_j),   t_j: of the first row of the log after j / rate
///
///                                        good        poor                                motors
///   rate                                 all rows    log-uniform 30 Hz to 1 kHz          no joint sensors
///   noise, white, of each joint          0 to 1      0 to 30 counts
///   latency                              0           half of the logs: 0; others: 0 to 20 ms
///   jitter, white                        0           0 to 10 % of the interval
///   readings missing one by one          none        0 to 5 %
///   stretches missing, of each joint     none        0 to 2, log-uniform 50 ms to 1 s
///   noise of the logged torque           0 to 2 %    0 to 20 % of the motor's friction   as poor
///
/// The latency is 0 where a `delay` is hidden. Uniform where nothing else is said; noise and jitter are standard
/// deviations. q contains the errors of hidden effects, such as an eccentric encoder. The motors are read by every row,
/// rounded, as the plant reads them.

#include "bench/diagnosis/results/situation.h"
#include "diagnosis/rehearsal/random.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard::blind {

struct SensorDraw {
  bool sees_joints = true;
  double interval_s = 0;  ///< from one reading of a joint to the next; 0: every row
  double latency_s = 0, jitter_s = 0;
  double missing_share = 0, outlier_share = 0;
  std::vector<double> noise;         ///< rad | m, [n]
  std::vector<double> torque_noise;  ///< N m, [n]
  struct Stretch {
    int joint;
    double from_s, to_s;
  };
  std::vector<Stretch> missing;
};

/// `from_s`, `to_s`: where stretches may be missing.
SensorDraw draw_sensors(Sensors kind, const ArmModel& model, double from_s, double to_s, Random& random);
/// Every row, without noise; only rounded.
SensorDraw ideal_sensors(const ArmModel& model);

/// The log as these sensors write it. `exact`: rows at every control period, joint readings neither noisy nor rounded.
Log read_sensors(const SensorDraw& sensors, const Log& exact, const ArmModel& model, Random& random);

}  // namespace halyard::blind
