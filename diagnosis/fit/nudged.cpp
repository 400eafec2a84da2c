#include "diagnosis/fit/nudged.h"

#include <algorithm>

namespace halyard {
namespace {

constexpr int kInstants = 10, kPositions = 6;  ///< parts of a record and of a motion: about as far apart as starts lie

/// True if all sizes that this shape belongs to are neutral: then it changes nothing.
bool has_no_size(const Hypothesis& h, const std::vector<FitParameter>& parameters, std::size_t shape) {
  const auto is_neutral = [&](std::size_t i) { return parameter_value(h, parameters[i]) == parameters[i].nominal; };
  for (const ParameterGroup& group : groups_of(parameters))
    if (std::ranges::find(group.shapes, shape) != group.shapes.end())
      return !group.sizes.empty() && std::ranges::all_of(group.sizes, is_neutral);
  return false;
}

}  // namespace

Nudge nudged(const Evidence& evidence, Hypothesis h, std::size_t first, const ArmParameters<double>& nominal,
             const BeyondNumbers& beyond) {
  Nudge nudge;
  for (std::size_t e = first; e < h.effects.size(); ++e) {
    const std::vector<FitParameter> parameters = effect_parameters(evidence, h, nominal, e);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const FitParameter& p = parameters[i];
      if (p.shape && has_no_size(h, parameters, i)) continue;
      const double value = parameter_value(h, p);
      std::vector<double> values;
      if (p.is_whole && p.range != SearchRange::own) continue;
      if (p.range != SearchRange::own) {
        const double spacing = (p.upper - p.lower) / (p.range == SearchRange::record_time ? kInstants : kPositions);
        for (const double by : {0.5, 0.25, 0.1, 0.04, 0.015, 0.005, 0.002})
          for (const double sign : {-1.0, 1.0}) values.push_back(value + sign * by * spacing);
      } else if (p.is_whole) {
        for (const double by : {-2.0, -1.0, 1.0, 2.0}) values.push_back(value + by);
      } else if (p.lower > 0 || (!p.natural_bounds && p.lower == 0)) {
        for (const double factor : {0.1, 0.3, 0.7, 0.9, 0.97, 0.99, 0.997, 1.003, 1.01, 1.03, 1.1, 1.4, 3.0, 10.0})
          values.push_back(factor * value);
      }
      if (values.empty()) continue;
      std::vector<Hypothesis> tried = {h};
      for (const double v : values) {
        tried.push_back(h);
        set_parameter(tried.back(), p, std::clamp(v, p.lower, p.upper));
      }
      const auto rows = evidence.fit_rows(tried);
      std::vector<double> left;
      for (const auto& row : rows) left.push_back(beyond.left(row));
      const auto least = std::ranges::min_element(left);
      if (least == left.begin()) continue;
      nudge.gain += (left[0] - *least) / 2;
      h = tried[static_cast<std::size_t>(least - left.begin())];
    }
  }
  nudge.at = std::move(h);
  return nudge;
}

}  // namespace halyard
