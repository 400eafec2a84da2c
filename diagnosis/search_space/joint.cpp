#include <algorithm>

#include "diagnosis/search_space/built_in.h"

namespace halyard {
namespace {

using Arm = ArmParameters<double>;

void external_force(SearchSpace& space, const Arm&, int) {
  space["start"].range = space["stop"].range = SearchRange::record_time;
  // A force may end after the record. One that lasts from its first sample to its last is an offset and no push.
  space["stop"].natural_bounds = true;
  space["rise"].starts = {0, 0.5};
  space["rise"].natural_bounds = true;
  space["contact_position"].range = SearchRange::joint_position;
  space["contact_position"].is_wall = true;
}

void friction_drift(SearchSpace& space, const Arm&, int) {
  space["rate"].another_at = 0;
  space["settling_rate"].starts = {0, 0.03, 0.1, 0.3};
  space["joint_share"].starts = {0.2, 1};
  space["joint_share"].natural_bounds = true;
}

void joint_friction(SearchSpace& space, const Arm& arm, int joint) {
  for (ParameterSearch& p : space.parameters) p.natural_bounds = true;
  space["coulomb_change"].natural_bounds = false;  // no joint is without dry friction
  space["coulomb_change"].changes = {&Tolerances::friction, joint, arm.joint[joint].joint_coulomb};
  space["viscous_change"].changes = {&Tolerances::friction, joint, arm.joint[joint].joint_viscous};
}

void joint_presliding(SearchSpace& space, const Arm& arm, int joint) {
  const double typical = arm.joint[joint].type == JointType::revolute ? 5e-3 : 5e-4;
  space["share"].natural_bounds = true;
  space["deflection"].starts = {0.1 * typical, 0.4 * typical, 2 * typical, 10 * typical};
}

void payload(SearchSpace& space, const Arm& arm, int) {
  const int last = arm.n - 1;
  space.numbers_stay = true;  // mass, centre of mass and inertia
  space["mass"].changes = {&Tolerances::mass, last, std::max(arm.joint[last].mass, 1e-3)};
}

void stribeck(SearchSpace& space, const Arm& arm, int joint) {
  const auto from_smoothing = [](double v_s) { return std::vector<double>{3 * v_s, 10 * v_s, 30 * v_s}; };
  const JointParameters<double>& j = arm.joint[joint];
  space["joint_speed"].starts = from_smoothing(j.joint_smoothing);
  if (j.drive == Drive::none) return;
  space["joint_speed"].per_motor_speed = std::abs(j.motor_travel()) / j.pulley_radius;
  space["motor_speed"].starts = from_smoothing(j.motor_smoothing);
  space["motor_speed"].per_motor_speed = 1;
}

}  // namespace

std::span<const BuiltInSpace> joint_spaces() {
  static constexpr BuiltInSpace kSpaces[] = {{"external_force", external_force},
                                             {"friction_drift", friction_drift},
                                             {"joint_friction", joint_friction},
                                             {"joint_presliding", joint_presliding},
                                             {"payload", payload},
                                             {"stribeck", stribeck}};
  return kSpaces;
}

}  // namespace halyard
