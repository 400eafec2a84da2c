#include "diagnosis/explanation/estimates.h"

#include <algorithm>

#include "diagnosis/judgement/final_fit.h"

namespace halyard {

Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given) {
  const FitParameter& p = fit.parameters[i];
  const double value = fit.value[i], half = interval_factor(fit) * fit.std_deviation[i];
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
    const double value = parameter_value(fit.hypothesis, p);
    if (const std::optional<std::size_t> fitted = find_parameter(fit.parameters, p)) {
      Estimated e = estimate_of(fit, *fitted, given);
      const double shift = told.p[p.index] - value;
      for (double* t : {&e.value, &e.lower, &e.upper}) *t += shift;
      all.push_back(e);
    } else if (p.is_whole) all.push_back({p.name, p.unit, value, value, value, p.nominal});
  }
  return all;
}

}  // namespace halyard
