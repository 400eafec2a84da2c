#include "estimators/filters/start_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kFastest = 0.05;  // s, for a joint to cross its range

}  // namespace

StartReadings::StartReadings(std::vector<int> motors, int n)
    : motors_(std::move(motors)),
      reading_(Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN())),
      read_at_(reading_),
      started_from_(reading_),
      started_at_(reading_) {}

void StartReadings::take(const Sample& sample) {
  for (const int k : motors_)
    if (std::isfinite(sample.motor_position(k))) reading_(k) = sample.motor_position(k), read_at_(k) = sample.time_s;
}

void StartReadings::forget() { reading_.setConstant(std::numeric_limits<double>::quiet_NaN()); }

void StartReadings::start() {
  started_from_ = reading_;
  started_at_ = read_at_;
}

bool StartReadings::are_complete() const {
  return std::ranges::all_of(motors_, [&](int k) { return std::isfinite(reading_(k)); });
}

bool StartReadings::are_new(const Sample& sample) const {
  return std::ranges::all_of(motors_,
                             [&](int k) { return std::isfinite(sample.motor_position(k)) || since_start(k) > 0; });
}

double StartReadings::age(double time_s) const {
  double age = 0;
  for (const int k : motors_) age = std::max(age, time_s - read_at_(k));
  return age;
}

Eigen::VectorXd StartReadings::angles() const {
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(reading_.size());
  angles(motors_) = reading_(motors_);
  return angles;
}

std::optional<MeanRates> StartReadings::rates(const ArmParameters<double>& arm, const ArmModel& model,
                                              const Eigen::VectorXd& angles) const {
  MeanRates rates;
  rates.shortest_s = kUnlimited;
  for (const int k : motors_) {
    rates.shortest_s = std::min(rates.shortest_s, since_start(k));
    rates.longest_s = std::max(rates.longest_s, since_start(k));
  }
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(angles.size());
  for (const int k : motors_) moved(k) = (reading_(k) - started_from_(k)) * (rates.longest_s / since_start(k));
  const Eigen::VectorXd home = model.home();
  const Eigen::VectorXd path = unstretched_joints(arm, angles, home) - unstretched_joints(arm, angles - moved, home);
  rates.motor = moved / rates.longest_s;
  rates.joint = path / rates.longest_s;
  for (int k = 0; k < path.size(); ++k) {
    const double range = model.joints[k].upper - model.joints[k].lower;
    if (!(std::abs(rates.joint(k)) <= (range > 0 ? range / kFastest : kUnlimited))) return std::nullopt;  // NaN, too
  }
  return rates;
}

}  // namespace halyard
