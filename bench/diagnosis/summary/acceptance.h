#pragma once
/// The acceptance table: one line or a few for each criterion, see bench/README.md.

#include <string>

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

/// A Markdown table. `ran`: trials whose recording could be drawn; a diagnosis that failed is a wrong answer.
std::string acceptance_table(const Results& ran);

}  // namespace halyard::blind
