#include "diagnosis/search/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Every combination of the shapes' starts; instants of one group follow each other.
std::vector<std::vector<double>> combinations(const Hypothesis& h, const std::vector<FitParameter>& parameters,
                                              const std::vector<std::size_t>& shapes,
                                              const std::vector<double>& leaps) {
  const auto is_instant = [&](std::size_t s) { return parameters[s].range == SearchRange::record_time; };
  const bool alone = std::ranges::count_if(shapes, is_instant) == 1;
  const auto starts_of = [&](const FitParameter& p) {
    switch (p.range) {
      case SearchRange::joint_position: return even(p, kPositions);
      case SearchRange::record_time: {
        std::vector<double> instants = even(p, alone ? kTimesAlone : kTimes);
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
        // Each record has its own past, and shows nothing of the others': all are tried at once.
        const bool beside = s > 0 && is_past(p) && is_past(parameters[shapes[s - 1]]);
        if (beside && value != head.back()) continue;
        longer.push_back(head);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

Start best_start(const Evidence& evidence, const Screen& screen, const Hypothesis& with,
                 const ArmParameters<double>& nominal) {
  const auto parameters = effect_parameters(evidence, with, nominal, static_cast<int>(with.effects.size()) - 1);
  Hypothesis neutral = with;
  for (const FitParameter& p : parameters)
    if (!p.shape) set_parameter(neutral, p, p.nominal);

  // One size moved, at some shapes: what the linear fit would make of it tells the promise and a better size.
  struct Tried {
    Hypothesis hypothesis;
    std::size_t combination, size;
  };
  std::vector<Tried> tried;
  std::size_t n_combinations = 0;
  for (const ParameterGroup& group : groups_of(parameters)) {
    const auto shapes = combinations(with, parameters, group.shapes, screen.instants());
    const bool one_sided = std::any_of(group.shapes.begin(), group.shapes.end(), [&](std::size_t s) {
      return parameters[s].range == SearchRange::joint_position;
    });
    for (const auto& values : shapes) {
      Hypothesis shaped = neutral;
      for (std::size_t s = 0; s < values.size(); ++s) {
        const std::size_t i = group.shapes[s];
        // How far a past can be off is told by the shapes before it.
        const double unit =
            is_past(parameters[i]) ? effect_parameters(evidence, shaped, nominal, parameters[i].effect)[i].scale : 1;
        set_parameter(shaped, parameters[i], unit * values[s]);
      }
      for (const std::size_t size : group.sizes) {
        const FitParameter& p = parameters[size];
        const auto add = [&](double value) {
          tried.push_back({shaped, n_combinations, size});
          set_parameter(tried.back().hypothesis, p, std::clamp(value, p.lower, p.upper));
        };
        add(p.nominal + p.scale);
        if (one_sided && p.lower < p.nominal) add(p.nominal - p.scale);
        if (shapes.size() > 1 || p.natural_bounds || p.lower < 0) continue;
        constexpr int kSizes = 7;
        constexpr double kSizeSpan = 30, kRatioSpan = 12;
        const bool ratio = p.nominal == 1;
        const double typical = ratio ? 1 : p.nominal + p.scale, span = ratio ? kRatioSpan : kSizeSpan;
        for (int i = 0; i < kSizes; ++i) add(typical * std::pow(span, (2.0 * i + 1) / kSizes - 1));
      }
      ++n_combinations;
    }
  }
  std::vector<Hypothesis> all;
  for (const Tried& t : tried) all.push_back(t.hypothesis);
  const auto rows = evidence.fit_rows(all);

  Start start;
  start.hypothesis = with;
  std::vector<double> promise(n_combinations, 0);
  std::vector<Hypothesis> asked(n_combinations, neutral);
  std::vector<int> best_of(n_combinations, -1);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const Screen::Direction d = screen.direction(rows[i]);
    const FitParameter& p = parameters[tried[i].size];
    const double moved = parameter_value(tried[i].hypothesis, p) - p.nominal;
    const double wanted = p.nominal + d.amount * moved;
    // A size that would have to be where it cannot be takes nothing.
    if (std::clamp(wanted, p.lower, p.upper) == p.nominal || moved == 0) continue;
    const std::size_t c = tried[i].combination;
    // Shapes come with the first hypothesis of their combination; of several sizes each asks for its own.
    if (best_of[c] < 0) asked[c] = tried[i].hypothesis, promise[c] = 0;
    if (best_of[c] < 0)
      for (const FitParameter& other : parameters)
        if (!other.shape) set_parameter(asked[c], other, other.nominal);
    best_of[c] = static_cast<int>(i);
    set_parameter(asked[c], p, std::clamp(wanted, p.lower, p.upper));
    promise[c] = std::max(promise[c], d.promise);
    start.promise = std::max(start.promise, d.promise);
  }
  if (start.promise == 0) return start;

  // The most promising of what the linear fits ask for, beside everything that was tried.
  constexpr std::size_t kAsked = 8;
  std::vector<std::size_t> order(n_combinations);
  for (std::size_t c = 0; c < n_combinations; ++c) order[c] = c;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return promise[a] > promise[b]; });
  std::vector<Hypothesis> second;
  for (std::size_t i = 0; i < std::min(kAsked, order.size()); ++i)
    if (promise[order[i]] > 0) second.push_back(asked[order[i]]);
  const auto second_rows = evidence.fit_rows(second);

  const auto consider = [&](const Hypothesis& h, const std::vector<double>& row) {
    const double left = screen.left(row);
    if (left < start.left) start.left = left, start.hypothesis = h;
  };
  for (std::size_t i = 0; i < all.size(); ++i) consider(all[i], rows[i]);
  for (std::size_t i = 0; i < second.size(); ++i) consider(second[i], second_rows[i]);
  return start;
}

}  // namespace halyard
