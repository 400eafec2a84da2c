#include "effects/spring_effect.h"

class Unstaged : public Spring {
 public:
  unsigned stages() const override { return 0; }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Unstaged>();
  return &table;
}
