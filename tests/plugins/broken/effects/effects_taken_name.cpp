#include "spring_effect.h"

// The first of the two could be used: it must not join without the second.
class SecondBacklash : public Spring {
 public:
  std::string name() const override { return "backlash"; }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Spring, SecondBacklash>();
  return &table;
}
