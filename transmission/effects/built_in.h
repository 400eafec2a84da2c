#pragma once
/// Each effect's file ends with this line, which makes the effect that the file defines:
///
///   template std::unique_ptr<const Effect> make_effect<Backlash>();
///
/// library.cpp calls it, so a new effect needs its own file and one line in library.cpp.

#include "transmission/effect.h"

namespace halyard::effects {

template <class E>
std::unique_ptr<const Effect> make_effect() {
  return std::make_unique<const E>();
}

}  // namespace halyard::effects
