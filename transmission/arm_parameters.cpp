#include "transmission/arm_fields.h"

#include "transmission/cable_law.h"

namespace halyard {

template <class T>
ArmParameters<T> lift(const ArmParameters<double>& from) {
  ArmParameters<T> to;
  const auto copy = [](auto& b, const auto& a) { b = a; };
  for_each_field(
      kMaxJoints, [&](const ArmField&, auto& b, const auto& a) { for_each_entry(copy, b, a); }, to, from);
  return to;
}

template ArmParameters<double> lift(const ArmParameters<double>&);
template ArmParameters<Dual> lift(const ArmParameters<double>&);
template ArmParameters<Lanes> lift(const ArmParameters<double>&);

ArmParameters<Lanes> pack(const ArmParameters<double>* arms) {
  ArmParameters<Lanes> to = lift<Lanes>(arms[0]);
  for (int lane = 1; lane < kLaneWidth; ++lane) {
    const auto set = [lane](auto& b, const auto& a) {
      if constexpr (std::is_same_v<decltype(b), Lanes&>) b.set(lane, a);
    };
    for_each_field(
        kMaxJoints, [&](const ArmField&, auto& b, const auto& a) { for_each_entry(set, b, a); }, to, arms[lane]);
  }
  return to;
}

double cable_energy(const JointParameters<double>& j, double x) {
  switch (j.law) {
    case CableLaw::paper: return 2 * j.stiffness * (std::cosh(x) - 1);
    case CableLaw::exponential: {
      const double a = j.stiffness / j.tension;
      return 2 * j.tension / a * (std::cosh(a * x) - 1);
    }
    case CableLaw::linear: {
      // Beyond |x| = T_0 / k_e one run is slack: twice the slope before, once after.
      const double slack = j.tension / j.stiffness, u = std::abs(x);
      if (u <= slack) return j.stiffness * u * u;
      const double beyond = u - slack;
      return j.stiffness * slack * slack + 2 * j.tension * beyond + 0.5 * j.stiffness * beyond * beyond;
    }
  }
  return 0;
}

}  // namespace halyard
