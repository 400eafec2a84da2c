#include "transmission/effects/library.h"

namespace halyard {

std::vector<std::unique_ptr<const Effect>> built_in_effects() {
  std::vector<std::unique_ptr<const Effect>> effects;
  effects.push_back(make_payload());
  effects.push_back(make_gravity_tilt());
  effects.push_back(make_motor_friction());
  effects.push_back(make_joint_friction());
  effects.push_back(make_stribeck());
  effects.push_back(make_pulley_friction());
  effects.push_back(make_hysteresis());
  effects.push_back(make_backlash());
  effects.push_back(make_slack());
  effects.push_back(make_stiffness());
  effects.push_back(make_coupling_error());
  effects.push_back(make_creep());
  effects.push_back(make_capstan_ratio());
  effects.push_back(make_capstan_eccentricity());
  effects.push_back(make_encoder_offset());
  effects.push_back(make_encoder_eccentricity());
  effects.push_back(make_torque_ripple());
  effects.push_back(make_torque_scale());
  effects.push_back(make_delay());
  effects.push_back(make_cable_slip());
  effects.push_back(make_external_force());
  effects.push_back(make_friction_drift());
  effects.push_back(make_actuator_saturation());
  return effects;
}

}  // namespace halyard
