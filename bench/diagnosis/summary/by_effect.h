#pragma once
/// Which effects are found and which are mistaken for which.

#include <string>

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

/// One line for each hidden effect of trials with one effect that is visible.
std::string effect_table(const Results& trials);

/// What was named first, of each truth: a table with a head. Right effects at a wrong joint stand apart.
std::vector<std::vector<std::string>> confusion(const Results& trials);
std::string markdown(const std::vector<std::vector<std::string>>& table);

}  // namespace halyard::blind
