#include <type_traits>

#include "plugins/effect_plugin.hpp"

/// It tears beyond a stiffness, in the middle of a simulation.
class TornSpring : public halyard::EffectOf<TornSpring> {
 public:
  std::string name() const override { return "fixture_torn_spring"; }
  std::string summary() const override { return "a spring at the joint"; }
  unsigned stages() const override { return static_cast<unsigned>(halyard::EffectStage::joint); }
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"stiffness", "N m/rad", 0, 1, 0, 100}};
  }
  template <class T>
  void on_joint(const halyard::EffectContext<T>& c, halyard::JointSignals<T>* s) const {
    if constexpr (std::is_same_v<T, double>) {
      if (c.p[0] > 50) throw 42;  // no std::exception
    }
    s[*c.joint].joint_force -= c.p[0] * s[*c.joint].joint_position;
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<TornSpring>();
  return &table;
}
