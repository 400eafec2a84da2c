#include "diagnosis/judgement/final_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/calibration/calibrate.h"
#include "diagnosis/fit/nudged.h"
#include "diagnosis/fit/ordered_instants.h"
#include "diagnosis/judgement/decision_rule.h"
#include "diagnosis/prediction/motion_key.h"
#include "model/statistics/distributions.h"

namespace halyard {
namespace {

/// True for a shape whose usual value is a physical limit, such as edges that are sharp.
bool has_usual_value(const FitParameter& p) {
  return p.shape && !p.is_past && p.natural_bounds && (p.nominal == p.lower || p.nominal == p.upper);
}

/// Resets uncertain parameters of a fit. The effect of a reset on the other parameters is computed to first order.
class UncertainParameters {
 public:
  /// may_go: the parameters that may be reset. reach: the largest root mean square over the channels, in floors, of the
  /// change by one unit of each parameter.
  UncertainParameters(const Fit& fit, std::vector<bool> may_go, std::vector<double> reach)
      : reach_(std::move(reach)),
        fit_(fit),
        may_go_(std::move(may_go)),
        value_(Eigen::Map<const Eigen::VectorXd>(fit.value.data(), static_cast<Eigen::Index>(fit.value.size()))),
        covariance_(fit.covariance),
        kept_(fit.parameters.size(), true),
        groups_(groups_of(fit.parameters)) {}

  /// kept()[i]: parameter i keeps its change.
  const std::vector<bool>& kept() const { return kept_; }
  double value(std::size_t i) const { return value_(static_cast<Eigen::Index>(i)); }

  void reset_all() {
    for (;;) {
      std::size_t least = kept_.size();
      double smallest = 1;
      for (std::size_t i = 0; i < kept_.size(); ++i)
        if (const double has = kept_[i] && may_go_[i] ? certainty(i) : 1; has < smallest) smallest = has, least = i;
      if (least == kept_.size()) break;
      reset(static_cast<Eigen::Index>(least));
    }
    // The shapes of sizes that are gone have no meaning. The past of an effect that the model came with has no sizes.
    for (const ParameterGroup& group : groups_)
      if (!group.sizes.empty() && std::ranges::none_of(group.sizes, [&](std::size_t i) { return kept_[i]; }))
        for (const std::size_t i : group.shapes) kept_[i] = false;
  }

 private:
  /// Change over the smallest change that is significant.
  double certainty(std::size_t i) const {
    if (is_exhausted(i)) return 0;
    const FitParameter& p = fit_.parameters[i];
    const auto at = static_cast<Eigen::Index>(i);
    // What no sensor resolves is no refit of the model.
    if (!p.effect && reach_[i] * std::abs(value_(at) - p.nominal) / p.scale < 1) return 0;
    const double needed = !p.effect || has_usual_value(p) ? kRule.unusual_deviations : interval_factor(fit_);
    const double shrunk = std::sqrt(variance_beside_shapes(i) / fit_.covariance(at, at));
    return std::abs(value_(at) - p.nominal) / (needed * shrunk * fit_.std_deviation[i]);
  }

  /// Variance of a parameter; of a size: if its shapes were known. At size zero the shapes mean nothing, so what is
  /// unknown of them does not count against the size. Only the product of a size and a share may be certain.
  double variance_beside_shapes(std::size_t i) const {
    const auto at = static_cast<Eigen::Index>(i);
    for (const ParameterGroup& group : groups_) {
      if (std::ranges::count(group.sizes, i) == 0 || group.shapes.empty()) continue;
      const Eigen::MatrixXd of_shapes = covariance_(group.shapes, group.shapes);
      const Eigen::VectorXd with_size = covariance_(group.shapes, at);
      const double explained = with_size.dot(of_shapes.completeOrthogonalDecomposition().solve(with_size));
      return std::clamp(covariance_(at, at) - explained, 0.0, covariance_(at, at));
    }
    return covariance_(at, at);
  }

  /// True for a parameter at its bound, and for a size with a shape at its bound. A shape of which the data do not show
  /// where in its range it lies does not count: it does nothing.
  bool is_exhausted(std::size_t i) const {
    const auto ends = [&](std::size_t j) {
      // To first order a reset may move another parameter beyond its range.
      const FitParameter& p = fit_.parameters[j];
      return ends_at_bound(p, std::clamp(value(j), p.lower, p.upper));
    };
    const auto shape_ends = [&](std::size_t j) {
      const FitParameter& p = fit_.parameters[j];
      return ends(j) && covariance_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)) <
                            (p.upper - p.lower) * (p.upper - p.lower);
    };
    return ends(i) || std::ranges::any_of(groups_, [&](const ParameterGroup& group) {
             return std::ranges::count(group.sizes, i) > 0 && std::ranges::any_of(group.shapes, shape_ends);
           });
  }

  void reset(Eigen::Index i) {
    const Eigen::VectorXd gain = covariance_.col(i) / covariance_(i, i);
    value_ -= gain * (value_(i) - fit_.parameters[static_cast<std::size_t>(i)].nominal);
    covariance_ -= gain * covariance_.row(i);
    kept_[static_cast<std::size_t>(i)] = false;
  }

  std::vector<double> reach_;
  const Fit& fit_;
  std::vector<bool> may_go_;
  Eigen::VectorXd value_;
  Eigen::MatrixXd covariance_;
  std::vector<bool> kept_;
  std::vector<ParameterGroup> groups_;
};

/// Fits with weights that follow from the residual. They balance the data against the tolerances: noise of a sensor
/// counts by its samples, an error of the model by its correlation time. If the residual at the start was far larger
/// than what the fit leaves, its weights were too small, and the fit is repeated with those of what it leaves.
Fit weighed_fit(const Evidence& whole, Hypothesis start, const std::vector<FitParameter>& parameters) {
  constexpr double kFarLarger = 1.2;
  constexpr int kMostFits = 6;
  std::vector<double> scale;
  Fit last;
  for (int i = 0; i < kMostFits; ++i) {
    const Score score = whole.score(start);
    if (!score.finite) break;
    const std::vector<double> now = channel_scale(whole, score.fit_mean_square);
    bool was_far_larger = false;
    for (std::size_t c = 0; c < scale.size(); ++c) was_far_larger = was_far_larger || scale[c] > kFarLarger * now[c];
    if (i > 0 && !was_far_larger) break;
    scale = now;
    FitOptions options;
    options.correlated_rows = independent_rows(whole, scale);
    Fit f = fit(whole, start, parameters, scale, options);
    if (!f.usable) break;
    start = f.hypothesis;
    last = std::move(f);
  }
  return last;
}

/// Of each number of the model in the fit, see UncertainParameters; infinite for others and if it cannot be computed.
std::vector<double> reach_in_floors(const Evidence& whole, const Fit& f) {
  std::vector<FitParameter> numbers;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < f.parameters.size(); ++i)
    if (!f.parameters[i].effect) numbers.push_back(f.parameters[i]), place.push_back(i);
  const auto columns = sensitivities(whole, f.hypothesis, numbers);
  std::vector<double> reach(f.parameters.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < columns.size(); ++i) reach[place[i]] = whole.over_floor(columns[i]);
  return reach;
}

/// Resets the sizes of added effects, and shapes to their usual values, until all that are left are certain. The
/// numbers of the model stay in the fit.
Fit keep_certain_sizes(const Evidence& whole, const Fit& f, std::size_t given) {
  std::vector<bool> may_go;
  for (const FitParameter& p : f.parameters) may_go.push_back(p.effect >= given && (!p.shape || has_usual_value(p)));
  UncertainParameters uncertain(f, may_go, std::vector<double>(f.parameters.size(), 0));
  uncertain.reset_all();
  Hypothesis h = f.hypothesis;
  std::vector<FitParameter> left;
  for (std::size_t i = 0; i < f.parameters.size(); ++i) {
    const FitParameter& p = f.parameters[i];
    const bool kept = uncertain.kept()[i];
    set_parameter(h, p, kept ? std::clamp(uncertain.value(i), p.lower, p.upper) : p.nominal);
    if (kept) left.push_back(p);
  }
  if (left.size() == f.parameters.size()) return f;
  const Fit again = weighed_fit(whole, h, left);
  // A size that was certain beside those that were reset may not be certain any more.
  return again.usable ? keep_certain_sizes(whole, again, given) : f;
}

/// What was reset of added effects that keep a size. A shape means nothing without a size of its own. `all` is the fit
/// before the first reset.
std::vector<ResetParameter> resets(const Fit& all, std::size_t given, const Fit& f) {
  std::vector<ResetParameter> reset;
  const auto stays = [&](std::size_t i) { return find_parameter(f.parameters, all.parameters[i]).has_value(); };
  const auto tell = [&](std::size_t i) { reset.push_back({all.parameters[i], all.value[i], half_interval(all, i)}); };
  for (const ParameterGroup& group : groups_of(all.parameters)) {
    if (group.sizes.empty()) continue;
    const std::size_t effect = *all.parameters[group.sizes[0]].effect;
    if (effect < given || !has_a_size(f, effect)) continue;
    for (const std::size_t i : group.sizes)
      if (!stays(i)) tell(i);
    if (std::ranges::any_of(group.sizes, stays))
      for (const std::size_t i : group.shapes)
        if (!stays(i) && has_usual_value(all.parameters[i])) tell(i);
  }
  return reset;
}

/// The parameters of added effects in a place that is better on the whole data, if there is one. An instant may lie
/// anywhere in a block that the fit before did not see.
Hypothesis nudged_start(const Evidence& whole, const ArmModel& model, const Fit& chosen, std::size_t given,
                        const Score& score) {
  if (chosen.hypothesis.effects.size() == given) return chosen.hypothesis;
  std::vector<FitParameter> numbers = chosen.parameters;
  std::erase_if(numbers, [](const FitParameter& p) { return p.effect.has_value(); });
  const auto columns = sensitivities(whole, chosen.hypothesis, numbers);
  if (columns.size() != numbers.size()) return chosen.hypothesis;
  const BeyondNumbers beyond(whole, columns, channel_scale(whole, score.fit_mean_square));
  constexpr int kMostNudges = 6;  // each moves an instant to the nearest of a ladder of steps
  Nudge nudge{chosen.hypothesis, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kMostNudges && nudge.gain > kRule.worth_a_nudge; ++i)
    nudge = nudged(whole, nudge.at, given, model.nominal, beyond);
  return nudge.at;
}

/// The parameters with all numbers of the model that no added effect changes. Those to which the data were not
/// sensitive without the effects may count beside them.
std::vector<FitParameter> with_all_numbers_beside(const ArmModel& model, const Fit& chosen, std::size_t given) {
  const std::vector<PlacedEffect>& effects = chosen.hypothesis.effects;
  std::vector<FitParameter> all;
  for (const FitParameter& number : baseline_parameters(model)) {
    const bool is_covered = std::any_of(effects.begin() + static_cast<std::ptrdiff_t>(given), effects.end(),
                                        [&](const PlacedEffect& e) { return effect_covers(e, model.nominal, number); });
    if (!is_covered) all.push_back(number);
  }
  for (const FitParameter& p : chosen.parameters)
    if (p.effect) all.push_back(p);
  return all;
}

}  // namespace

Fit final_fit(const Evidence& whole, const ArmModel& model, const Fit& chosen, std::size_t given) {
  const Score score = whole.score(chosen.hypothesis);
  if (!score.finite) return {};
  const bool effects_are_added = chosen.hypothesis.effects.size() > given;
  const Hypothesis start = with_ordered_instants(nudged_start(whole, model, chosen, given, score), chosen.parameters);
  Fit tried = effects_are_added ? weighed_fit(whole, start, with_all_numbers_beside(model, chosen, given)) : Fit{};
  if (!tried.usable) tried = weighed_fit(whole, start, chosen.parameters);
  const Fit& all = tried.usable ? tried : chosen;
  if (!all.usable) return {};
  Fit certain = keep_certain_sizes(whole, all, given);
  certain.reset = resets(all, given, certain);
  count_resets(all, certain);
  return certain;
}

void count_resets(const Fit& before, Fit& f) {
  const auto has_lost_one = [&](std::size_t effect) {
    return std::ranges::any_of(f.reset, [&](const ResetParameter& r) { return r.parameter.effect == effect; });
  };
  for (std::size_t i = 0; i < f.parameters.size(); ++i) {
    const FitParameter& p = f.parameters[i];
    if (!p.effect || !has_lost_one(*p.effect)) continue;
    const std::optional<std::size_t> at = find_parameter(before.parameters, p);
    if (!at) continue;
    const double with_all = std::hypot(before.std_deviation[*at], f.value[i] - before.value[*at]);
    f.std_deviation[i] = std::max(f.std_deviation[i], with_all);
  }
}

std::vector<std::size_t> changed_numbers(const Evidence& whole, const ArmModel& model, const Fit& fit) {
  std::vector<bool> may_go;
  for (const FitParameter& p : fit.parameters) may_go.push_back(!p.effect && !is_unknown_scale(model, p.index));
  UncertainParameters uncertain(fit, may_go, reach_in_floors(whole, fit));
  uncertain.reset_all();
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (!fit.parameters[i].effect && uncertain.kept()[i]) changed.push_back(i);
  return changed;
}

Fit with_given_numbers(const Evidence& whole, const ArmModel& model, const Fit& f) {
  Hypothesis h = f.hypothesis;
  h.nominal = model.nominal;
  std::vector<FitParameter> others = f.parameters;
  std::erase_if(others, [](const FitParameter& p) { return !p.effect; });
  return weighed_fit(whole, h, others);
}

Fit with_numbers_given(const Evidence& whole, const Fit& f, const std::vector<std::size_t>& numbers) {
  Hypothesis h = f.hypothesis;
  std::vector<FitParameter> others;
  for (std::size_t i = 0; i < f.parameters.size(); ++i) {
    const FitParameter& p = f.parameters[i];
    if (std::ranges::find(numbers, i) != numbers.end()) set_parameter(h, p, p.nominal);
    else if (!p.effect) others.push_back(p);
  }
  return weighed_fit(whole, h, others);
}

Fit with_given_motion(const Evidence& whole, const ArmModel& model, const Fit& f) {
  Hypothesis h = f.hypothesis;
  h.nominal = model.nominal;
  const Record& record = whole.records().front();
  const std::vector<double> motion = motion_key(h, record);
  std::vector<FitParameter> others;
  for (const FitParameter& p : f.parameters) {
    if (p.effect) continue;
    Hypothesis changed = h;
    set_parameter(changed, p, p.upper);
    if (motion_key(changed, record) == motion) others.push_back(p);
  }
  const Fit fit = weighed_fit(whole, h, others);
  return fit.usable ? fit : weighed_fit(whole, h, {});
}

std::vector<std::size_t> idle_effects(const Fit& fit, std::size_t given) {
  std::vector<std::size_t> idle;
  for (std::size_t e = given; e < fit.hypothesis.effects.size(); ++e) {
    const PlacedEffect& effect = fit.hypothesis.effects[e];
    const SearchSpace space = search_space(*effect.effect, fit.hypothesis.nominal, effect.joint);
    std::vector<bool> is_kept(space.parameters.size(), false);
    bool has_size = false;
    for (const FitParameter& p : fit.parameters)
      if (p.effect == e && !p.is_past) is_kept[p.index] = true, has_size = has_size || !p.shape;
    bool is_whole = true;
    for (std::size_t i = 0; i < is_kept.size(); ++i)
      is_whole = is_whole && (is_kept[i] || !space.parameters[i].another_at);
    if (!has_size || !is_whole) idle.push_back(e);
  }
  return idle;
}

bool has_a_size(const Fit& fit, std::size_t effect) {
  return std::ranges::any_of(fit.parameters, [&](const FitParameter& p) { return p.effect == effect && !p.shape; });
}

bool may_be_neutral(const Fit& fit, std::size_t i) {
  return std::abs(fit.value[i] - fit.parameters[i].nominal) <= half_interval(fit, i);
}

double half_interval(const Fit& fit, std::size_t i) {
  constexpr double kMore = 4.0 / 3 - 1;
  double shift = 0;
  for (std::size_t j = 0; j < fit.parameters.size(); ++j)
    if (!fit.parameters[j].effect)
      shift += std::pow(
          fit.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / fit.parameters[j].scale, 2);
  return interval_factor(fit) * std::sqrt(std::pow(fit.std_deviation[i], 2) + kMore * shift);
}

double interval_factor(const Fit& fit) {
  constexpr double kTwoSided95 = 0.025;
  return t_quantile(std::max(1, fit.blocks - 1), kTwoSided95);
}

}  // namespace halyard
