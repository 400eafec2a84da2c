#include "diagnosis/plan.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "diagnosis/explanation/signature.h"
#include "diagnosis/planning/planner.h"
#include "model/machine/first_failure.h"

namespace halyard {
namespace {

using Shown = Planner::Shown;

std::vector<Shown> show_all(const Planner& planner, const std::function<void()>& one_is_done) {
  std::vector<Shown> shown(planner.candidates().size());
  for_each_in_parallel(shown.size(), [&](std::size_t i) {
    shown[i] = planner.show(planner.candidates()[i]);
    one_is_done();
  });
  return shown;
}

/// All but those of this effect at this joint.
std::vector<const Shown*> others_than(const PlacedEffect& effect, const std::vector<Shown>& shown) {
  std::vector<const Shown*> others;
  for (const Shown& s : shown)
    if (!same_name(s.limit.effect, effect)) others.push_back(&s);
  return others;
}

/// The limit of one candidate with what the others tell about it.
DetectionLimit among_others(const Planner& planner, const Shown& right, const std::vector<Shown>& all, bool can_name) {
  DetectionLimit limit = right.limit;
  if (!limit.excited) return limit;
  const std::vector<const Shown*> others = others_than(limit.effect, all);
  for (const Shown* other : others)
    if (planner.confused(right.change, *other)) limit.confused_with.push_back(other->limit.effect);
  const double from =
      can_name ? planner.named_from(right.growing, right.seen_from, others) : std::numeric_limits<double>::infinity();
  if (!std::isfinite(from)) return limit;
  limit.naming_limit = limit.neutral + (limit.limit - limit.neutral) * from / right.seen_from;
  return limit;
}

}  // namespace

std::vector<DetectionLimit> detection_limits(const ArmModel& model, const std::vector<Log>& logs,
                                             const std::function<void(const std::string&, double)>& progress) {
  const Planner planner(model, logs);
  const double candidates = static_cast<double>(planner.candidates().size());
  std::atomic<std::size_t> done{0};
  const auto say = [&](const char* what) {
    if (progress) progress(what, static_cast<double>(++done) / candidates);
  };
  const std::vector<Shown> shown = show_all(planner, [&] { say("detection limits"); });
  done = 0;
  const bool can_name = !names_nothing(model, logs);
  std::vector<DetectionLimit> limits(shown.size());
  for_each_in_parallel(shown.size(), [&](std::size_t i) {
    limits[i] = among_others(planner, shown[i], shown, can_name);
    say("effects that look alike");
  });
  return limits;
}

std::vector<double> detected_from(const ArmModel& model, const std::vector<Log>& logs,
                                  const std::vector<PlacedEffect>& effects) {
  const Planner planner(model, logs);
  std::vector<double> shares;
  for (const PlacedEffect& effect : effects) shares.push_back(planner.detected_from(planner.scaled(effect)));
  return shares;
}

double named_from(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& effect) {
  const Planner planner(model, logs);
  const Planner::Growing growing = planner.scaled(effect);
  const double detected = planner.detected_from(growing);
  if (!std::isfinite(detected) || !planner.is_searched(effect) || names_nothing(model, logs))
    return std::numeric_limits<double>::infinity();
  const std::vector<Shown> shown = show_all(planner, [] {});
  return planner.named_from(growing, detected, others_than(effect, shown));
}

bool names_nothing(const ArmModel& model, const std::vector<Log>& logs) {
  const std::vector<Record> records = planned_records(model, logs);
  for (int k = 0; k < model.n(); ++k)
    if (!is_one_sinusoid(records, model.nominal, k)) return false;
  return true;
}

Separation separation(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& first,
                      const PlacedEffect& second) {
  const Planner planner(model, logs);
  const Shown a = planner.show(first), b = planner.show(second);
  Separation s{a.limit, b.limit, std::max(planner.cosine(a, b), planner.cosine(b, a)), false};
  if (a.limit.excited && planner.confused(a.change, b)) s.first.confused_with = {second};
  if (b.limit.excited && planner.confused(b.change, a)) s.second.confused_with = {first};
  s.told_apart = a.limit.excited && b.limit.excited && s.first.confused_with.empty() &&
                 s.second.confused_with.empty() && !names_nothing(model, logs);
  return s;
}

}  // namespace halyard
