#pragma once
/// What logs are like at their worst, for tests of filters.

#include <limits>
#include <optional>
#include <random>

#include "estimators/estimator.h"

namespace halyard {

/// Tears a record at 1 kHz: the first reading of joint 1's motor is off by a radian of the joint; then rows are
/// missing, one by one and for 2 s, readings or torques are missing, readings stay what they were for 5 ms, or are off
/// by 300 rad.
class TornRecord {
 public:
  TornRecord(const ArmModel& model, std::uint64_t seed) : model_(model), random_(seed) {}

  /// The sample as the log has it; nothing if the row is missing.
  std::optional<Sample> torn(Sample s) {
    const int n = model_.n();
    if (count_++ == 0) {
      Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
      q(0) = 1;
      s.motor_position += unstretched_motors(model_.nominal, q);
      return s;
    }
    if (missing_ > 0 && missing_-- > 0) return std::nullopt;
    if (chance(1e-4)) missing_ = 2000;
    if (chance(0.02)) return std::nullopt;
    const int k = std::uniform_int_distribution<int>(0, n - 1)(random_);
    if (chance(0.01)) s.motor_position(k) = std::numeric_limits<double>::quiet_NaN();
    if (chance(0.01)) s.motor_torque(k) = std::numeric_limits<double>::quiet_NaN();
    if (chance(1e-3)) s.motor_position(k) += 300;
    if (stale_ > 0 && stale_-- > 0) s.motor_position = last_;
    if (chance(1e-3)) stale_ = 5, last_ = s.motor_position;
    return s;
  }

 private:
  bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }

  const ArmModel& model_;
  std::mt19937_64 random_;
  long count_ = 0;
  int missing_ = 0, stale_ = 0;
  Eigen::VectorXd last_;
};

}  // namespace halyard
