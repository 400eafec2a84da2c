#include "diagnosis/fit/complementary.h"

#include <algorithm>
#include <tuple>

namespace halyard {
namespace {

/// Of two effects of a kind: the orders of two ripples, for example.
bool have_the_same_whole_numbers(const Hypothesis& h, const PlacedEffect& a, const PlacedEffect& b) {
  const SearchSpace space = search_space(*a.effect, h.nominal, a.joint);
  for (std::size_t i = 0; i < space.parameters.size(); ++i)
    if (space.parameters[i].is_whole && a.p[i] != b.p[i]) return false;
  return true;
}

bool are_complementary(const Fit& fit, std::size_t one, std::size_t other) {
  const PlacedEffect &a = fit.hypothesis.effects[one], &b = fit.hypothesis.effects[other];
  if (!same_name(a, b) || a.effect->n_states() > 0) return false;
  if (!have_the_same_whole_numbers(fit.hypothesis, a, b)) return false;
  return std::ranges::none_of(fit.parameters, [&](FitParameter p) {
    if (p.effect != one) return false;
    p.effect = other;
    return find_parameter(fit.parameters, p).has_value();
  });
}

Joined join(const Fit& fit, std::size_t kept, std::size_t gone) {
  Hypothesis h = fit.hypothesis;
  std::vector<FitParameter> parameters = fit.parameters;
  for (FitParameter& p : parameters) {
    if (p.effect != gone) continue;
    const double value = parameter_value(fit.hypothesis, p);
    p.effect = kept;
    set_parameter(h, p, value);
  }
  // Parameters of an effect follow each other in its order; those of the model are before them.
  std::ranges::stable_sort(parameters, [](const FitParameter& a, const FitParameter& b) {
    if (a.effect != b.effect) return a.effect < b.effect;
    return a.effect && std::tie(a.is_past, a.index) < std::tie(b.is_past, b.index);
  });
  return {without_effect(std::move(h), gone), without_parameters_of(std::move(parameters), gone), kept, gone};
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
