#include "diagnosis/record/start_of_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kWindow = 0.05;   ///< s
constexpr double kSlow = 0.02;     ///< of the motor's greatest speed; slower is at rest,
constexpr double kNear = 1e-3;     ///< rad, and so is what moves less within the run in
constexpr double kAgrees = 0.3;    ///< share of the speed
constexpr double kDeviations = 3;  ///< of the sensor's slope

/// Mean rate of a sensor over the window, and its standard deviation.
struct SensedRate {
  double rate, deviation;
};

std::optional<SensedRate> sensed_rate(const std::vector<SensorSample>& samples) {
  double n = 0, t = 0, q = 0, tt = 0, tq = 0, qq = 0;
  for (const SensorSample& s : samples) {
    const double at = s.time - samples.front().time, value = s.value - samples.front().value;
    if (at > kWindow) break;
    n += 1, t += at, q += value, tt += at * at, tq += at * value, qq += value * value;
  }
  constexpr double kFewest = 5;
  const double spread = tt - t * t / std::max(n, 1.0);
  if (n < kFewest || !(spread > 0)) return std::nullopt;
  const double rate = (tq - t * q / n) / spread;
  const double left = std::max(0.0, qq - q * q / n - rate * rate * spread);
  return SensedRate{rate, std::sqrt(left / (n - 2) / spread)};
}

/// Of a motor at the start of the record, from a polynomial of third order over a time that the filter of the motion
/// hardly smooths.
struct FirstMotion {
  double rate, acceleration;
};

FirstMotion first_motion(const std::vector<double>& angle, double dt) {
  const auto rows = static_cast<Eigen::Index>(std::min<double>(kRunIn / dt + 1, static_cast<double>(angle.size())));
  Eigen::MatrixXd powers(rows, 4);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index p = 0; p < 4; ++p) powers(i, p) = std::pow(static_cast<double>(i) / static_cast<double>(rows), p);
  const Eigen::Vector4d c = powers.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(angle.data(), rows));
  const double unit = dt * static_cast<double>(rows);
  return {c(1) / unit, 2 * c(2) / (unit * unit)};
}

}  // namespace

StartOfMotion start_of_motion(const Record& record, const ArmModel& model) {
  const UnstretchedJoints unstretched(model.nominal);
  StartOfMotion start;
  for (int k = 0; k < record.n; ++k) {
    const FirstMotion motor = first_motion(record.motor_angle[k], record.dt);
    start.angle.push_back(record.motor_angle[k].front());
    start.rate.push_back(motor.rate);
    start.acceleration.push_back(motor.acceleration);
  }
  const auto joints = [&](const std::vector<double>& motors) {
    const Eigen::Map<const Eigen::VectorXd> of_motors(motors.data(), record.n);
    Eigen::VectorXd q(record.n);
    unstretched.solve(of_motors, of_motors, q);
    return q;
  };
  const Eigen::VectorXd v = joints(start.rate), a = joints(start.acceleration);
  bool any_moves = false;
  for (int k = 0; k < record.n; ++k) {
    const auto& rates = record.motor_rate[k];
    const auto greatest = std::abs(*std::ranges::max_element(rates, {}, [](double x) { return std::abs(x); }));
    const bool rests = std::abs(start.rate[k]) < std::max(kSlow * greatest, kNear / kRunIn);
    if (model.nominal.joint[k].drive != Drive::cable || rests) continue;
    any_moves = true;
    const auto sensed = record.has_joint(k) ? sensed_rate(record.joint_samples[k]) : std::nullopt;
    const double mean = v(k) + 0.5 * kWindow * a(k);
    if (sensed && std::abs(sensed->rate - mean) > kAgrees * std::abs(v(k)) + kDeviations * sensed->deviation) return {};
    if (!sensed && std::abs(start.acceleration[k]) * kRunIn > std::abs(start.rate[k])) return {};
  }
  return any_moves ? start : StartOfMotion();
}

}  // namespace halyard
