#pragma once
/// One line for each trial, for further analysis.

#include <string>

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

std::string trials_csv(const Results& all);

}  // namespace halyard::blind
