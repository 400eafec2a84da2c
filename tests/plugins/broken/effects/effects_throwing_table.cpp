#include "spring_effect.h"

extern "C" const halyard_effect_table* halyard_effects() { throw 1; }  // no std::exception
