#pragma once
/// Static pictures for papers: the charts of a page as one SVG file without scripts.

#include <string>
#include <vector>

#include "app/report/chart.h"

namespace halyard::report {

/// Line charts with their bands, in rows of panels; one legend names the series of all charts by their colours. Points
/// are not decimated. Throws std::invalid_argument if there is no chart, or lengths do not match.
std::string figure_svg(const std::vector<std::vector<Chart>>& rows);

/// A number over two others.
struct HeatMap {
  std::string title, x_label, y_label;
  std::string value_label;  ///< with unit
  /// in increasing order; cells are as wide as each other
  std::vector<double> x = {}, y = {};
  std::vector<double> value = {};  ///< [y.size() * x.size()], x fastest; NaN: an empty cell
  bool log_value = false;          ///< values <= 0 are empty cells
};

/// Heat maps in rows of panels, each with its own scale of colours. Throws std::invalid_argument as figure_svg() does.
std::string heat_map_svg(const std::vector<std::vector<HeatMap>>& rows);

}  // namespace halyard::report
