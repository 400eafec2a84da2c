#include "diagnosis/planning/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/prediction/room.h"
#include "diagnosis/search/attribution.h"

namespace halyard {
namespace {

/// Sizes are tried over powers of two of the typical size, so many at once, and between two of them in so many steps.
constexpr int kRungs = 8;
constexpr double kFirstStrength = 1.0 / 32, kLeast = 1e-7;

/// Instants one after another over the record, positions in the middle; sizes to their neutral values.
void place_shapes(Hypothesis& h, const std::vector<FitParameter>& parameters) {
  const auto is_instant = [](const FitParameter& p) { return p.range == SearchRange::record_time; };
  const double instants = static_cast<double>(std::count_if(parameters.begin(), parameters.end(), is_instant));
  double instant = 0;
  for (const FitParameter& p : parameters) {
    if (!p.shape) set_parameter(h, p, p.nominal);
    else if (is_instant(p)) set_parameter(h, p, std::lerp(p.lower, p.upper, ++instant / (instants + 1)));
    else if (p.range == SearchRange::joint_position) set_parameter(h, p, (p.lower + p.upper) / 2);
  }
}

/// Every combination of the starts of the shapes that follow the first size.
std::vector<Hypothesis> shape_sets(const Hypothesis& h, const std::vector<FitParameter>& parameters, std::size_t main) {
  std::vector<Hypothesis> all = {h};
  std::size_t i = main;
  while (i < parameters.size() && !parameters[i].shape) ++i;
  for (; i < parameters.size() && parameters[i].shape; ++i) {
    if (parameters[i].starts.empty() || parameters[i].is_past) continue;
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

}  // namespace

std::vector<Record> planned_records(const ArmModel& model, const std::vector<Log>& logs) {
  std::vector<Record> records;
  for (const Log& log : logs)
    for (Record& r : make_records(log, model, {})) records.push_back(std::move(r));
  return records;
}

/// A candidate with its sizes at their typical values.
struct Planner::SizedCandidate {
  Hypothesis with;
  std::vector<FitParameter> parameters;
  std::vector<std::size_t> sizes;  ///< indices in parameters
  std::vector<double> unit;        ///< [sizes] typical size less the neutral one
};

Planner::Planner(const ArmModel& model, const std::vector<Log>& logs)
    : model_(model),
      nominal_{model.nominal, model.effects},
      evidence_(planned_records(model, logs), model),
      reach_(make_reach()) {
  candidates_ = all_candidates(model.nominal);
  std::erase_if(candidates_, [&](const PlacedEffect& candidate) {
    return std::ranges::any_of(model.effects, [&](const PlacedEffect& e) { return same_name(e, candidate); });
  });
  residual_ = reach_.weighted(base_);
  const double fitted = static_cast<double>(std::min(kRule.most_fitted, candidates_.size()));
  detector_.emplace(evidence_, reach_, residual_, AttributionOptions{}.significance / fitted);
}

Planner::Shown Planner::show(const PlacedEffect& candidate) const {
  Shown shown;
  shown.limit.effect = candidate;
  shown.seen_from = std::numeric_limits<double>::infinity();
  const SizedCandidate c = sized(candidate);
  if (c.sizes.empty()) return shown;
  std::vector<Eigen::VectorXd> columns;
  const Hypothesis shaped = best_shapes(c, shown, columns);

  const FitParameter& size = c.parameters[c.sizes[0]];
  const double typical = c.unit[0], bound = typical > 0 ? size.upper : size.lower;
  const double largest = (bound - size.nominal) / typical;
  shown.growing.largest = largest;
  shown.growing.at = [shaped, size, typical, bound, largest](double factor) {
    Hypothesis h = shaped;
    set_parameter(h, size, factor < largest ? size.nominal + factor * typical : bound);
    return h;
  };
  const auto& at = shown.growing.at;
  if (has_enough_periods(evidence_, candidate, model_.nominal)) shown.seen_from = detected_from(shown.growing);
  else shown.fitted.clear();  // no search tries it
  const double factor = shown.seen_from;
  shown.limit.excited = std::isfinite(factor);
  const Hypothesis there = at(std::min(factor, largest));
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

Planner::Placed Planner::beside_nominal(const PlacedEffect& effect) const {
  Hypothesis with = nominal_;
  with.effects.push_back(effect);
  return {with, effect_parameters(evidence_, with, model_.nominal, nominal_.effects.size())};
}

Planner::Growing Planner::scaled(const PlacedEffect& effect) const {
  const auto at = [placed = beside_nominal(effect)](double factor) {
    Hypothesis h = placed.with;
    for (const FitParameter& p : placed.parameters)
      if (!p.shape) set_parameter(h, p, std::lerp(p.nominal, parameter_value(placed.with, p), std::min(factor, 1.0)));
    return h;
  };
  return {at, 1};
}

bool Planner::is_searched(const PlacedEffect& effect) const {
  if (!has_enough_periods(evidence_, effect, model_.nominal)) return false;
  const Placed placed = beside_nominal(effect);
  return std::ranges::all_of(placed.parameters, [&](const FitParameter& p) {
    if (!p.shape || p.is_past || p.range != SearchRange::own) return true;
    const double value = parameter_value(placed.with, p);
    return value >= p.lower && value <= p.upper;
  });
}

double Planner::detected_from(const Growing& effect) const {
  return smallest(effect, kFirstStrength, [&](const Eigen::VectorXd& change) { return detector_->detects(change); });
}

double Planner::named_from(const Growing& effect, double seen_from, const std::vector<const Shown*>& others) const {
  if (!std::isfinite(seen_from)) return seen_from;
  const Eigen::VectorXd least = changes_by({effect.at(seen_from)})[0];
  std::vector<const Shown*> rivals = others;
  if (least.size() > 0) std::erase_if(rivals, [&](const Shown* other) { return !confused(least, *other); });
  if (rivals.empty()) return seen_from;
  return smallest(effect, seen_from, [&](const Eigen::VectorXd& change) {
    return detector_->detects(change) &&
           std::ranges::none_of(rivals, [&](const Shown* other) { return confused(change, *other); });
  });
}

bool Planner::confused(const Eigen::VectorXd& change, const Shown& other) const {
  const Eigen::VectorXd x = residual_ + change;
  BaselineReach::Taken best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const Fitted& f : other.fitted) {
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

double Planner::cosine(const Shown& right, const Shown& other) const {
  if (!right.limit.excited || !other.limit.excited) return 1;
  const double alone = reach_.take(right.change).cost;
  double left = alone;
  for (const Fitted& f : other.fitted) left = std::min(left, reach_.take(right.change, f.sizes).cost);
  return std::sqrt(1 - left / alone);
}

BaselineReach Planner::make_reach() {
  const Score score = evidence_.score(nominal_);
  const std::vector<FitParameter> numbers = baseline_parameters(model_);
  const auto columns = sensitivities(evidence_, nominal_, numbers);
  if (!score.finite || (columns.empty() && !numbers.empty())) refuse_to_predict(model_, "motion");
  base_ = evidence_.fit_rows({nominal_})[0];
  return BaselineReach(evidence_, columns, channel_scale(evidence_, score.fit_mean_square));
}

Planner::SizedCandidate Planner::sized(const PlacedEffect& candidate) const {
  auto [with, parameters] = beside_nominal(candidate);
  SizedCandidate c{std::move(with), std::move(parameters), {}, {}};
  for (std::size_t i = 0; i < c.parameters.size(); ++i)
    if (!c.parameters[i].shape) {
      c.sizes.push_back(i);
      c.unit.push_back(parameter_value(c.with, c.parameters[i]) - c.parameters[i].nominal);
    }
  return c;
}

/// The shapes at which the first size changes most, and what each size changes there. One size at a time is tried at
/// its typical value, at each set of shapes.
Hypothesis Planner::best_shapes(const SizedCandidate& c, Shown& shown, std::vector<Eigen::VectorXd>& columns) const {
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

std::vector<Eigen::VectorXd> Planner::changes_by(const std::vector<Hypothesis>& hypotheses) const {
  const auto rows = evidence_.fit_rows(hypotheses);
  std::vector<Eigen::VectorXd> changes(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].empty()) changes[i] = residual_ - reach_.weighted(rows[i]);
  return changes;
}

/// unit: what an amount of 1 is of each size.
void Planner::add_fitted(Shown& shown, const std::vector<Eigen::VectorXd>& columns, const std::vector<double>& unit,
                         const SizedCandidate& c) const {
  Fitted f;
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

double Planner::smallest(const Growing& effect, double first,
                         const std::function<bool(const Eigen::VectorXd&)>& accepts) const {
  const auto first_accepted = [&](const std::vector<double>& factors) {
    std::vector<Hypothesis> h;
    for (const double f : factors) h.push_back(effect.at(f));
    const auto changes = changes_by(h);
    std::size_t i = 0;
    while (i < changes.size() && !accepts(changes[i])) ++i;
    return i;
  };
  double refused = 0, least = std::numeric_limits<double>::infinity();
  for (double from = first;;) {
    std::vector<double> factors;
    for (int i = 0; i < kRungs && (factors.empty() || factors.back() < effect.largest); ++i)
      factors.push_back(std::min(std::ldexp(from, i), effect.largest));
    const std::size_t place = first_accepted(factors);
    if (place < factors.size()) least = factors[place];
    if (place > 0) refused = factors[place - 1];
    if (std::isfinite(least) && (refused > 0 || from < kLeast)) break;
    if (!std::isfinite(least) && factors.back() >= effect.largest) return least;
    from = std::ldexp(from, std::isfinite(least) ? -kRungs : kRungs);
  }
  if (refused == 0) return least;
  std::vector<double> between;
  for (int i = 1; i < kRungs; ++i)
    between.push_back(refused * std::pow(least / refused, static_cast<double>(i) / kRungs));
  const std::size_t place = first_accepted(between);
  return place < between.size() ? between[place] : least;
}

}  // namespace halyard
