#include "diagnosis/fit/complementary.h"

#include <algorithm>

namespace halyard {
namespace {

std::vector<FitParameter> parameters_of(const Fit& fit, std::size_t effect) {
  std::vector<FitParameter> own = fit.parameters;
  std::erase_if(own, [&](const FitParameter& p) { return p.effect != static_cast<int>(effect); });
  return own;
}

bool are_complementary(const Fit& fit, std::size_t one, std::size_t other) {
  const PlacedEffect &a = fit.hypothesis.effects[one], &b = fit.hypothesis.effects[other];
  if (a.effect != b.effect || a.joint != b.joint || a.effect->n_states() > 0) return false;
  const std::vector<FitParameter> of_a = parameters_of(fit, one), of_b = parameters_of(fit, other);
  return std::ranges::none_of(of_a, [&](const FitParameter& p) {
    return std::ranges::any_of(of_b, [&](const FitParameter& q) { return p.index == q.index; });
  });
}

Joined join(const Fit& fit, std::size_t kept, std::size_t gone) {
  Hypothesis h = fit.hypothesis;
  std::vector<FitParameter> parameters;
  for (FitParameter p : fit.parameters) {
    if (p.effect == static_cast<int>(gone)) {
      const double value = parameter_value(fit.hypothesis, p);
      p.effect = static_cast<int>(kept);
      set_parameter(h, p, value);
    } else if (p.effect > static_cast<int>(gone)) {
      --p.effect;
    }
    parameters.push_back(p);
  }
  // Parameters of an effect follow each other in its order; those of the model are before them.
  std::ranges::stable_sort(parameters, [](const FitParameter& a, const FitParameter& b) {
    return a.effect != b.effect ? a.effect < b.effect : a.effect >= 0 && a.index < b.index;
  });
  return {without_effect(std::move(h), gone), std::move(parameters), kept, gone};
}

}  // namespace

std::optional<Joined> join_complementary(const Fit& fit, std::size_t given) {
  const std::size_t n = fit.hypothesis.effects.size();
  for (std::size_t kept = given; kept < n; ++kept)
    for (std::size_t gone = kept + 1; gone < n; ++gone)
      if (are_complementary(fit, kept, gone)) return join(fit, kept, gone);
  return {};
}

}  // namespace halyard
