#include "effects/spring_effect.h"

class ShapeFirst : public Spring {
 public:
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"rest", "rad", 1, 1, -3, 3}, {"stiffness", "N m/rad", 0, 1, 0, 100}};
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<ShapeFirst>();
  return &table;
}
