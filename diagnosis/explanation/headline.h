#pragma once
/// The headline of a diagnosis that names nothing.

#include <string>
#include <vector>

#include "diagnosis/diagnose.h"

namespace halyard {

/// "a residual that matters is left without an explanation; a sensor stands still while its motor moves": one clause
/// for each kind of what is unexplained.
std::string unknown_headline(const std::vector<Unexplained>& unexplained);

}  // namespace halyard
