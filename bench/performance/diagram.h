#pragma once
/// Work-precision diagrams as SVG: one panel for each stiffness (columns) and smoothing (rows), both axes logarithmic.

#include <string>
#include <vector>

#include "bench/performance/work_precision.h"

namespace halyard {

struct Panel {
  StiffCase which;
  std::vector<WorkPrecision> results;
};

/// panels: row by row, `columns` in each.
std::string diagram_svg(const std::string& title, const std::vector<Panel>& panels, std::size_t columns);

}  // namespace halyard
