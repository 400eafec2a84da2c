#include "effects/spring_effect.h"

class Unscaled : public Spring {
 public:
  int n_states() const override { return 2; }
  std::vector<double> state_scale(const halyard::ArmParameters<double>&, halyard::EffectPlace,
                                  const double*) const override {
    return {1, 1, 1};
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Unscaled>();
  return &table;
}
