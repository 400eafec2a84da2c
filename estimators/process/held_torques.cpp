#include "estimators/process/held_torques.h"

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

constexpr double kUsualPeriods = 1.5;
constexpr double kLongPeriods = 10;  // a change over more usual periods is left out: commands in between are missing
constexpr long kFew = 10;            // so many changes count in any case, because nothing is usual yet

}  // namespace

void HeldTorques::take(int motor, double time_s, double torque) {
  Motor& m = motors_[static_cast<std::size_t>(motor)];
  if (!std::isfinite(torque) || (m.is_known && time_s <= m.time_s)) return;
  const double dt = time_s - m.time_s;
  if (m.is_known && (m.changes < kFew || dt <= kLongPeriods * m.usual_period_s())) {
    m.squares += std::pow(torque - m.torque, 2);
    m.span_s += dt;
    ++m.changes;
  }
  m.torque = torque;
  m.time_s = time_s;
  m.is_known = true;
}

double HeldTorques::impulse_variance(int motor, double from_s, double to_s) const {
  const Motor& m = motors_[static_cast<std::size_t>(motor)];
  if (m.changes == 0) return 0;
  const double known_until = m.time_s + kUsualPeriods * m.usual_period_s();
  const double a = std::max(0.0, from_s - known_until), b = std::max(0.0, to_s - known_until);
  return m.squares / m.span_s * (b * b * b - a * a * a) / 3;
}

}  // namespace halyard
