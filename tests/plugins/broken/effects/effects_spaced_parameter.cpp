#include "spring_effect.h"

class Spaced : public Spring {
 public:
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return {{"spring rate", "N m/rad", 0, 1, 0, 100}};
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Spaced>();
  return &table;
}
