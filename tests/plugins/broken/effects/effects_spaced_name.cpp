#include "spring_effect.h"

class Spaced : public Spring {
 public:
  std::string name() const override { return "a spring"; }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Spaced>();
  return &table;
}
