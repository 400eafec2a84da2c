#include "effects/spring_effect.h"
#include "model/input_error.h"

/// The error is of the type that the loader itself refuses modules with.
class Refusing : public Spring {
 public:
  Refusing() { throw halyard::InputError("no springs are sold here"); }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<Refusing>();
  return &table;
}
