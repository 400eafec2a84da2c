#include "spring_effect.h"

extern "C" const halyard_effect_table* halyard_effects() {
  static auto table = halyard::effect_table<Spring>();
  static std::uint32_t layout[std::size(halyard::kEffectLayout)];
  std::copy(std::begin(halyard::kEffectLayout), std::end(halyard::kEffectLayout), layout);
  layout[7] += 8;
  table.layout = layout;
  return &table;
}
