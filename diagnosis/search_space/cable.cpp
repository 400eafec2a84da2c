#include <cmath>
#include <numbers>

#include "diagnosis/search_space/built_in.h"
#include "model/drive_ratio.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

using Arm = ArmParameters<double>;
using Joint = JointParameters<double>;

void backlash(SearchSpace& space, const Arm& arm, int joint) {
  space["rounding"].starts = {0, 0.1 * typical_half_gap(arm.joint[joint])};
  space["rounding"].natural_bounds = true;
}

void cable_slip(SearchSpace& space, const Arm&, int) {
  space["time"].range = SearchRange::record_time;
  space["duration"].starts = {0, 0.4};
  space["duration"].natural_bounds = true;
}

void capstan_eccentricity(SearchSpace& space, const Arm& arm, int joint) {
  space.period_of_motor = 2 * std::numbers::pi * arm.joint[joint].gear_ratio;
}

void capstan_ratio(SearchSpace& space, const Arm& arm, int joint) {
  space["ratio"].changes = {&Tolerances::length, joint, static_cast<double>(uncertain_lengths(arm.joint[joint]))};
}

void coupling(SearchSpace& space, const Arm& arm, int joint) {
  for (int i = 0; i < joint; ++i)
    space.parameters[i].changes = {&Tolerances::coupling, joint, std::abs(arm.joint[joint].coupling[i])};
}

void creep(SearchSpace& space, const Arm&, int) { space["time_constant"].starts = {0.3, 1, 3, 10, 30}; }

/// A share ρ that yields at once leaves 1 - ρ of the stiffness.
std::vector<double> loop_of_a_softer_cable(const double* cable) { return {1 - cable[0], 0}; }
std::vector<double> softer_cable_of_a_loop(const double* loop, const Joint& fitted, const Joint& nominal) {
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 1; };
  return {(1 - loop[0]) * ratio(fitted.stiffness, nominal.stiffness), ratio(fitted.damping, nominal.damping), 0};
}

void hysteresis(SearchSpace& space, const Arm& arm, int joint) {
  const double stretch = typical_stretch(arm.joint[joint]);
  ParameterSearch& yield = space["yield_stretch"];
  yield.starts = {0.003 * stretch, 0.01 * stretch, 0.03 * stretch, 0.1 * stretch, 0.3 * stretch};
  yield.natural_bounds = true;
  yield.another_at = 0;
  space.another = {"stiffness", loop_of_a_softer_cable, softer_cable_of_a_loop};
}

void pulley_friction(SearchSpace& space, const Arm&, int) { space["motor_share"].natural_bounds = true; }

void slack(SearchSpace& space, const Arm& arm, int joint) {
  space["share"].natural_bounds = true;
  const double tension = arm.joint[joint].stiffness * typical_stretch(arm.joint[joint]);
  space["tension"].starts = {0.05 * tension, 0.15 * tension, 0.5 * tension, tension};
}

void stiffness(SearchSpace& space, const Arm&, int joint) {
  for (const char* ratio : {"stiffness_ratio", "damping_ratio"})
    space[ratio].changes = {&Tolerances::stiffness, joint, 1};
}

}  // namespace

std::span<const BuiltInSpace> cable_spaces() {
  static constexpr BuiltInSpace kSpaces[] = {{"backlash", backlash},
                                             {"cable_slip", cable_slip},
                                             {"capstan_eccentricity", capstan_eccentricity},
                                             {"capstan_ratio", capstan_ratio},
                                             {"coupling", coupling},
                                             {"creep", creep},
                                             {"hysteresis", hysteresis},
                                             {"pulley_friction", pulley_friction},
                                             {"slack", slack},
                                             {"stiffness", stiffness}};
  return kSpaces;
}

}  // namespace halyard
