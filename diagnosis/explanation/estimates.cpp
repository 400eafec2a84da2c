#include "diagnosis/explanation/estimates.h"

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
  return {p.name, p.unit, p.nominal, lower, upper, p.nominal, false, true};
}

}  // namespace

Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given) {
  const FitParameter& p = fit.parameters[i];
  const double value = fit.value[i], half = half_interval(fit, i);
  double lower = std::max(value - half, p.lower), upper = std::min(value + half, p.upper);
  const bool is_found_size = p.effect >= given && !p.shape;
  if (is_found_size && value > p.nominal) lower = std::max(lower, p.nominal);
  if (is_found_size && value < p.nominal) upper = std::min(upper, p.nominal);
  return {p.name, p.unit, value, lower, upper, p.nominal};
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
      for (double* t : {&e.value, &e.lower, &e.upper}) *t += shift;
      all.push_back(e);
    } else if (const auto reset = std::ranges::find_if(fit.reset, is_its); reset != fit.reset.end()) {
      all.push_back(estimate_of_reset(*reset));
    } else if (p.is_whole) all.push_back({p.name, p.unit, value, value, value, p.nominal, true});
  }
  return all;
}

}  // namespace halyard
