#pragma once
/// What the headline of a diagnosis says of that which it cannot explain.

#include <string>
#include <vector>

#include "diagnosis/diagnose.h"

namespace halyard {

/// "a residual that matters is left without an explanation; a sensor stands still while its motor moves": one clause
/// for each kind of what is unexplained.
std::string unknown_headline(const std::vector<Unexplained>& unexplained);

/// "an unexplained residual remains": what there is beside named effects, in a few words; "" if it is nothing.
std::string remainder_headline(const std::vector<Unexplained>& unexplained);

}  // namespace halyard
