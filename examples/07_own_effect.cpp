/// 7. An effect of your own: a cable harness that pulls a joint towards where it lies relaxed.
///
///   F' = F - k (q - q_0)
///
///   k     stiffness of the harness                N m/rad | N/m
///   q_0   where it is relaxed                     rad | m
///
/// It is written once. Registered, it is truth in the plant, part of the filter's process model, a name in model files,
/// and a candidate of the diagnosis.
///
/// Look for: the arm has the spring at joint 2. A filter whose model lacks it believes the wrong cable force and is
/// off; one whose model has it is back at the level of example 6.

#include "arm_example.h"
#include "estimators/built_in.h"
#include "transmission/effects/one_signal.h"

namespace {

using namespace halyard;

class HarnessSpring : public EffectOf<HarnessSpring>, public OneSignalEffect {
 public:
  std::string name() const override { return "harness_spring"; }
  std::string summary() const override { return "a cable harness that pulls the joint to where it lies relaxed"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  Signal signal_at(EffectStage) const override { return Signal::joint_position; }  // filters are faster if they know
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const bool turns = arm.joint[*joint].type == JointType::revolute;
    // Name, unit, neutral, typical, lower, upper.
    return {{"stiffness", turns ? "N m/rad" : "N/m", 0, 1, 0, 1000},
            {"relaxed_at", turns ? "rad" : "m", 0, 0, -10, 10}};
  }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * (s[*c.joint].joint_position - c.p[1]);
  }
};

}  // namespace

int main() {
  register_effect(std::make_unique<HarnessSpring>());

  const ArmModel without = raven2();
  ArmModel with = without;
  PlacedEffect spring = place_effect(*find_effect("harness_spring"), with.nominal, 1);
  spring.p[0] = 2;    // N m/rad
  spring.p[1] = 1.0;  // rad
  with.effects.push_back(spring);

  const SimulationResult run = simulate(on_sines(with, 3));
  const auto naive = make_kinematics(with, {}), lacks = make_sr_ukf(without, {}), has = make_sr_ukf(with, {});
  const Eigen::VectorXd e_naive = rms_error(*naive, run), e_lacks = rms_error(*lacks, run);
  const Eigen::VectorXd e_has = rms_error(*has, run);
  for (int k = 0; k < 3; ++k)
    fmt::print("joint {} RMS error: kinematics {}, filter without the spring {}, with it {}\n", k + 1,
               in_units(with, k, e_naive(k)), in_units(with, k, e_lacks(k)), in_units(with, k, e_has(k)));
  fmt::print("knowing the spring helps at joint 2: {}\n", e_has(1) < 0.5 * e_lacks(1) ? "yes" : "no");
}
