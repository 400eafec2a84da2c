#include "transmission/effects/library.h"

namespace halyard {

std::vector<std::unique_ptr<const Effect>> built_in_effects() {
  std::vector<std::unique_ptr<const Effect>> effects;
  effects.push_back(make_payload());
  effects.push_back(make_motor_friction());
  effects.push_back(make_joint_friction());
  effects.push_back(make_pulley_friction());
  effects.push_back(make_hysteresis());
  effects.push_back(make_backlash());
  effects.push_back(make_stiffness());
  effects.push_back(make_coupling_error());
  effects.push_back(make_capstan_ratio());
  effects.push_back(make_encoder_offset());
  return effects;
}

}  // namespace halyard
