#pragma once
/// What a file of this folder ends with: it makes the effect that the file defines.
///
///   template std::unique_ptr<const Effect> make_effect<Backlash>();
///
/// library.cpp calls it, so that an effect is its own file and one line there.

#include "transmission/effect.h"

namespace halyard::effects {

template <class E>
std::unique_ptr<const Effect> make_effect() {
  return std::make_unique<const E>();
}

}  // namespace halyard::effects
