#pragma once
/// Each effect's file ends with this line. It instantiates the function that creates the file's effect:
///
///   template std::unique_ptr<const Effect> make_effect<Backlash>();
///
/// library.cpp calls this function, so a new effect needs its own file and one line in library.cpp.

#include "transmission/effect.h"

namespace halyard::effects {

template <class E>
std::unique_ptr<const Effect> make_effect() {
  return std::make_unique<const E>();
}

}  // namespace halyard::effects
