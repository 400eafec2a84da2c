#include "crash.h"
#include "effects/spring_effect.h"

[[maybe_unused]] static const bool opened = [] {
  crash();
  return true;
}();

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Spring>();
  return &table;
}
