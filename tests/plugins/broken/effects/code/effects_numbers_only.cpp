#include "plugins/effect_plugin.hpp"

/// It acts at no stage, and what it changes is a part of an array.
class Heavier : public halyard::EffectOf<Heavier> {
 public:
  std::string name() const override { return "fixture_heavier"; }
  std::string summary() const override { return "another inertia of a link"; }
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"more", "1", 0, 0.1, 0, 1}};
  }
  template <class T>
  void change(halyard::ArmParameters<T>& arm, halyard::EffectPlace joint, const T* p) const {
    arm.joint[*joint].inertia[2] *= T(1.0) + p[0];
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Heavier>();
  return &table;
}
