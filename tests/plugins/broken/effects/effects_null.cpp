#include "spring_effect.h"

extern "C" const halyard_effect_table* halyard_effects() {
  static auto table = halyard::effect_table<Spring>();
  table.make = [](std::vector<std::unique_ptr<const halyard::Effect>>& effects) { effects.push_back(nullptr); };
  return &table;
}
