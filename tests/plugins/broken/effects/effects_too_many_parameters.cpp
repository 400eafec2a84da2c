#include "spring_effect.h"

class Greedy : public Spring {
 public:
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return std::vector<halyard::EffectParameter>(halyard::kMaxEffectParameters + 1, {"p", "1", 0, 1, 0, 2});
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Greedy>();
  return &table;
}
