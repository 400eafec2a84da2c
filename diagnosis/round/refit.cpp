#include "diagnosis/round/refit.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/fit/nudged.h"

namespace halyard {
namespace {

/// [channel] Errors of the grid that do not matter beside residuals of this size. Reason: without a limit, hysteresis
/// with a small loop ended in a wrong minimum; with half of this limit, the coarse grid was hardly ever used.
std::vector<double> small_beside(std::vector<double> scale) {
  constexpr double kSmall = 0.2;
  for (double& s : scale) s *= kSmall;
  return scale;
}

}  // namespace

Refit restarted(Refit refit, const Hypothesis& at) {
  refit.at = at;
  refit.best = {};
  refit.last = std::numeric_limits<double>::infinity();
  refit.settled = refit.is_nudged = false;
  return refit;
}

Refitter::Refitter(const Evidence& evidence, const ArmModel& model, std::size_t given)
    : evidence_(evidence), model_(model), given_(given) {
  constexpr double kSensitive = 0.1;  // of a channel's floor
  const std::vector<FitParameter> all = baseline_parameters(model_);
  const auto columns = sensitivities(evidence_, {model_.nominal, model_.effects}, all);
  if (columns.size() < all.size()) return;
  ArmParameters<double> arm = model_.nominal;
  const std::vector<ParameterInfo> named = named_parameters(arm);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<double> change = columns[i];
    for (double& x : change) x = x * (all[i].upper - all[i].nominal) / all[i].scale;
    const ParameterInfo& its = named[all[i].index];
    if (evidence_.exceeds_floor(change, kSensitive)) numbers_.push_back(all[i]);
    else if (its.tolerance == &Tolerances::stiffness) hidden_.push_back({all[i], its.joint});
  }
  usable_ = true;
}

/// Once it is off, it can also return.
bool Refitter::may_show(const OfCable& hidden, const Hypothesis& h) const {
  if (parameter_value(h, hidden.number) != hidden.number.nominal) return true;
  return std::any_of(
      h.effects.begin() + static_cast<std::ptrdiff_t>(given_), h.effects.end(),
      [&](const PlacedEffect& e) { return e.joint == hidden.joint && yields_in_the_cable(e, model_.nominal); });
}

std::vector<FitParameter> Refitter::numbers_beside(const Hypothesis& h) const {
  std::vector<FitParameter> all = numbers_;
  for (const OfCable& c : hidden_)
    if (may_show(c, h)) all.push_back(c.number);
  std::erase_if(all, [&](const FitParameter& b) {
    return std::any_of(h.effects.begin() + static_cast<std::ptrdiff_t>(given_), h.effects.end(),
                       [&](const PlacedEffect& e) { return effect_covers(e, model_.nominal, b); });
  });
  return all;
}

std::vector<FitParameter> Refitter::parameters(const Hypothesis& h) const {
  std::vector<FitParameter> all = numbers_beside(h);
  for (std::size_t e = 0; e < h.effects.size(); ++e)
    for (const FitParameter& p : effect_parameters(evidence_, h, model_.nominal, e))
      if (e >= given_ || p.is_past) all.push_back(p);
  return all;
}

Hypothesis Refitter::with_effect(Hypothesis h, const PlacedEffect& effect, const std::vector<double>& past) const {
  h.effects.push_back(effect);
  for (std::size_t i = 0; i < past.size(); ++i) h.set_past_state(h.effects.size() - 1, i, past[i]);
  for (const FitParameter& b : baseline_parameters(model_))
    if (effect_covers(effect, model_.nominal, b)) set_parameter(h, b, b.nominal);
  return h;
}

void Refitter::go_on(Refit& r, int passes) const {
  constexpr double kWorthAPass = 0.02;
  for (; passes > 0 && !r.settled; --passes) {
    r.settled = true;
    const std::vector<double> scale = channel_scale(evidence_, r.score.fit_mean_square);
    const std::vector<FitParameter> numbers = numbers_beside(r.at);
    const std::unique_ptr<Evidence> coarse = evidence_.coarse_around(r.at, small_beside(scale));
    const Evidence& quick = coarse ? *coarse : evidence_;
    const auto columns = sensitivities(quick, r.at, numbers);
    if (columns.empty() && !numbers.empty()) return;
    // A nudge that finds little will not find more near the next minimum.
    const bool was_nudged = r.is_nudged;
    if (r.is_nudged) {
      const std::size_t first = std::max(given_, r.nudged_from);
      Nudge nudge = nudged(quick, r.at, first, model_.nominal, BeyondNumbers(quick, columns, scale));
      r.is_nudged = nudge.gain > kRule.worth_a_nudge;
      r.at = std::move(nudge.at);
    }
    FitOptions options;
    options.cost_tolerance = 1e-3;
    std::vector<FitParameter> fitted = parameters(r.at);
    std::erase_if(fitted, [&](const FitParameter& p) { return find_parameter(r.held, p).has_value(); });
    const Fit f = fit(quick, r.at, fitted, scale, options, columns);
    if (!f.usable) return;
    const Score score = evidence_.score(f.hypothesis);
    if (!score.finite) return;
    double now = 0;
    for (int c = 0; c < evidence_.channels(); ++c)
      if (evidence_.has_channel(c))
        now += std::log(score.fit_mean_square[c] + evidence_.floor()[c] * evidence_.floor()[c]);
    if (was_nudged && now > r.last) {
      // The nudge led away from what the numbers of the model can follow within their tolerances.
      r.at = r.best.hypothesis;
      r.is_nudged = r.settled = false;
      continue;
    }
    if (now < r.last) r.best = f;
    r.at = f.hypothesis;
    r.score = score;
    r.settled = now > r.last - kWorthAPass;
    r.last = now;
  }
}

Fit Refitter::refit(const Hypothesis& h, const Score& before) const {
  Refit r{h, before};
  go_on(r, kRule.most_passes);
  return r.best;
}

std::optional<Scored> Refitter::refitted(const Hypothesis& h, const Score& before) const {
  const Fit fit = refit(h, before);
  if (!fit.usable) return std::nullopt;
  return Scored{fit.hypothesis, evidence_.score(fit.hypothesis)};
}

}  // namespace halyard
