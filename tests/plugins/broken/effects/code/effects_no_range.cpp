#include "effects/spring_effect.h"

class NoRange : public Spring {
 public:
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"stiffness", "N m/rad", 10, 10, 10, 10}};
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<NoRange>();
  return &table;
}
