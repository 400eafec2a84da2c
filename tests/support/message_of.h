#pragma once
/// What an action that is refused says.

#include <string>

#include "model/input_error.h"

namespace halyard {

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

}  // namespace halyard
