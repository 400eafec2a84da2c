// Only the first member may be looked at: what follows is laid out as another version did.
#include "plugins/effect_plugin.hpp"

extern "C" const halyard_effect_table* halyard_effects() {
  static const struct {
    std::uint32_t interface_version;
    const char* somewhere;
  } older = {HALYARD_EFFECT_INTERFACE - 1, reinterpret_cast<const char*>(1)};
  return reinterpret_cast<const halyard_effect_table*>(&older);
}
