#pragma once
/// The effects that come with halyard; each is one file beside this one.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

std::unique_ptr<const Effect> make_payload();
std::unique_ptr<const Effect> make_gravity_tilt();
std::unique_ptr<const Effect> make_motor_friction();
std::unique_ptr<const Effect> make_joint_friction();
std::unique_ptr<const Effect> make_stribeck();
std::unique_ptr<const Effect> make_pulley_friction();
std::unique_ptr<const Effect> make_hysteresis();
std::unique_ptr<const Effect> make_backlash();
std::unique_ptr<const Effect> make_slack();
std::unique_ptr<const Effect> make_stiffness();
std::unique_ptr<const Effect> make_coupling_error();
std::unique_ptr<const Effect> make_creep();
std::unique_ptr<const Effect> make_capstan_ratio();
std::unique_ptr<const Effect> make_capstan_eccentricity();
std::unique_ptr<const Effect> make_encoder_offset();
std::unique_ptr<const Effect> make_encoder_eccentricity();
std::unique_ptr<const Effect> make_torque_ripple();
std::unique_ptr<const Effect> make_torque_scale();
std::unique_ptr<const Effect> make_delay();
std::unique_ptr<const Effect> make_cable_slip();
std::unique_ptr<const Effect> make_external_force();
std::unique_ptr<const Effect> make_friction_drift();
std::unique_ptr<const Effect> make_actuator_saturation();

std::vector<std::unique_ptr<const Effect>> built_in_effects();

}  // namespace halyard
