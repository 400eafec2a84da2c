#include "diagnosis/search_space/built_in.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

using Arm = ArmParameters<double>;

void actuator_saturation(SearchSpace& space, const Arm& arm, int joint) {
  const double level = typical_motor_friction(arm.joint[joint]), no_limit = 1e4;
  space["share"].natural_bounds = space["no_load_speed"].natural_bounds = true;
  space["limit"].starts = {level, 2 * level, 4 * level, 8 * level, 16 * level, 32 * level, 64 * level};
  space["no_load_speed"].starts = {50, 200, no_limit};
  space.greatest_motor_speed = 2;
}

void motor_friction(SearchSpace& space, const Arm& arm, int joint) {
  for (ParameterSearch& p : space.parameters) p.natural_bounds = true;
  space["coulomb_change"].natural_bounds = false;  // no drive is without dry friction
  space["coulomb_change"].changes = {&Tolerances::friction, joint, arm.joint[joint].motor_coulomb};
  space["viscous_change"].changes = {&Tolerances::friction, joint, arm.joint[joint].motor_viscous};
}

void motor_presliding(SearchSpace& space, const Arm&, int) {
  space["share"].natural_bounds = true;
  space["deflection"].starts = {0.05, 0.2, 0.8, 3};
}

void torque_scale(SearchSpace& space, const Arm&, int joint) {
  space["scale"].changes = {&Tolerances::torque_scale, joint, 1};
}

void torque_ripple(SearchSpace& space, const Arm&, int) {
  // Pole pairs, slots and commutator bars, and what they have in common.
  space["order"].starts = whole_orders(24, {28, 30, 32, 36, 42, 48});
  space["order"].is_whole = true;
  space.order_of_motor_torque = 2;
}

}  // namespace

std::span<const BuiltInSpace> motor_spaces() {
  static constexpr BuiltInSpace kSpaces[] = {{"actuator_saturation", actuator_saturation},
                                             {"motor_friction", motor_friction},
                                             {"motor_presliding", motor_presliding},
                                             {"torque_ripple", torque_ripple},
                                             {"torque_scale", torque_scale}};
  return kSpaces;
}

}  // namespace halyard
