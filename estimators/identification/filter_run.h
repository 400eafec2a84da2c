#pragma once
/// Runs a dual filter over logs, one after the other.

#include <functional>
#include <limits>
#include <vector>

#include "estimators/identification/dual_ukf.h"
#include "model/log.h"

namespace halyard {

inline double duration_of(const std::vector<Log>& logs) {
  double whole = 0;
  for (const Log& log : logs) whole += log.duration();
  return whole;
}

/// Calls visit(step, time) for each sample of the logs; time goes on from log to log.
template <class Visit>
void run_filter(DualUkf& filter, const std::vector<Log>& logs, const std::function<void(double)>& progress,
                const Visit& visit) {
  double before = 0;
  const double whole = duration_of(logs);
  for (const Log& log : logs) {
    filter.start_record();
    const auto n = static_cast<Eigen::Index>(log.n_joints);
    const auto cell = [](const std::vector<double>& column, std::size_t i) {
      return column.empty() ? std::numeric_limits<double>::quiet_NaN() : column[i];
    };
    EncoderSample sample;
    sample.motor_torque.resize(n), sample.motor_position.resize(n), sample.joint_position.resize(n);
    sample.joint_torque.resize(n);
    for (std::size_t i = 0; i < log.size(); ++i) {
      sample.time_s = log.time[i];
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto j = static_cast<std::size_t>(k);
        sample.motor_torque(k) = cell(log.motor_torque[j], i);
        sample.motor_position(k) = cell(log.motor_position[j], i);
        sample.joint_position(k) = cell(log.joint_position[j], i);
        sample.joint_torque(k) = cell(log.joint_torque[j], i);
      }
      const double time = before + log.time[i] - log.time[0];
      visit(filter.update(sample), time);
      if (progress && i % 200 == 0) progress(time / whole);
    }
    before += log.duration();
  }
}

}  // namespace halyard
