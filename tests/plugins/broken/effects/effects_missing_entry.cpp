#include "spring_effect.h"

extern "C" const halyard_effect_table* halyard_effects() {
  static auto table = halyard::effect_table<Spring>();
  table.make = nullptr;
  return &table;
}
