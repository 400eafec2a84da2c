#include "transmission/effects/built_in.h"
#include "transmission/effects/smooth_step.h"
#include "transmission/effects/typical_size.h"

/// A force on a joint that no sensor measures: a push during part of the time, and a contact,
///
///   F' = F + F_e (s(t - t_1) - s(t - t_2)) - k max(0, ±(q - q_c)),   + where k > 0, - where k < 0
///
///   F_e        `force`, positive if it pushes the joint forward                      N m | N
///   t_1, t_2   `start`, `stop` on the log's clock, where the force is F_e / 2              s
///   s          smooth step of the width 10 ms + r |t_2 - t_1|, see smooth_step.h
///   r          `rise`: share of its duration in which the force rises, and in which it falls. 0: at once; 1: it
///              falls as soon as it has reached F_e, as a push by hand does                -
///   k          `contact_stiffness`. Positive: a wall above q_c that pushes back down;
///              negative: a wall below q_c, of stiffness |k|, that pushes up              N m/rad | N/m
///   q_c        `contact_position`                                                        rad | m

namespace halyard::effects {

class ExternalForce : public EffectOf<ExternalForce> {
 public:
  std::string name() const override { return "external_force"; }
  std::string summary() const override { return "a force on a joint for part of the time, or a contact"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const JointParameters<double>& j = arm.joint[*joint];
    const bool turns = j.type == JointType::revolute;
    const double level = typical_joint_friction(j), reach = turns ? 0.1 : 0.01;
    // A wall as stiff as the cable cannot be distinguished from a stiffer one.
    const double own = j.drive == Drive::cable ? 2 * j.stiffness * j.pulley_radius * j.pulley_radius : 0;
    const double stiffest = std::max(own, 100 * level / reach), far = turns ? 10 : 2;
    return {{"force", turns ? "N m" : "N", 0, level, -100 * level, 100 * level},
            {"start", "s", 1, 1, -1e10, 1e10},
            {"stop", "s", 2, 2, -1e10, 1e10},
            {"rise", "1", 0, 0, 0, 1},
            {"contact_stiffness", turns ? "N m/rad" : "N/m", 0, 5 * level / reach, -stiffest, stiffest},
            {"contact_position", turns ? "rad" : "m", 0, 0, -far, far}};
  }

  std::string fault_of(const double* p) const override {
    return p[2] < p[1] ? "stop is before start; exchange them" : "";
  }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T *p = c.p, beyond = s[*c.joint].joint_position - p[5];
    const T depth = max(T(0.0), select(p[4] >= T(0.0), beyond, T(-beyond)));
    const T width = T(kStepWidth) + p[3] * abs(T(p[2] - p[1]));
    const T push = smooth_step(c.time, p[1], width).value - smooth_step(c.time, p[2], width).value;
    s[*c.joint].joint_force += p[0] * push - p[4] * depth;
  }
};

HALYARD_EFFECT(ExternalForce)

}  // namespace halyard::effects
