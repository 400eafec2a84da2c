#include "transmission/arm_fields.h"
#include "transmission/effects/built_in.h"

/// Coupling coefficients of a cable with its inboard joints that differ from the model's: C_kj' = C_kj + ΔC_kj.
///
///   ΔC_kj   additional motion of cable k per unit of joint j      rad/rad | m/rad | rad/m
///
/// Source: the paper's Eq. 8 and Section III-B, which estimates these coefficients.

namespace halyard::effects {

class CouplingError : public EffectOf<CouplingError> {
 public:
  std::string name() const override { return "coupling"; }
  std::string summary() const override { return "other coupling coefficients with the inboard joints"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return joint > 0 && arm.joint[joint].drive != Drive::none;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    std::vector<EffectParameter> all;
    for (int i = 0; i < *joint; ++i) {
      const double most = std::max(largest(j, arm.joint[i].type), std::abs(j.coupling[i]));
      all.push_back({"from_joint_" + std::to_string(i + 1), coupling_unit(j.type, arm.joint[i].type), 0,
                     0.1 * std::max(std::abs(j.coupling[i]), 0.1 * most), -most, most});
    }
    return all;
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    for (int i = 0; i < *joint; ++i) arm.joint[*joint].coupling[i] += p[i];
  }

 private:
  /// That of a cable on a pulley of the inboard joint that is as large as the own one, and of 0.1 m for a sliding
  /// joint; an inboard joint that slides moves the whole cable.
  static double largest(const JointParameters<double>& own, JointType inboard) {
    if (own.type == inboard) return 1;
    return own.type == JointType::prismatic ? 0.1 : 1 / own.pulley_radius;
  }
};

HALYARD_EFFECT(CouplingError)

}  // namespace halyard::effects
