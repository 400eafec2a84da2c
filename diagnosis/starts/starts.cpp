#include "diagnosis/starts/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnosis/judgement/decision_rule.h"

namespace halyard {
namespace {

constexpr int kTimes = 10;       ///< instants of a record that are tried where there are several of them in a group
constexpr int kTimesAlone = 30;  ///< and where there is one, beside those at which the residual leaps
constexpr int kPositions = 6;    ///< positions of a joint's range

std::vector<double> even(const FitParameter& p, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(p.lower + (i + 0.5) / n * (p.upper - p.lower));
  return all;
}

/// Evenly over the time that the records cover, on the common clock: none lies in a pause between two of them.
std::vector<double> even_instants(const std::vector<Record>& records, int n) {
  std::vector<Span> covered;
  double total = 0;
  for (const Record& r : records) {
    covered.push_back({r.start + r.clock_shift, r.time(r.size - 1) + r.clock_shift});
    total += covered.back().last - covered.back().first;
  }
  std::vector<double> all;
  for (int i = 0; i < n; ++i) {
    double after = (i + 0.5) / n * total;
    std::size_t r = 0;
    for (; r + 1 < covered.size() && after > covered[r].last - covered[r].first; ++r)
      after -= covered[r].last - covered[r].first;
    all.push_back(covered[r].first + after);
  }
  return all;
}

/// Every combination of the shapes' starts; instants of one group follow each other.
std::vector<std::vector<double>> combinations(const Evidence& evidence, const Hypothesis& h,
                                              const std::vector<FitParameter>& parameters,
                                              const std::vector<std::size_t>& shapes,
                                              const std::vector<double>& leaps) {
  const auto is_instant = [&](std::size_t s) { return parameters[s].range == SearchRange::record_time; };
  const bool alone = std::ranges::count_if(shapes, is_instant) == 1;
  const auto starts_of = [&](const FitParameter& p) {
    switch (p.range) {
      case SearchRange::joint_position: return even(p, kPositions);
      case SearchRange::record_time: {
        std::vector<double> instants = even_instants(evidence.records(), alone ? kTimesAlone : kTimes);
        if (alone) instants.insert(instants.end(), leaps.begin(), leaps.end());
        return instants;
      }
      case SearchRange::own: break;
    }
    return p.starts.empty() ? std::vector<double>{parameter_value(h, p)} : p.starts;
  };
  std::vector<std::vector<double>> all = {{}};
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const FitParameter& p = parameters[shapes[s]];
    std::vector<std::vector<double>> longer;
    for (const auto& head : all)
      for (const double value : starts_of(p)) {
        const bool follows = s > 0 && is_instant(shapes[s]) && is_instant(shapes[s - 1]);
        if (follows && value <= head.back()) continue;
        // Each record has its own past and says nothing about the others: all pasts get the same start.
        const bool beside = s > 0 && p.is_past && parameters[shapes[s - 1]].is_past;
        if (beside && value != head.back()) continue;
        longer.push_back(head);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

class StartSearch {
 public:
  StartSearch(const Evidence& evidence, const Screen& screen, const Hypothesis& with,
              const ArmParameters<double>& nominal)
      : evidence_(evidence),
        screen_(screen),
        nominal_(nominal),
        with_(with),
        parameters_(effect_parameters(evidence, with, nominal, with.effects.size() - 1)),
        neutral_(with) {
    for (const FitParameter& p : parameters_)
      if (!p.shape) set_parameter(neutral_, p, p.nominal);
    for (const ParameterGroup& group : groups_of(parameters_)) add_group(group);
  }

  Start run() {
    Start start;
    std::vector<Hypothesis> first;
    for (const Tried& t : tried_) first.push_back(t.hypothesis);
    first.push_back(neutral_);
    const auto rows = evidence_.fit_rows(first);
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const Screen::Direction d = screen_.direction(rows[i]);
      tried_[i].promise = d.promise;
      start.promise = std::max(start.promise, ask(tried_[i], d));
    }
    start.directions = directions(rows);
    if (start.promise == 0) return start;

    const std::vector<Asked> second = most_promising();
    std::vector<Hypothesis> asked;
    for (const Asked& a : second) asked.push_back(a.hypothesis);
    const auto second_rows = evidence_.fit_rows(asked);
    std::vector<Least> least(n_laws_);
    for (std::size_t i = 0; i < tried_.size(); ++i)
      least[combinations_[tried_[i].combination].law].consider(first[i], screen_.left(rows[i]));
    for (std::size_t i = 0; i < second.size(); ++i) {
      least[combinations_[second[i].combination].law].consider(asked[i], screen_.left(second_rows[i]));
      // A typical size may be far beyond what is linear; the size that the linear fit asks for is not.
      if (const Screen::Direction d = screen_.direction(second_rows[i]); d.amount > 0)
        start.promise = std::max(start.promise, d.promise);
    }
    std::erase_if(least, [](const Least& l) { return !std::isfinite(l.left); });
    std::ranges::stable_sort(least, {}, &Least::left);
    const bool may_be_another =
        std::ranges::any_of(parameters_, [](const FitParameter& p) { return p.shape && p.another_at; });
    const std::size_t most = may_be_another ? kRule.starts_fitted_beside_another : kRule.starts_fitted;
    if (least.size() > most) least.resize(most);
    for (const Least& l : least) start.hypotheses.push_back(l.hypothesis);
    if (!least.empty()) start.left = least[0].left;
    return start;
  }

 private:
  /// One size moved, at some shapes: what the linear fit would make of it tells the promise and a better size.
  struct Tried {
    Hypothesis hypothesis;
    std::size_t combination, size;
    double promise = 0;
  };
  /// Values of the shapes of one group.
  struct Combination {
    ParameterGroup group;
    Hypothesis shaped;  ///< with them and without any size
    std::size_t law;    ///< the same for combinations that differ only in the past, which says nothing about the arm
    bool one_sided;     ///< the sign of a size says on which side of a position the effect acts
  };
  /// What the linear fits ask for at one combination of shapes.
  struct Asked {
    Hypothesis hypothesis;
    std::size_t combination;
    std::vector<double> promise_of = {};  ///< [parameters] of the size's most promising value
    double promise = 0;
  };

  /// What leaves least of one law.
  struct Least {
    Hypothesis hypothesis;
    double left = std::numeric_limits<double>::infinity();
    void consider(const Hypothesis& h, double its_left) {
      if (its_left < left) left = its_left, hypothesis = h;
    }
  };

  void add_group(const ParameterGroup& group) {
    const auto shapes = combinations(evidence_, with_, parameters_, group.shapes, screen_.instants());
    const bool one_sided = std::any_of(group.shapes.begin(), group.shapes.end(), [&](std::size_t s) {
      return parameters_[s].range == SearchRange::joint_position;
    });
    const std::vector<double>* last = nullptr;
    for (const auto& values : shapes) {
      const Hypothesis at = shaped(group, values);
      for (const std::size_t size : group.sizes) add_sizes(at, size, one_sided, shapes.size() > 1);
      if (!last || !differ_only_in_the_past(group, *last, values)) ++n_laws_;
      combinations_.push_back({group, at, n_laws_ - 1, one_sided});
      asked_.push_back({neutral_, asked_.size()});
      last = &values;
    }
  }

  /// Pasts are the last shapes, so such combinations follow each other.
  bool differ_only_in_the_past(const ParameterGroup& group, const std::vector<double>& a,
                               const std::vector<double>& b) const {
    for (std::size_t s = 0; s < a.size(); ++s)
      if (a[s] != b[s] && !parameters_[group.shapes[s]].is_past) return false;
    return true;
  }

  Hypothesis shaped(const ParameterGroup& group, const std::vector<double>& values) const {
    Hypothesis h = neutral_;
    for (std::size_t s = 0; s < values.size(); ++s) {
      const FitParameter& p = parameters_[group.shapes[s]];
      // The scale of a past depends on the shapes before it.
      const double unit = p.is_past ? effect_parameters(evidence_, h, nominal_, *p.effect)[group.shapes[s]].scale : 1;
      set_parameter(h, p, unit * values[s]);
    }
    return h;
  }

  /// The size at its typical value; without shapes also over decades.
  void add_sizes(const Hypothesis& at, std::size_t size, bool one_sided, bool has_shapes) {
    constexpr int kSizes = 7;
    constexpr double kSizeSpan = 30, kRatioSpan = 12;
    const FitParameter& p = parameters_[size];
    const auto add = [&](double value) {
      tried_.push_back({at, asked_.size(), size});
      set_parameter(tried_.back().hypothesis, p, std::clamp(value, p.lower, p.upper));
    };
    add(p.nominal + p.scale);
    if (one_sided && p.lower < p.nominal) add(p.nominal - p.scale);
    // A share that is nearly all makes another signal than the typical one.
    constexpr double kNearlyAll = 0.9, kMostAddition = 3;
    if (has_shapes && p.lower == p.nominal && p.upper < p.nominal + kMostAddition * p.scale)
      add(p.nominal + kNearlyAll * (p.upper - p.nominal));
    if (has_shapes || p.natural_bounds || p.lower < 0) return;
    const bool ratio = p.nominal == 1;
    const double typical = ratio ? 1 : p.nominal + p.scale, span = ratio ? kRatioSpan : kSizeSpan;
    for (int i = 0; i < kSizes; ++i) add(typical * std::pow(span, (2.0 * i + 1) / kSizes - 1));
  }

  /// Notes what the linear fit asks for. Returns its promise; 0 if it asks for nothing.
  double ask(const Tried& t, const Screen::Direction& d) {
    const FitParameter& p = parameters_[t.size];
    const double moved = parameter_value(t.hypothesis, p) - p.nominal;
    const double wanted = p.nominal + d.amount * moved;
    // If the bounds leave nothing of the wanted change, or if it would act elsewhere, this size explains nothing.
    if (std::clamp(wanted, p.lower, p.upper) == p.nominal || moved == 0) return 0;
    if (combinations_[t.combination].one_sided && d.amount < 0) return 0;
    Asked& asked = asked_[t.combination];
    // Shapes come with the first hypothesis of their combination; of several sizes each asks for its own.
    if (asked.promise_of.empty()) {
      asked = {t.hypothesis, t.combination, std::vector<double>(parameters_.size(), 0)};
      for (const FitParameter& other : parameters_)
        if (!other.shape) set_parameter(asked.hypothesis, other, other.nominal);
    }
    if (d.promise > asked.promise_of[t.size]) {
      set_parameter(asked.hypothesis, p, std::clamp(wanted, p.lower, p.upper));
      asked.promise_of[t.size] = d.promise;
    }
    asked.promise = std::max(asked.promise, d.promise);
    return d.promise;
  }

  /// The most promising of what the linear fits ask for.
  std::vector<Asked> most_promising() const {
    constexpr std::size_t kMost = 8;
    std::vector<Asked> order = asked_;
    std::erase_if(order, [](const Asked& a) { return a.promise == 0; });
    std::ranges::stable_sort(order, std::ranges::greater{}, &Asked::promise);
    if (order.size() > kMost) order.resize(kMost);
    return order;
  }

  /// At the most promising combinations of shapes. rows: of what was tried, then of neutral_.
  std::vector<Directions> directions(const std::vector<std::vector<double>>& rows) const {
    constexpr std::size_t kCombinations = 3;
    std::vector<std::size_t> order(combinations_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t c) { return asked_[c].promise; });
    std::vector<Directions> all;
    if (rows.back().empty()) return all;
    for (const std::size_t c : order) {
      if (all.size() == kCombinations) break;
      const ParameterGroup& group = combinations_[c].group;
      Directions d{combinations_[c].shaped, {}, {}, group.sizes.size() + group.shapes.size()};
      for (const std::size_t size : group.sizes) add_direction(d, c, size, rows);
      if (!d.sizes.empty()) all.push_back(std::move(d));
    }
    return all;
  }

  /// The change by the most promising value of a size that was tried there, if any can be integrated.
  void add_direction(Directions& d, std::size_t combination, std::size_t size,
                     const std::vector<std::vector<double>>& rows) const {
    const FitParameter& p = parameters_[size];
    const auto moved = [&](const Tried& t) { return parameter_value(t.hypothesis, p) - p.nominal; };
    std::size_t best = tried_.size();
    for (std::size_t i = 0; i < tried_.size(); ++i) {
      const Tried& t = tried_[i];
      if (t.combination != combination || t.size != size || rows[i].empty() || moved(t) == 0) continue;
      if (best == tried_.size() || t.promise > tried_[best].promise) best = i;
    }
    if (best == tried_.size()) return;
    std::vector<double> column = rows[best];
    for (std::size_t r = 0; r < column.size(); ++r)
      column[r] = (column[r] - rows.back()[r]) * p.scale / moved(tried_[best]);
    d.sizes.push_back(p);
    if (combinations_[combination].one_sided) {
      if (moved(tried_[best]) > 0) d.sizes.back().lower = p.nominal;
      else d.sizes.back().upper = p.nominal;
    }
    d.columns.push_back(std::move(column));
  }

  const Evidence& evidence_;
  const Screen& screen_;
  const ArmParameters<double>& nominal_;
  const Hypothesis& with_;
  std::vector<FitParameter> parameters_;
  Hypothesis neutral_;  ///< shapes as in with_
  std::vector<Tried> tried_;
  std::vector<Combination> combinations_;
  std::size_t n_laws_ = 0;
  std::vector<Asked> asked_;  ///< [combination of shapes]
};

}  // namespace

Start best_start(const Evidence& evidence, const Screen& screen, const Hypothesis& with,
                 const ArmParameters<double>& nominal) {
  return StartSearch(evidence, screen, with, nominal).run();
}

}  // namespace halyard
