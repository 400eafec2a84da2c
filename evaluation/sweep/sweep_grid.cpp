#include "evaluation/sweep/sweep_grid.h"

#include <fmt/core.h>

#include <optional>

namespace halyard {

std::string SweepAxis::label() const {
  std::string text = parameters.at(0);
  if (parameters.size() > 1) text += fmt::format(" and {} more", parameters.size() - 1);
  return is_factor ? text + " (factor)" : text;
}

std::size_t SweepGrid::combinations() const {
  if (is_sampled) return axes.at(0).values.size();
  std::size_t product = 1;
  for (const SweepAxis& axis : axes) product *= axis.values.size();
  return product;
}

std::vector<std::string> SweepGrid::subjects() const {
  if (!measures_limits()) return estimators;
  std::vector<std::string> names;
  for (const SweepEffect& effect : effects) names.push_back(effect.name);
  return names;
}

JointUnit SweepGrid::shown_unit(std::size_t m, std::size_t i, std::size_t k) const {
  const std::optional<std::string>& unit = measures.at(m)->unit;
  if (measures_limits()) {
    const std::string& si = effects.at(i).units.at(k);
    return {si, si == "1" ? "" : si, 1};
  }
  return unit ? JointUnit{*unit, *unit, 1} : units.at(k);
}

std::size_t SweepGrid::n_columns(std::size_t m) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < m; ++i) count += measures.at(i)->columns.size();
  return count;
}

std::vector<std::size_t> SweepGrid::places(std::size_t point) const {
  std::size_t combination = point / n_seeds();
  std::vector<std::size_t> result(axes.size(), combination);
  if (is_sampled) return result;
  for (std::size_t i = axes.size(); i-- > 0;) {
    result[i] = combination % axes[i].values.size();
    combination /= axes[i].values.size();
  }
  return result;
}

std::optional<std::uint64_t> SweepGrid::seed(std::size_t point) const {
  return seeds.empty() ? std::nullopt : std::optional(seeds[point % seeds.size()]);
}

std::vector<double> SweepGrid::values(std::size_t point) const {
  const std::vector<std::size_t> place = places(point);
  std::vector<double> result(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) result[i] = axes[i].values[place[i]];
  return result;
}

std::string SweepGrid::description(std::size_t point, std::size_t first_axis) const {
  const std::vector<double> value = values(point);
  std::string text;
  for (std::size_t i = first_axis; i < axes.size(); ++i) {
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", axes[i].label(), value[i]);
    if (!axes[i].unit.empty()) text += " " + axes[i].unit;
  }
  if (const auto number = seed(point); number && first_axis == 0) text += fmt::format(", seed {}", *number);
  return text;
}

}  // namespace halyard
