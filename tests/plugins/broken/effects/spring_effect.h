// An effect that keeps the contract, for modules that each break it in one place.
#include "plugins/effect_plugin.hpp"

class Spring : public halyard::EffectOf<Spring> {
 public:
  std::string name() const override { return "fixture_spring"; }
  std::string summary() const override { return "a spring at the joint"; }
  unsigned stages() const override { return static_cast<unsigned>(halyard::EffectStage::joint); }
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"stiffness", "N m/rad", 0, 1, 0, 100}};
  }
  template <class T>
  void on_joint(const halyard::EffectContext<T>& c, halyard::JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * s[*c.joint].joint_position;
  }
};
