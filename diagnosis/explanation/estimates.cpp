#include "diagnosis/explanation/estimates.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/judgement/final_fit.h"

namespace halyard {
namespace {

/// Standard deviation of parameter i if numbers of the model lie anywhere within their tolerances. A fit takes half a
/// tolerance as one deviation; that of a uniform distribution is larger by 2/√3. The estimate shifts by -H⁻¹ P times
/// what a number is off. So its variance grows by (4/3 - 1) Σ_j (C_ij / σ_j)² over the numbers j; C = H⁻¹,
/// P_jj = 1 / σ_j².
double uniform_deviation(const Fit& fit, std::size_t i) {
  constexpr double kMore = 4.0 / 3 - 1;
  double shift = 0;
  for (std::size_t j = 0; j < fit.parameters.size(); ++j)
    if (!fit.parameters[j].effect)
      shift += std::pow(
          fit.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / fit.parameters[j].scale, 2);
  return std::sqrt(std::pow(fit.std_deviation[i], 2) + kMore * shift);
}

}  // namespace

Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given) {
  const FitParameter& p = fit.parameters[i];
  const double value = fit.value[i], half = interval_factor(fit) * uniform_deviation(fit, i);
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
    } else if (p.is_whole) all.push_back({p.name, p.unit, value, value, value, p.nominal, true});
  }
  return all;
}

}  // namespace halyard
