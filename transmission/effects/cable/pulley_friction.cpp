#include "transmission/coupling.h"
#include "transmission/effects/built_in.h"
#include "transmission/friction.h"

/// Friction of the cable on its pulleys. It grows with tension and load, but not with speed:
///
///   F(v, v_s) = μ (2 T_0 + |g|) tanh(v / v_s)
///   g_motor = g + σ F(q_m', v_m),   g_joint = g - (1 - σ) F(q_c', v_l)
///
///   μ      friction coefficient, wrap angle included       -
///   σ      share of the friction on the motor's side        -
///   g      force difference of the two runs                 N
///   q_m'   rate of the motor, v_m its smoothing speed       rad/s
///   q_c'   rate of the joint's path, coupling included, v_l the joint's smoothing speed       rad/s | m/s
///
/// Source: Miyasaka et al., "Measurement of the cable-pulley Coulomb and viscous friction for a
/// cable-driven surgical robotic system", IROS 2015.

namespace halyard::effects {

class PulleyFriction : public EffectOf<PulleyFriction> {
 public:
  std::string name() const override { return "pulley_friction"; }
  std::string summary() const override { return "cable friction on the pulleys that grows with tension and load"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  /// With the force that the others leave.
  int rank(EffectStage) const override { return 2; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"coefficient", "1", 0, 0.05, 0, 1}, {"motor_share", "1", 0.5, 0.5, 0, 1}};
  }

  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    JointSignals<T>& own = s[*c.joint];
    T v[kMaxJoints];
    for (int i = 0; i < c.arm.n; ++i) v[i] = s[i].joint_rate;
    const T path_rate = coupled_motion(j, c.arm.n, v);
    const T level = c.p[0] * (T(2.0) * j.tension + abs(own.cable_force_joint));
    own.cable_force_motor += c.p[1] * level * smooth_sign(own.motor_rate, j.motor_smoothing);
    own.cable_force_joint -= (T(1.0) - c.p[1]) * level * smooth_sign(path_rate, j.joint_smoothing);
  }
};

HALYARD_EFFECT(PulleyFriction)

}  // namespace halyard::effects
