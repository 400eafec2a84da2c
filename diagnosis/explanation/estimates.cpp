#include "diagnosis/explanation/estimates.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/judgement/final_fit.h"

namespace halyard {
namespace {

/// Neutral, with the interval that it had with all parameters, extended to the neutral value: what was reset before it
/// has changed it.
Estimated estimate_of_reset(const ResetParameter& reset) {
  const FitParameter& p = reset.parameter;
  const double lower = std::min(p.nominal, std::max(reset.value - reset.half_width, p.lower));
  const double upper = std::max(p.nominal, std::min(reset.value + reset.half_width, p.upper));
  Estimated e{p.name, p.unit, p.nominal, lower, upper, p.nominal, false, true};
  e.at_bound = ends_at_bound(p, reset.value);
  e.least = p.lower, e.most = p.upper;
  return e;
}

/// "1.2 to 1.4 N m", and "1.2 to 1.4" of a number without a unit.
std::string range_of(const Estimated& p) {
  return fmt::format("{:.4g} to {:.4g}{}", p.least, p.most, p.unit.empty() || p.unit == "1" ? "" : " " + p.unit);
}

std::string number_at_bound(const Estimated& p, double tolerance_factor) {
  if (p.at_limit)
    return fmt::format("{}: at a physical limit ({}): the data ask for still less, so an effect may be missing", p.name,
                       range_of(p));
  return fmt::format(
      "{}: at the end of {}its tolerance ({}): the true value may lie beyond; check the number, or widen its tolerance "
      "in the model file",
      p.name, tolerance_factor > 1 ? fmt::format("{:g} times ", tolerance_factor) : "", range_of(p));
}

std::string parameter_at_bound(const PlacedEffect& effect, const Estimated& p) {
  const std::string what = effect_label(effect) + " " + p.name;
  if (p.at_limit)
    return fmt::format("{}: at a physical limit ({}), beyond which the true value cannot lie", what, range_of(p));
  return fmt::format(
      "{}: at the end of what is plausible ({}){}: the true value may lie beyond, or be another effect's", what,
      range_of(p), p.is_reset ? fmt::format(", and so reset to {:g}", p.value) : "");
}

}  // namespace

std::vector<std::string> bound_lines(const Diagnosis& d) {
  std::vector<std::string> lines;
  for (const NamedEffect& e : d.effects)
    for (const Estimated& p : e.parameters)
      if (p.at_bound) lines.push_back(parameter_at_bound(e.effect, p));
  for (const Estimated& p : d.refitted)
    if (p.at_bound) lines.push_back(number_at_bound(p, d.tolerance_factor));
  return lines;
}

Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given) {
  const FitParameter& p = fit.parameters[i];
  const double value = fit.value[i], half = half_interval(fit, i);
  double lower = std::max(value - half, p.lower), upper = std::min(value + half, p.upper);
  const bool is_found_size = p.effect >= given && !p.shape;
  if (is_found_size && value > p.nominal) lower = std::max(lower, p.nominal);
  if (is_found_size && value < p.nominal) upper = std::min(upper, p.nominal);
  Estimated e{p.name, p.unit, value, lower, upper, p.nominal};
  e.at_bound = is_at_bound(p, value), e.at_limit = is_at_limit(p, value);
  e.least = p.lower, e.most = p.upper;
  return e;
}

std::vector<Estimated> estimated_parameters(const Evidence& evidence, const ArmParameters<double>& nominal,
                                            const Fit& fit, std::size_t effect, std::size_t given,
                                            const PlacedEffect& told) {
  std::vector<Estimated> all;
  for (const FitParameter& p : effect_parameters(evidence, fit.hypothesis, nominal, effect)) {
    if (p.is_past) continue;
    const auto is_its = [&](const ResetParameter& r) { return is_same_number(r.parameter, p); };
    const double value = parameter_value(fit.hypothesis, p);
    if (const std::optional<std::size_t> fitted = find_parameter(fit.parameters, p)) {
      Estimated e = estimate_of(fit, *fitted, given);
      const double shift = told.p[p.index] - value;
      for (double* t : {&e.value, &e.lower, &e.upper, &e.least, &e.most}) *t += shift;
      all.push_back(e);
    } else if (const auto reset = std::ranges::find_if(fit.reset, is_its); reset != fit.reset.end()) {
      all.push_back(estimate_of_reset(*reset));
    } else if (p.is_whole) all.push_back({p.name, p.unit, value, value, value, p.nominal, true});
  }
  return all;
}

}  // namespace halyard
