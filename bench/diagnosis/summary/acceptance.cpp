#include "bench/diagnosis/summary/acceptance.h"

#include <cmath>

#include "bench/diagnosis/summary/calibration.h"
#include "bench/diagnosis/summary/probabilities.h"
#include "model/statistics/quantile.h"

namespace halyard::blind {
namespace {

/// A line of the table; what is empty is not counted in this line.
struct Line {
  std::string row, what, bar;
  std::optional<Proportion> strict, loose;
  std::optional<int> too_small;  ///< trials or effects that this line leaves out
  std::vector<double> seconds;
};

std::string cells(const std::optional<Proportion>& p) {
  if (!p || p->of == 0) return " | | |";
  return fmt::format(" {}/{} | {:.1f} % | {:.1f} to {:.1f} % |", p->hits, p->of, 100 * p->value(), 100 * p->lower(),
                     100 * p->upper());
}

std::string text_of(const Line& l) {
  const std::string small = l.too_small ? std::to_string(*l.too_small) : "";
  const std::string times =
      l.seconds.empty() ? " | |" : fmt::format(" {:.1f} | {:.1f} |", median(l.seconds), quantile(l.seconds, 0.9));
  return fmt::format("| {} | {} | {} |{}{} {} |{}\n", l.row, l.what, l.bar, cells(l.strict), cells(l.loose), small,
                     times);
}

Results of(const Results& ran, Kind kind, int off) {
  return those(ran, [&](const Result& r) { return r.situation.kind == kind && r.situation.off == off; });
}
Results of(const Results& ran, Kind kind, Sensors sensors, int off) {
  return those(of(ran, kind, off), [&](const Result& r) { return r.situation.sensors == sensors; });
}
bool is_visible_alone(const Result& r) { return !is_too_small(r); }
bool is_promised_a_name(const Result& r) { return r.truth[0].is_nameable(); }
Results visible(const Results& all) { return those(all, is_visible_alone); }

std::string sensor_text(Sensors sensors) {
  return sensors == Sensors::motors ? "motors only" : word(sensors) + " sensors";
}

/// Trials of one effect: those for which the plan keeps its promise or not, and in lines of their own those to which it
/// promises less.
void add_effect_lines(std::vector<Line>& lines, const Line& head, const Results& all, const Test& is_promised) {
  if (all.empty()) return;
  const Results seen = visible(all), small = those(all, is_too_small), promised = those(seen, is_promised);
  Line line = head;
  line.strict = share(promised, strictly_right);
  line.loose = share(promised, loosely_right);
  line.too_small = static_cast<int>(all.size() - promised.size());
  line.seconds = run_times(all);
  lines.push_back(line);
  if (const Results alike = those(seen, [&](const Result& r) { return !is_promised(r); }); !alike.empty())
    lines.push_back({.row = head.row,
                     .what = head.what + ", seen, but another effect fits as well",
                     .bar = "",
                     .strict = share(alike, strictly_right),
                     .loose = share(alike, loosely_right),
                     .too_small = std::nullopt,
                     .seconds = {}});
  if (small.empty()) return;
  lines.push_back({.row = head.row,
                   .what = head.what + ", too small to see: clean or right; no false name",
                   .bar = "",
                   .strict = share(small, [](const Result& r) { return r.verdict == "clean" || strictly_right(r); }),
                   .loose = share(small, [](const Result& r) { return r.failure.empty() && false_names(r) == 0; }),
                   .too_small = std::nullopt,
                   .seconds = {}});
}

/// Trials of several effects, effect by effect and name by name.
void add_several_lines(std::vector<Line>& lines, const Line& head, const std::string& bar_of_false_names,
                       const Results& all) {
  if (all.empty()) return;
  Proportion named, named_or_alternative, small_named, false_share;
  for (const Result* r : all) {
    for (const TrueEffect& t : r->truth) {
      (t.is_visible() ? named : small_named).count(is_named(*r, t));
      if (t.is_visible()) named_or_alternative.count(is_named_or_alternative(*r, t));
    }
    for (const NameScore s : score_names(*r)) false_share.count(s == NameScore::false_name);
  }
  Line line = head;
  line.what += ": effects named; or an alternative";
  line.strict = named;
  line.loose = named_or_alternative;
  line.too_small = small_named.of;
  line.seconds = run_times(all);
  lines.push_back(line);
  lines.push_back({head.row, head.what + ": names that are false", bar_of_false_names, false_share, {}, {}, {}});
  const Results seen = visible(all);
  lines.push_back({head.row,
                   head.what + ": whole trial right; all effects named",
                   "",
                   share(seen, strictly_right),
                   share(seen, loosely_right),
                   static_cast<int>(all.size() - seen.size()),
                   {}});
  if (small_named.of > 0)
    lines.push_back({head.row, head.what + ", effects too small to see: named", "", small_named, {}, {}, {}});
}

void add_clean_lines(std::vector<Line>& lines, const Results& ran) {
  const Results clean = of(ran, Kind::clean, 1);
  if (clean.empty()) return;
  lines.push_back({"1",
                   "clean arms: verdict `clean`; no false name",
                   "95 %",
                   share(clean, strictly_right),
                   share(clean, loosely_right),
                   {},
                   run_times(clean)});
  lines.push_back({"1",
                   "clean arms: an effect is named; other than `delay` of late sensors",
                   "at most 1 %",
                   share(clean, [](const Result& r) { return !r.named.empty(); }),
                   share(clean, [](const Result& r) { return false_names(r) > 0; }),
                   {},
                   {}});
}

void add_effects_and_several(std::vector<Line>& lines, const Results& ran, int off) {
  const bool twice = off == 2;
  constexpr std::pair<Sensors, int> kBars[] = {{Sensors::good, 90}, {Sensors::poor, 85}, {Sensors::motors, 80}};
  const int less = twice ? 10 : 0;
  const std::string words = twice ? ", off by twice the tolerance" : "";
  for (const auto& [sensors, bar] : kBars)
    add_effect_lines(lines,
                     {twice ? "6" : "2",
                      "one effect, " + sensor_text(sensors) + words,
                      fmt::format("{} %", bar - less),
                      {},
                      {},
                      {},
                      {}},
                     of(ran, Kind::effect, sensors, off), is_promised_a_name);
  for (const Kind kind : {Kind::two_at_joint, Kind::three})
    add_several_lines(lines,
                      {twice ? "6" : "3",
                       (kind == Kind::three ? "three effects" : "two at one joint") + words,
                       fmt::format("{} %", 80 - less),
                       {},
                       {},
                       {},
                       {}},
                      fmt::format("at most {} %", 5 + less), of(ran, kind, off));
}

/// The row of probabilities and intervals.
void add_calibration_lines(std::vector<Line>& lines, const Results& ran) {
  for (const ClaimKind kind : kClaimKinds)
    if (const auto group = farthest_group(claims_of(ran, kind)))
      lines.push_back({"5",
                       fmt::format("probabilities of {}: largest distance from the observed frequency: {:.1f} points, "
                                   "between {:.1f} and {:.1f}, which claim {:.1f} % on average",
                                   words(kind), 100 * group->distance(), group->from, group->to, 100 * group->mean()),
                       "5 points",
                       group->came_true,
                       {},
                       {},
                       {}});
  const RightNames names = right_names(ran);
  if (names.above_90.of + names.others.of > 0)
    lines.push_back({"5",
                     "names with a probability above 0.9 that are right; the other names",
                     "",
                     names.above_90,
                     names.others,
                     {},
                     {}});
  const Proportion sets = set_coverage(ran);
  if (sets.of > 0)
    lines.push_back({"5",
                     fmt::format("sets of at least 90 % that contain the truth; they claim {:.1f} % on average",
                                 100 * probability_of_sets(ran)),
                     "87 to 93 %",
                     sets,
                     {},
                     {},
                     {}});
  const ParameterCounts parameters = parameter_counts(ran);
  if (parameters.intervals().of > 0)
    lines.push_back({"5",
                     "intervals of 95 % that contain the truth; those of parameters that were not reset to neutral",
                     "92 to 98 %",
                     parameters.intervals(),
                     parameters.kept,
                     {},
                     {}});
  if (parameters.off_neutral.of > 0)
    lines.push_back(
        {"5", "parameters that were left out, but are not neutral", "", parameters.off_neutral, {}, {}, {}});
  if (parameters.whole.of > 0) lines.push_back({"5", "whole numbers that are right", "", parameters.whole, {}, {}, {}});
}

/// How much of the hold-out's true motion lies in the intervals of the prediction. It has no bar: the samples of a
/// trial are not independent, and the intervals count the noise of sensors that this hold-out does not have.
void add_prediction_line(std::vector<Line>& lines, const Results& ran) {
  const std::vector<double> inside = interval_coverages(ran);
  if (inside.empty()) return;
  lines.push_back({"5",
                   fmt::format("prediction intervals of 95 %: share of the samples within, mean over joints: median "
                               "{:.3f}, 10 % below {:.3f}; {} trials",
                               median(inside), quantile(inside, 0.1), inside.size()),
                   "",
                   {},
                   {},
                   {},
                   {}});
}

std::string median_and_90(const std::vector<double>& x) {
  return fmt::format("median {:.3f}, 90 % below {:.3f}", median(x), quantile(x, 0.9));
}

/// What a revised model's error is compared with.
struct Reference {
  std::vector<double> HoldOutErrors::*errors;
  std::string whose;
  /// Only of arms with effects: on a clean one, a fit that knows the effects fits what a diagnosis without names does.
  bool of_effects;
};

/// Over the error of another model: only of trials whose truth a revised model can express.
/// errors: which hold-out, told in `against`.
void add_ratio_lines(std::vector<Line>& lines, const Results& diagnosed, Sensors sensors, HoldOutErrors Result::*errors,
                     const std::string& against, const Reference& other) {
  std::vector<double> worst, mean;
  for (const Result* r : diagnosed) {
    if (r->situation.sensors != sensors || r->situation.kind == Kind::form || r->situation.kind == Kind::outside)
      continue;
    if (other.of_effects && r->truth.empty()) continue;
    const HoldOutErrors& e = r->*errors;
    if ((e.*other.errors).empty()) continue;
    const ErrorRatio ratio = error_ratio(e.after, e.*other.errors);
    if (!std::isfinite(ratio.mean)) continue;
    worst.push_back(ratio.worst);
    mean.push_back(ratio.mean);
  }
  if (worst.empty()) return;
  const std::string what = "hold-out error" + against + " over " + other.whose + ", " + sensor_text(sensors) +
                           (other.of_effects ? ", arms with effects" : "");
  lines.push_back({"7", what + ", mean of the joints: " + median_and_90(mean), "median 1.2", {}, {}, {}, {}});
  lines.push_back({"7", what + ", worst joint: " + median_and_90(worst), "", {}, {}, {}, {}});
}

void add_holdout_lines(std::vector<Line>& lines, const Results& ran) {
  const Results diagnosed = those(ran, [](const Result& r) { return r.failure.empty() && !r.holdout.after.empty(); });
  if (diagnosed.empty()) return;
  const Reference truth{&HoldOutErrors::true_model, "the true model's", false};
  const Reference informed{&HoldOutErrors::informed, "that of a fit which knows the effects", true};
  for (const Sensors sensors : {Sensors::good, Sensors::poor, Sensors::motors})
    add_ratio_lines(lines, diagnosed, sensors, &Result::holdout, "", truth);
  for (const Sensors sensors : {Sensors::good, Sensors::poor})
    add_ratio_lines(lines, diagnosed, sensors, &Result::sensed_holdout, ", as these sensors read it,", truth);
  for (const Sensors sensors : {Sensors::good, Sensors::poor, Sensors::motors})
    add_ratio_lines(lines, diagnosed, sensors, &Result::holdout, "", informed);
  std::vector<double> over_given;
  for (const Result* r : diagnosed) over_given.push_back(error_ratio(r->holdout.after, r->holdout.before).worst);
  lines.push_back(
      {"7", "hold-out error over the given model's, worst joint: " + median_and_90(over_given), "", {}, {}, {}, {}});
  lines.push_back({"7",
                   "trials in which a joint's error rises above the given model's by more than its noise",
                   "0",
                   share(diagnosed, rises_above_given),
                   {},
                   {},
                   {}});
}

}  // namespace

std::string acceptance_table(const Results& ran) {
  std::vector<Line> lines;
  add_clean_lines(lines, ran);
  add_effects_and_several(lines, ran, 1);
  add_effect_lines(lines, {"4", "other equations", "85 %", {}, {}, {}, {}}, of(ran, Kind::form, 1), is_visible_alone);
  add_effect_lines(lines, {"4", "outside the library: `unknown`; or an unexplained residual", "85 %", {}, {}, {}, {}},
                   of(ran, Kind::outside, 1), is_visible_alone);
  add_calibration_lines(lines, ran);
  add_prediction_line(lines, ran);
  add_effects_and_several(lines, ran, 2);
  add_holdout_lines(lines, ran);
  std::string text =
      "| row | what | bar | strictly | share | 95 % interval | loosely | share | 95 % interval | not counted: too "
      "small "
      "or alike "
      "| s, median | s, 90 % |\n|---|---|---|---:|---:|---|---:|---:|---|---:|---:|---:|\n";
  for (const Line& l : lines) text += text_of(l);
  return text + "\n";
}

}  // namespace halyard::blind
