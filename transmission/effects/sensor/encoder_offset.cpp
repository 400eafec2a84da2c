#include "transmission/effects/built_in.h"

/// Zero error of the motor's encoder relative to its joint, as homing leaves it, in joint units:
///
///   reading = q_m + δ r_l N / r_m
///
///   δ   apparent minus true joint position      rad | m
///
/// The joint's sensor is the reference; a zero error of that sensor is the same error with the opposite sign. The
/// effect has no meaning where the model does not know one of the two zeros.

namespace halyard::effects {

class EncoderOffset : public EffectOf<EncoderOffset> {
 public:
  std::string name() const override { return "encoder_offset"; }
  std::string summary() const override { return "a zero error between motor and joint encoder"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    const JointParameters<double>& j = arm.joint[joint];
    return j.drive != Drive::none && j.motor_zero_known && j.joint_zero_known;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double reach = turns ? 0.5 : 0.05;
    return {{"offset", turns ? "rad" : "m", 0, 0.01 * reach, -reach, reach}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    JointParameters<T>& j = arm.joint[*joint];
    j.motor_encoder_offset += p[0] * j.pulley_radius / j.motor_travel();
  }
};

template std::unique_ptr<const Effect> make_effect<EncoderOffset>();

}  // namespace halyard::effects
