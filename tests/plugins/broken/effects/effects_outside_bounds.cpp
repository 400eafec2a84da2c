#include "spring_effect.h"

class Outside : public Spring {
 public:
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"stiffness", "N m/rad", 0, 200, 0, 100}};  // typical: twice the largest
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Outside>();
  return &table;
}
