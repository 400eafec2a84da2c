#include "transmission/effects/built_in.h"

/// Zero error between the encoders of motor and joint, as homing leaves it, in joint units:
///
///   motor's reading = q_m + (1 - σ) δ r_l N / r_m,   joint's reading = q - σ δ
///
///   δ   `offset`: joint position by the motor's encoder minus that by the joint's sensor      rad | m
///   σ   `at_joint`: 0: the motor's encoder is wrong; 1: the joint's sensor is                  -
///
/// Only cables of other joints that this joint's motion moves can tell the two apart. Where there are none, the joint's
/// sensor is the reference, and σ is no parameter. The effect has no meaning where the model does not know one of the
/// two zeros. r_l, r_m and N are those of the model with the effects that are listed before this one.

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
    std::vector<EffectParameter> all = {{"offset", turns ? "rad" : "m", 0, 0.01 * reach, -reach, reach}};
    for (int k = 0; k < arm.n; ++k)
      if (k != *joint && arm.joint[k].coupling[*joint] != 0 && all.size() == 1)
        all.push_back({"at_joint", "1", 0, 0, 0, 1});
    return all;
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    JointParameters<T>& j = arm.joint[*joint];
    j.motor_encoder_offset += (T(1.0) - p[1]) * p[0] * j.pulley_radius / j.motor_travel();
    j.joint_encoder_offset -= p[1] * p[0];
  }
};

HALYARD_EFFECT(EncoderOffset)

}  // namespace halyard::effects
