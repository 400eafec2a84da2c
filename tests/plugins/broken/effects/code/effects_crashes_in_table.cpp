#include "crash.h"
#include "effects/spring_effect.h"

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Spring>();
  crash();
  return &table;
}
