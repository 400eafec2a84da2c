#include "diagnosis/search/basis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/fit/baseline_reach.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/search/attribution.h"

namespace halyard {
namespace {

/// Numbers to which the data are insensitive within the tolerances of the basis return to the model's values.
Hypothesis with_own_numbers(Hypothesis h, const Basis& basis) {
  for (const FitParameter& p : baseline_parameters(basis.model))
    if (!find_parameter(basis.refitter.numbers(), p)) set_parameter(h, p, p.nominal);
  return h;
}

}  // namespace

ArmModel with_tolerances_times(double factor, ArmModel model) {
  constexpr double kNearlyUnknown = 0.99;  // a scale of tolerance 1 is unknown
  for (JointDescription& joint : model.joints) {
    for_each_tolerance([&](const char*, double Tolerances::*member) {
      double& t = joint.tolerances.*member;
      if (member != &Tolerances::torque_scale) t *= factor;
      else if (t < 1) t = std::min(factor * t, kNearlyUnknown);
    });
  }
  return model;
}

Basis::Basis(const Evidence& evidence, const ArmModel& stated, double times, std::size_t given)
    : factor(times),
      model(with_tolerances_times(times, stated)),
      refitter(evidence, model, given),
      judge(evidence, model, baseline_parameters(model)),
      evidence_(evidence),
      given_(given) {}

Found Basis::refitted(const Hypothesis& h, const Score& before) const {
  Found f{refitter.refit(h, before), {}};
  f.score.finite = false;
  if (f.fit.usable) f.score = evidence_.score(f.fit.hypothesis);
  return f;
}

std::vector<Found> Basis::without_each(const Found& found, double enough) const {
  std::vector<Found> without(found.fit.hypothesis.effects.size() - given_);
  run_side_by_side(without.size(), [&](std::size_t i) {
    without[i].score.finite = false;
    Refit refit{without_effect(found.fit.hypothesis, given_ + i), found.score};
    refitter.go_on(refit, 1);
    if (log_likelihood_gain(evidence_, found.score, refit.score) >= enough) return;
    refitter.go_on(refit, kRule.most_passes - 1);
    if (refit.best.usable) without[i] = {refit.best, evidence_.score(refit.best.hypothesis)};
  });
  return without;
}

bool Basis::is_narrow(const Hypothesis& h) const {
  int n = 0;
  for (const FitParameter& p : refitter.numbers()) {
    const bool has_name = std::any_of(h.effects.begin() + static_cast<std::ptrdiff_t>(given_), h.effects.end(),
                                      [&](const PlacedEffect& e) { return effect_covers(e, model.nominal, p); });
    n += has_name || is_at_bound(p, parameter_value(h, p));
  }
  return n > 1;
}

double Basis::prior_cost(const Found& found) const {
  const Hypothesis& h = found.fit.hypothesis;
  const std::vector<FitParameter> numbers = refitter.numbers_beside(h);
  const auto columns = sensitivities(evidence_, h, numbers);
  if (columns.size() < numbers.size()) return std::numeric_limits<double>::infinity();
  const std::vector<double> scale = channel_scale(evidence_, found.score.fit_mean_square);
  double cost = judge.prior_cost(h) + BaselineReach(evidence_, columns, scale).half_log_det();
  const double choice = std::log(static_cast<double>(all_candidates(model.nominal).size()));
  for (std::size_t e = given_; e < h.effects.size(); ++e) cost += prior_cost_of(h.effects[e], model.nominal) + choice;
  return cost + kRule.cost_of_wider_tolerances * std::log2(factor);
}

std::optional<Rebased> rebased(const Evidence& evidence, const ArmModel& stated, double factor, const Basis& own,
                               const Found& found) {
  const std::size_t given = stated.effects.size();
  Rebased r{std::make_unique<Basis>(evidence, stated, factor, given), {}, {}, {}, {}};
  if (!r.basis->refitter.is_usable()) return {};
  const double own_prior = own.prior_cost(found);
  if (!std::isfinite(own_prior)) return {};
  for (std::size_t i = given; i < found.fit.hypothesis.effects.size(); ++i) r.kept.push_back(i - given);
  r.found = r.basis->refitted(with_own_numbers(found.fit.hypothesis, *r.basis), found.score);
  if (!r.found.score.finite) return {};
  double prior = r.basis->prior_cost(r.found);
  for (;;) {
    const std::vector<Found> without = r.basis->without_each(r.found, kRule.certainly_needed);
    std::size_t best = 0;
    double most = 0, its_prior = 0;
    for (std::size_t i = 0; i < without.size(); ++i) {
      if (!without[i].score.finite) continue;
      const double p = r.basis->prior_cost(without[i]);
      const double gain = log_likelihood_gain(evidence, without[i].score, r.found.score) + prior - p;
      if (gain > most) most = gain, best = i, its_prior = p;
    }
    if (most == 0) break;
    r.gone.push_back(r.found.fit.hypothesis.effects[given + best]);
    r.found = without[best];
    prior = its_prior;
    r.kept.erase(r.kept.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (log_likelihood_gain(evidence, r.found.score, found.score) + own_prior - prior <= 0) return {};
  Hypothesis none = r.found.fit.hypothesis;
  while (none.effects.size() > given) none = without_effect(none, none.effects.size() - 1);
  r.baseline = r.basis->refitted(none, found.score);
  if (!r.baseline.score.finite) return {};
  return r;
}

}  // namespace halyard
