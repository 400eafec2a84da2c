// An effect that halyard does not have: a spot in a joint's travel where it goes tight (a dented bearing, a kink in the
// cable's sheath). What it shows: an effect is one class with one equation, and one function that exports it.
//
//   F' = F + F_t exp(-((q - q_t) / w)²) tanh(v / v_s)
//
//   F_t   friction that the spot adds, `rise`       N m | N
//   q_t   where it is, `position`                   rad | m
//   w     half of its width, `width`                rad | m
//   v_s   the joint's own smoothing speed           rad/s | m/s
//
// Look for sizes and shapes: `rise` sizes the effect and is nothing at 0; position and width shape it, have no neutral
// value of their own. How a diagnosis looks for them is no physics and stands apart, in refine_search().
#include "plugins/effect_plugin.hpp"
#include "transmission/effects/typical_size.h"
#include "transmission/friction.h"

namespace {

using namespace halyard;

class TightSpot : public EffectOf<TightSpot>, public RefinesSearch {
 public:
  std::string name() const override { return "tight_spot"; }
  std::string summary() const override { return "friction that rises around one position of the joint"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const bool turns = j.type == JointType::revolute;
    const double level = typical_joint_friction(j), width = typical_width(j), far = turns ? 10 : 2;
    // Name, unit, neutral, typical, lower, upper.
    return {{"rise", turns ? "N m" : "N", 0, level, 0, 30 * level},
            {"position", turns ? "rad" : "m", 0, 0, -far, far},
            {"width", turns ? "rad" : "m", width, width, 0.1 * width, 10 * width}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double width = typical_width(arm.joint[*joint]);
    space["position"].range = SearchRange::joint_position;
    space["width"].starts = {0.5 * width, 2 * width};
  }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    JointSignals<T>& own = s[*c.joint];
    const T u = (own.joint_position - c.p[1]) / c.p[2];
    own.joint_force -= c.p[0] * exp(T(-u * u)) * smooth_sign(own.joint_rate, c.arm.joint[*c.joint].joint_smoothing);
  }

 private:
  static double typical_width(const JointParameters<double>& j) { return j.type == JointType::revolute ? 0.1 : 0.01; }
};

}  // namespace

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = effect_table<TightSpot>();
  return &table;
}
