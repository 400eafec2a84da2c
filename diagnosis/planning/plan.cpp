#include "diagnosis/plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "diagnosis/explanation/signature.h"
#include "diagnosis/fit/baseline_reach.h"
#include "diagnosis/planning/change_detector.h"
#include "diagnosis/search/attribution.h"
#include "model/input_error.h"

namespace halyard {
namespace {

/// Sizes are tried over powers of two of the typical size, so many at once, and between two of them in so many steps.
constexpr int kRungs = 8;
constexpr double kFirstStrength = 1.0 / 32, kLeast = 1e-7;

/// What a candidate may do, in the reach's weights.
struct Shown {
  DetectionLimit limit;
  Eigen::VectorXd change;  ///< d at twice the limit; of an effect that is not excited nothing
  struct Fitted {
    BaselineReach::Sizes sizes;
    std::vector<bool> bound_is_end;  ///< [sizes] an amount at its bound explains nothing
  };
  std::vector<Fitted> fitted;  ///< one for each set of shapes; sizes to be fitted
};

std::vector<Record> records_of(const ArmModel& model, const std::vector<Log>& logs) {
  std::vector<Record> records;
  for (const Log& log : logs)
    for (Record& r : make_records(log, model, {})) records.push_back(std::move(r));
  return records;
}

class Planner {
 public:
  Planner(const ArmModel& model, const std::vector<Log>& logs)
      : model_(model),
        nominal_{model.nominal, model.effects},
        evidence_(records_of(model, logs), model),
        reach_(make_reach()) {
    candidates_ = all_candidates(model.nominal);
    std::erase_if(candidates_, [&](const PlacedEffect& candidate) {
      return std::any_of(model.effects.begin(), model.effects.end(), [&](const PlacedEffect& e) {
        return e.effect == candidate.effect && e.joint == candidate.joint;
      });
    });
    residual_ = reach_.weighted(base_);
    const double fitted = static_cast<double>(std::min(kRule.most_fitted, candidates_.size()));
    detector_.emplace(evidence_, reach_, residual_, AttributionOptions{}.significance / fitted);
  }

  const std::vector<PlacedEffect>& candidates() const { return candidates_; }

  Shown show(const PlacedEffect& candidate) const {
    Shown shown;
    shown.limit.effect = candidate;
    const SizedCandidate c = sized(candidate);
    if (c.sizes.empty()) return shown;
    std::vector<Eigen::VectorXd> columns;
    const Hypothesis shaped = best_shapes(c, shown, columns);

    const FitParameter& size = c.parameters[c.sizes[0]];
    const double typical = c.unit[0], bound = typical > 0 ? size.upper : size.lower;
    const double largest = (bound - size.nominal) / typical;
    const auto at = [&](double factor) {
      Hypothesis h = shaped;
      set_parameter(h, size, factor < largest ? size.nominal + factor * typical : bound);
      return h;
    };
    const double factor = smallest_seen(at, largest);
    shown.limit.excited = std::isfinite(factor);
    const Hypothesis there = at(shown.limit.excited ? factor : largest);
    shown.limit.effect = there.effects.back();
    shown.limit.parameter = size.name;
    shown.limit.unit = size.unit;
    shown.limit.neutral = size.nominal;
    shown.limit.limit = parameter_value(there, size);
    if (!shown.limit.excited) return shown;

    // Effects need not be proportional to their size: around the limit they are fitted by what they do there.
    std::vector<double> around = {std::min(2 * factor, largest), factor, std::min(4 * factor, largest)};
    const auto near = changes_by({at(around[0]), at(around[1]), at(around[2])});
    shown.change = near[near[0].size() > 0 ? 0 : 1];
    for (std::size_t i = 0; i < near.size(); ++i) {
      columns[0] = near[i];
      std::vector<double> unit = c.unit;
      unit[0] *= around[i];
      add_fitted(shown, columns, unit, c);
    }
    return shown;
  }

  /// The smallest share of the effect's sizes that is seen; infinite if there is none.
  double detected_from(const PlacedEffect& effect) const {
    Hypothesis with = nominal_;
    with.effects.push_back(effect);
    const auto parameters =
        effect_parameters(evidence_, with, model_.nominal, static_cast<int>(nominal_.effects.size()));
    const auto at = [&](double share) {
      Hypothesis h = with;
      for (const FitParameter& p : parameters)
        if (!p.shape) set_parameter(h, p, std::lerp(p.nominal, parameter_value(with, p), share));
      return h;
    };
    return smallest_seen(at, 1);
  }

  /// True if the other effect explains what the first one does at twice its limit nearly as well.
  bool confused(const Shown& right, const Shown& other) const {
    if (!right.limit.excited) return false;
    const Eigen::VectorXd x = residual_ + right.change;
    BaselineReach::Taken best;
    best.cost = std::numeric_limits<double>::infinity();
    for (const Shown::Fitted& f : other.fitted) {
      BaselineReach::Taken t = reach_.take(x, f.sizes);
      bool at_end = false;
      for (std::size_t i = 0; i < f.bound_is_end.size(); ++i) {
        const auto e = static_cast<Eigen::Index>(i);
        at_end = at_end || (f.bound_is_end[i] && t.amount(e) != 0 &&
                            (t.amount(e) <= f.sizes.lower(e) || t.amount(e) >= f.sizes.upper(e)));
      }
      if (!at_end && t.cost < best.cost) best = std::move(t);
    }
    if (!std::isfinite(best.cost)) return false;
    return !detector_->tells_from_reference(best.left);
  }

  /// See Separation::cosine; one way.
  double cosine(const Shown& right, const Shown& other) const {
    if (!right.limit.excited || !other.limit.excited) return 1;
    const double alone = reach_.take(right.change).cost;
    double left = alone;
    for (const Shown::Fitted& f : other.fitted) left = std::min(left, reach_.take(right.change, f.sizes).cost);
    return std::sqrt(1 - left / alone);
  }

 private:
  BaselineReach make_reach() {
    const Score score = evidence_.score(nominal_);
    const std::vector<FitParameter> numbers = baseline_parameters(model_);
    const auto columns = sensitivities(evidence_, nominal_, numbers);
    if (!score.finite || (columns.empty() && !numbers.empty()))
      throw InputError(
          model_.source +
          ": cannot be integrated along the motion; expected frictions and cables that settle more slowly: "
          "take larger smoothing speeds, or less damping");
    base_ = evidence_.fit_rows({nominal_})[0];
    return BaselineReach(evidence_, columns, channel_scale(evidence_, score.fit_mean_square));
  }

  /// Instants one after another over the record, positions in the middle; sizes to their neutral values.
  void place_shapes(Hypothesis& h, const std::vector<FitParameter>& parameters) const {
    const auto is_instant = [](const FitParameter& p) { return p.range == SearchRange::record_time; };
    const double instants = static_cast<double>(std::count_if(parameters.begin(), parameters.end(), is_instant));
    double instant = 0;
    for (const FitParameter& p : parameters) {
      if (!p.shape) set_parameter(h, p, p.nominal);
      else if (is_instant(p)) set_parameter(h, p, std::lerp(p.lower, p.upper, ++instant / (instants + 1)));
      else if (p.range == SearchRange::joint_position) set_parameter(h, p, (p.lower + p.upper) / 2);
    }
  }

  /// A candidate with its sizes at their typical values.
  struct SizedCandidate {
    Hypothesis with;
    std::vector<FitParameter> parameters;
    std::vector<std::size_t> sizes;  ///< indices in parameters
    std::vector<double> unit;        ///< [sizes] typical size less the neutral one
  };

  SizedCandidate sized(const PlacedEffect& candidate) const {
    SizedCandidate c{nominal_, {}, {}, {}};
    c.with.effects.push_back(candidate);
    c.parameters = effect_parameters(evidence_, c.with, model_.nominal, static_cast<int>(nominal_.effects.size()));
    for (std::size_t i = 0; i < c.parameters.size(); ++i)
      if (!c.parameters[i].shape) {
        c.sizes.push_back(i);
        c.unit.push_back(parameter_value(c.with, c.parameters[i]) - c.parameters[i].nominal);
      }
    return c;
  }

  /// The shapes at which the first size changes most, and what each size changes there. One size at a time is tried at its
  /// typical value, at each set of shapes.
  Hypothesis best_shapes(const SizedCandidate& c, Shown& shown, std::vector<Eigen::VectorXd>& columns) const {
    Hypothesis neutral = c.with;
    place_shapes(neutral, c.parameters);
    const std::vector<Hypothesis> shaped = shape_sets(neutral, c.parameters, c.sizes[0]);
    std::vector<Hypothesis> tried;
    for (const Hypothesis& h : shaped)
      for (const std::size_t i : c.sizes) {
        tried.push_back(h);
        set_parameter(tried.back(), c.parameters[i], parameter_value(c.with, c.parameters[i]));
      }
    const auto changes = changes_by(tried);
    std::size_t best = 0;
    double most = -1;
    for (std::size_t s = 0; s < shaped.size(); ++s) {
      const auto first = changes.begin() + static_cast<std::ptrdiff_t>(s * c.sizes.size());
      const std::vector<Eigen::VectorXd> here(first, first + static_cast<std::ptrdiff_t>(c.sizes.size()));
      add_fitted(shown, here, c.unit, c);
      const double shows = here[0].size() ? reach_.take(here[0]).cost : 0;
      if (shows > most) most = shows, best = s, columns = here;
    }
    return shaped[best];
  }

  /// Every combination of the starts of the shapes that follow the first size.
  static std::vector<Hypothesis> shape_sets(const Hypothesis& h, const std::vector<FitParameter>& parameters,
                                            std::size_t main) {
    std::vector<Hypothesis> all = {h};
    std::size_t i = main;
    while (i < parameters.size() && !parameters[i].shape) ++i;
    for (; i < parameters.size() && parameters[i].shape; ++i) {
      if (parameters[i].starts.empty() || is_past(parameters[i])) continue;
      std::vector<Hypothesis> longer;
      for (const Hypothesis& one : all)
        for (const double value : parameters[i].starts) {
          longer.push_back(one);
          set_parameter(longer.back(), parameters[i], value);
        }
      all = std::move(longer);
    }
    return all;
  }

  /// d of each hypothesis; empty if it cannot be integrated.
  std::vector<Eigen::VectorXd> changes_by(const std::vector<Hypothesis>& hypotheses) const {
    const auto rows = evidence_.fit_rows(hypotheses);
    std::vector<Eigen::VectorXd> changes(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!rows[i].empty()) changes[i] = residual_ - reach_.weighted(rows[i]);
    return changes;
  }

  /// unit: what an amount of 1 is of each size.
  void add_fitted(Shown& shown, const std::vector<Eigen::VectorXd>& columns, const std::vector<double>& unit,
                  const SizedCandidate& c) const {
    Shown::Fitted f;
    std::vector<Eigen::VectorXd> used;
    std::vector<double> lower, upper;
    for (std::size_t i = 0; i < c.sizes.size(); ++i) {
      if (columns[i].size() == 0 || columns[i].squaredNorm() == 0) continue;
      const FitParameter& p = c.parameters[c.sizes[i]];
      const auto [low, high] = std::minmax({(p.lower - p.nominal) / unit[i], (p.upper - p.nominal) / unit[i]});
      used.push_back(columns[i]);
      lower.push_back(low), upper.push_back(high);
      f.bound_is_end.push_back(!p.natural_bounds);
    }
    if (used.empty()) return;
    Eigen::MatrixXd E(residual_.size(), static_cast<Eigen::Index>(used.size()));
    for (std::size_t i = 0; i < used.size(); ++i) E.col(static_cast<Eigen::Index>(i)) = used[i];
    const Eigen::Index n = E.cols();
    f.sizes = reach_.sizes(std::move(E), Eigen::VectorXd::Map(lower.data(), n), Eigen::VectorXd::Map(upper.data(), n));
    shown.fitted.push_back(std::move(f));
  }

  /// The smallest factor of the typical size at which the effect is seen; infinite if there is none up to the largest.
  template <class At>
  double smallest_seen(const At& at, double largest) const {
    const auto first_seen = [&](const std::vector<double>& factors) {
      std::vector<Hypothesis> h;
      for (const double f : factors) h.push_back(at(f));
      const auto changes = changes_by(h);
      std::size_t i = 0;
      while (i < changes.size() && !detector_->detects(changes[i])) ++i;
      return i;
    };
    double unseen = 0, least = std::numeric_limits<double>::infinity();
    for (double from = kFirstStrength;;) {
      std::vector<double> factors;
      for (int i = 0; i < kRungs && (factors.empty() || factors.back() < largest); ++i)
        factors.push_back(std::min(std::ldexp(from, i), largest));
      const std::size_t first = first_seen(factors);
      if (first < factors.size()) least = factors[first];
      if (first > 0) unseen = factors[first - 1];
      if (std::isfinite(least) && (unseen > 0 || from < kLeast)) break;
      if (!std::isfinite(least) && factors.back() >= largest) return least;
      from = std::ldexp(from, std::isfinite(least) ? -kRungs : kRungs);
    }
    if (unseen == 0) return least;
    std::vector<double> between;
    for (int i = 1; i < kRungs; ++i)
      between.push_back(unseen * std::pow(least / unseen, static_cast<double>(i) / kRungs));
    const std::size_t first = first_seen(between);
    return first < between.size() ? between[first] : least;
  }

  const ArmModel& model_;
  Hypothesis nominal_;
  Evidence evidence_;
  std::vector<double> base_;  ///< fitting rows of the model as it is
  BaselineReach reach_;
  std::vector<PlacedEffect> candidates_;
  Eigen::VectorXd residual_;  ///< r0
  std::optional<ChangeDetector> detector_;
};

}  // namespace

std::vector<DetectionLimit> detection_limits(const ArmModel& model, const std::vector<Log>& logs,
                                             const std::function<void(const std::string&, double)>& progress) {
  const Planner planner(model, logs);
  const auto& candidates = planner.candidates();
  std::vector<Shown> shown(candidates.size());
  std::atomic<std::size_t> done{0};
  const auto say = [&](const char* what) {
    if (progress) progress(what, static_cast<double>(++done) / static_cast<double>(candidates.size()));
  };
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    shown[i] = planner.show(candidates[i]);
    say("detection limits");
  });
  done = 0;
  std::vector<DetectionLimit> limits(candidates.size());
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    limits[i] = shown[i].limit;
    for (std::size_t j = 0; j < candidates.size(); ++j)
      if (j != i && planner.confused(shown[i], shown[j])) limits[i].confused_with.push_back(candidates[j]);
    say("effects that look alike");
  });
  return limits;
}

std::vector<double> detected_from(const ArmModel& model, const std::vector<Log>& logs,
                                  const std::vector<PlacedEffect>& effects) {
  const Planner planner(model, logs);
  std::vector<double> shares;
  for (const PlacedEffect& effect : effects) shares.push_back(planner.detected_from(effect));
  return shares;
}

bool names_nothing(const ArmModel& model, const std::vector<Log>& logs) {
  const std::vector<Record> records = records_of(model, logs);
  for (int k = 0; k < model.n(); ++k)
    if (!is_one_sinusoid(records, model.nominal, k)) return false;
  return true;
}

Separation separation(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& first,
                      const PlacedEffect& second) {
  const Planner planner(model, logs);
  const Shown a = planner.show(first), b = planner.show(second);
  Separation s{a.limit, b.limit, std::max(planner.cosine(a, b), planner.cosine(b, a)), false};
  if (planner.confused(a, b)) s.first.confused_with = {second};
  if (planner.confused(b, a)) s.second.confused_with = {first};
  s.told_apart = a.limit.excited && b.limit.excited && s.first.confused_with.empty() &&
                 s.second.confused_with.empty() && !names_nothing(model, logs);
  return s;
}

}  // namespace halyard
