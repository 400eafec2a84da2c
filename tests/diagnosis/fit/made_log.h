#pragma once
/// Logs of the RAVEN-II's first joint that are made by hand: no simulation, so that a test takes milliseconds.

#include <cmath>

#include "diagnosis/fit/evidence.h"
#include "tests/support/short_arm.h"

namespace halyard {

/// The joint is at position(t), and its motor where a cable has it that does not stretch. No torque.
template <class Position>
Log log_along(double duration, double rate_hz, const Position& position) {
  const JointParameters<double> j = first_joints(1).nominal.joint[0];
  Log log(1);
  for (int i = 0; i <= std::lround(duration * rate_hz); ++i) {
    const double t = i / rate_hz, q = position(t);
    log.time.push_back(t);
    log.motor_position[0].push_back(q * j.pulley_radius / j.motor_travel());
    log.joint_position[0].push_back(q);
  }
  return log;
}

/// From 0.5 to 1.1 rad and back within 3.7 s; the fastest is 0.51 rad/s.
inline double slow_swing(double t) { return 0.8 - 0.3 * std::cos(1.7 * t); }

/// Of four seconds of the slow swing, with a torque that is made up. Its blocks are those of 0.25 s.
inline const Evidence& made_evidence() {
  static const Evidence once = [] {
    const ArmModel model = first_joints(1);
    Log log = log_along(4, 100, slow_swing);
    for (const double t : log.time) log.motor_torque[0].push_back(0.05 * std::cos(1.7 * t));  // N m
    return Evidence(make_records(log, model, {}), model);
  }();
  return once;
}

}  // namespace halyard
