#include "transmission/effects/built_in.h"
#include "transmission/effects/typical_size.h"

/// A torque constant of motor and amplifier that differs from the model's, or a bias:
///
///   τ = κ · model's scale · command + model's bias + β
///
///   κ, β   `scale`, `bias`      -, N m
///
/// Source: the torque constant converts current to torque and varies with magnets and amplifier gains. The zero error
/// of a current sensor is a bias.

namespace halyard::effects {

class TorqueScale : public EffectOf<TorqueScale> {
 public:
  std::string name() const override { return "torque_scale"; }
  std::string summary() const override { return "another torque constant, or a torque bias"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double level = typical_motor_friction(arm.joint[*joint]);
    return {{"scale", "1", 1, 1.05, 0.2, 5}, {"bias", "N m", 0, 0.3 * level, -30 * level, 30 * level}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    arm.joint[*joint].torque_scale *= p[0];
    arm.joint[*joint].torque_bias += p[1];
  }
};

HALYARD_EFFECT(TorqueScale)

}  // namespace halyard::effects
