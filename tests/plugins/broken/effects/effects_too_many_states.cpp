#include "spring_effect.h"

class Remembering : public Spring {
 public:
  int n_states() const override { return halyard::kMaxEffectStates + 1; }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Remembering>();
  return &table;
}
