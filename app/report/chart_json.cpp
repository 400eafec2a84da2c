#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/report/chart.h"
#include "model/output/number_text.h"

namespace halyard::report {
namespace {

using Json = nlohmann::ordered_json;

/// To 12 significant digits: finer than any pixel, also where time counts from 1970.
Json number(double value) { return std::isfinite(value) ? Json(rounded_to_digits(value, 12)) : Json(nullptr); }

Json numbers(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(number(value));
  return array;
}

Json to_object(const Points& points) { return {{"x", numbers(points.x)}, {"y", numbers(points.y)}}; }

const char* name_of(ChartKind kind) {
  switch (kind) {
    case ChartKind::line: return "line";
    case ChartKind::scatter: return "scatter";
    case ChartKind::bar: return "bar";
    case ChartKind::histogram: return "histogram";
  }
  throw std::invalid_argument("unknown kind of chart");
}

std::vector<double> lower_ends(const Series& series, bool is_logarithmic) {
  std::vector<double> ends;
  for (std::size_t j = 0; j < series.y.size(); ++j) ends.push_back(lower_end(series, j, is_logarithmic));
  return ends;
}

Json to_object(const Chart& chart, const Series& series, std::size_t place) {
  check_lengths(chart, series);
  Json object = {{"name", series.name}, {"colour", colour_of(series, place)}, {"dashed", series.dashed}};
  switch (chart.kind) {
    case ChartKind::line:
      object.update(to_object(decimate(series.x, series.y)));
      if (!series.band) break;
      object["lower"] = to_object(decimate(series.x, lower_ends(series, chart.log_y)));
      object["upper"] = to_object(decimate(series.x, series.band->upper));
      break;
    case ChartKind::scatter: object.update(to_object(thin(series.x, series.y))); break;
    case ChartKind::bar:
    case ChartKind::histogram: object.update(to_object({series.x, series.y})); break;
  }
  return object;
}

}  // namespace

std::string to_json(const Chart& chart) {
  Json object = {{"kind", name_of(chart.kind)}, {"x_label", chart.x_label}, {"y_label", chart.y_label},
                 {"log_x", chart.log_x},        {"log_y", chart.log_y},     {"categories", chart.categories},
                 {"regions", Json::array()},    {"series", Json::array()}};
  for (const Region& region : chart.regions) {
    object["regions"].push_back({{"from", number(region.from)}, {"to", number(region.to)}, {"label", region.label}});
  }
  for (std::size_t place = 0; place < chart.series.size(); ++place) {
    object["series"].push_back(to_object(chart, chart.series[place], place));
  }

  // Outside strings JSON has no '<'; inside, this escape means the same and cannot close the script element.
  std::string safe;
  for (const char c : object.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace halyard::report
