#include "diagnosis/fit/complementary.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "diagnosis/judgement/decision_rule.h"

namespace halyard {
namespace {

/// Of two effects of a kind: the orders of two ripples, for example.
bool have_the_same_whole_numbers(const Hypothesis& h, const PlacedEffect& a, const PlacedEffect& b) {
  const SearchSpace space = search_space(*a.effect, h.nominal, a.joint);
  for (std::size_t i = 0; i < space.parameters.size(); ++i)
    if (space.parameters[i].is_whole && a.p[i] != b.p[i]) return false;
  return true;
}

bool is_alike(const Fit& fit, std::size_t one, std::size_t other) {
  const PlacedEffect &a = fit.hypothesis.effects[one], &b = fit.hypothesis.effects[other];
  return same_name(a, b) && a.effect->n_states() == 0 && have_the_same_whole_numbers(fit.hypothesis, a, b);
}

/// The same parameter of the other effect, if the fit has it.
std::optional<std::size_t> same_of(const Fit& fit, FitParameter p, std::size_t other) {
  p.effect = other;
  return find_parameter(fit.parameters, p);
}

bool have_a_size_each(const Fit& fit, std::size_t one, std::size_t other) {
  const auto has_size = [&](std::size_t effect) {
    return std::ranges::any_of(fit.parameters, [&](const FitParameter& p) { return p.effect == effect && !p.shape; });
  };
  return has_size(one) && has_size(other);
}

/// The fit without those sizes of one effect that are next to nothing beside the same size of the other, and without
/// the shapes of these.
Fit without_remains(Fit fit, std::size_t one, std::size_t other) {
  const auto moved = [&](std::size_t i) {
    return std::abs(parameter_value(fit.hypothesis, fit.parameters[i]) - fit.parameters[i].nominal);
  };
  std::vector<bool> gone(fit.parameters.size(), false);
  for (const auto& [its, others] : {std::pair(one, other), std::pair(other, one)})
    for (std::size_t i = 0; i < fit.parameters.size(); ++i)
      if (const FitParameter& p = fit.parameters[i]; p.effect == its && !p.shape)
        if (const auto same = same_of(fit, p, others)) gone[i] = moved(i) < kRule.number_misfit * moved(*same);
  for (const ParameterGroup& group : groups_of(fit.parameters))
    if (!group.sizes.empty() && std::ranges::all_of(group.sizes, [&](std::size_t i) { return gone[i]; }))
      for (const std::size_t i : group.shapes) gone[i] = true;
  std::vector<FitParameter> left;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (gone[i]) set_parameter(fit.hypothesis, fit.parameters[i], fit.parameters[i].nominal);
    else left.push_back(fit.parameters[i]);
  }
  fit.parameters = std::move(left);
  return fit;
}

bool are_complementary(const Fit& fit, std::size_t one, std::size_t other) {
  return have_a_size_each(fit, one, other) && std::ranges::none_of(fit.parameters, [&](const FitParameter& p) {
           return p.effect == one && same_of(fit, p, other);
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
    for (std::size_t gone = kept + 1; gone < n; ++gone) {
      if (!is_alike(fit, kept, gone)) continue;
      const Fit without = without_remains(fit, kept, gone);
      if (are_complementary(without, kept, gone)) return join(without, kept, gone);
    }
  return {};
}

}  // namespace halyard
