#include "diagnosis/search/unlisted_causes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/round/refit.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

class SteepFriction : public EffectOf<SteepFriction> {
 public:
  std::string name() const override { return "unlisted_friction"; }
  std::string summary() const override { return "friction that grows faster than the speed"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    constexpr double kMost = 300;
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double speed = turns ? 1 : 0.1, force = typical_joint_friction(arm.joint[*joint]);
    const double square = force / (speed * speed), cube = square / speed;
    return {{"square", turns ? "N m s^2/rad^2" : "N s^2/m^2", 0, square, 0, kMost * square},
            {"cube", turns ? "N m s^3/rad^3" : "N s^3/m^3", 0, cube, 0, kMost * cube}};
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T v = s[*c.joint].joint_rate;
    s[*c.joint].joint_force -= (c.p[0] * abs(v) + c.p[1] * v * v) * v;
  }
};

/// A half-range cosine series over all records. Its origin is an instant, so that it goes on from log to log where each
/// has a clock of its own.
class WanderingZero : public EffectOf<WanderingZero>, public RefinesSearch {
 public:
  explicit WanderingZero(Span records) : records_(records) {}
  std::string name() const override { return "unlisted_wander"; }
  std::string summary() const override { return "a joint's sensor whose zero wanders"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    const double typical = turns ? 1e-3 : 1e-4, most = turns ? 0.5 : 0.05;
    std::vector<EffectParameter> all;
    for (int i = 0; i < kCosines; ++i)
      all.push_back({"cosine_" + std::to_string(i), turns ? "rad" : "m", 0, typical, -most, most});
    all.push_back({"origin", "s", records_.first, records_.first, -kFar, kFar});
    return all;
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["origin"].range = SearchRange::record_time;
    space["origin"].is_whole = true;  // not fitted
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T phase = T(std::numbers::pi / (records_.last - records_.first)) * (T(c.time) - c.p[kCosines]);
    // cos((i + 1) φ) = 2 cos φ cos(i φ) - cos((i - 1) φ)
    T before = cos(phase), now(1.0);
    const T twice = T(2) * before;
    for (int i = 0; i < kCosines; ++i) {
      s[*c.joint].joint_error += c.p[i] * now;
      before = std::exchange(now, T(twice * now - before));
    }
  }

 private:
  static constexpr int kCosines = kMaxEffectParameters - 1;
  static constexpr double kFar = 1e10;  ///< s
  Span records_;
};

/// Added effects that one cause may replace.
struct Question {
  std::vector<std::size_t> names;
  const Effect& cause;
};

std::vector<Question> questions(const std::vector<PlacedEffect>& effects, std::size_t given, const Effect& friction,
                                const Effect& wander) {
  std::vector<Question> all;
  for (std::size_t e = given; e < effects.size(); ++e) {
    const std::string name = effects[e].effect->name();
    if (name == "joint_friction" || name == "motor_friction") all.push_back({{e}, friction});
    if (name != "cable_slip") continue;
    const auto before = std::ranges::find_if(
        all, [&](const Question& q) { return &q.cause == &wander && effects[q.names[0]].joint == effects[e].joint; });
    if (before == all.end()) all.push_back({{e}, wander});
    else before->names.push_back(e);
  }
  return all;
}

}  // namespace

void weigh_unlisted_causes(const Evidence& evidence, const ArmModel& model, Attribution& found) {
  const std::size_t given = model.effects.size();
  const Hypothesis& all = found.final_fit.hypothesis;
  const SteepFriction friction;
  const WanderingZero wander(evidence.time_span());
  const std::vector<Question> asked = questions(all.effects, given, friction, wander);
  if (asked.empty()) return;
  const Refitter refitter(evidence, model, given);
  if (!refitter.is_usable()) return;
  // All names at first, then with the cause of each question in their place.
  std::vector<Hypothesis> rivals = {all};
  std::vector<double> prior_gain;
  for (const Question& q : asked) {
    const PlacedEffect cause = place_effect(q.cause, model.nominal, all.effects[q.names[0]].joint);
    Hypothesis others = all;
    prior_gain.push_back(-prior_cost_of(cause, model.nominal));
    for (auto e = q.names.rbegin(); e != q.names.rend(); ++e) {
      prior_gain.back() += prior_cost_of(all.effects[*e], model.nominal);
      others = without_effect(others, *e);
    }
    rivals.push_back(refitter.with_effect(others, cause));
  }
  std::vector<std::optional<Scored>> fitted(rivals.size());
  run_side_by_side(rivals.size(), [&](std::size_t i) { fitted[i] = refitter.refitted(rivals[i], found.final_score); });
  if (!fitted[0]) return;
  const Judge judge(evidence, model, baseline_parameters(model));
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (!fitted[i + 1]) continue;
    const double gain = judge.gain_over(*fitted[i + 1], *fitted[0]) + prior_gain[i];
    for (const std::size_t e : asked[i].names)
      found.namings[e - given].unlisted = {1 / (1 + std::exp(-gain)), asked[i].cause.summary()};
  }
}

}  // namespace halyard
