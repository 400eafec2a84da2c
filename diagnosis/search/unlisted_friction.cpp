#include "diagnosis/search/unlisted_friction.h"

#include <cmath>
#include <optional>

#include "diagnosis/round/refit.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

class UnlistedFriction : public EffectOf<UnlistedFriction> {
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

bool is_friction(const PlacedEffect& effect) {
  const std::string name = effect.effect->name();
  return name == "joint_friction" || name == "motor_friction";
}

}  // namespace

void weigh_unlisted_friction(const Evidence& evidence, const ArmModel& model, Attribution& found) {
  const std::size_t given = model.effects.size();
  const Hypothesis& all = found.final_fit.hypothesis;
  static const UnlistedFriction unlisted;  // the evidence remembers predictions by their effects
  std::optional<Refitter> refitter;
  std::optional<Scored> named;
  for (std::size_t e = given; e < all.effects.size(); ++e) {
    const PlacedEffect& effect = all.effects[e];
    if (!is_friction(effect)) continue;
    if (!refitter) {
      refitter.emplace(evidence, model, given);
      if (!refitter->is_usable()) return;
      named = refitter->refitted(all, found.final_score);
    }
    if (!named) return;
    const PlacedEffect rival = place_effect(unlisted, model.nominal, effect.joint);
    const Hypothesis replaced = refitter->with_effect(without_effect(all, e), rival);
    const auto other = refitter->refitted(replaced, found.final_score);
    if (!other) continue;
    const Judge judge(evidence, model, refitter->numbers());
    const double gain =
        judge.gain_over(*other, *named) + prior_cost_of(effect, model.nominal) - prior_cost_of(rival, model.nominal);
    found.namings[e - given].unlisted = 1 / (1 + std::exp(-gain));
  }
}

}  // namespace halyard
