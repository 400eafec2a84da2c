/// Hypotheses that move alike are integrated once. Which fields of an arm leave the motion alone is said in the list of
/// fields; here each is changed beside an unchanged arm, which must make no difference to its prediction.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "diagnosis/prediction/prediction.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

/// Changes every entry; false if there is none that is a number.
template <class Value>
bool changed(Value& value) {
  bool any = false;
  const auto change = [&](auto& entry) {
    if constexpr (std::is_same_v<decltype(entry), double&>) {
      entry = entry * 1.01 + 1e-4;
      any = true;
    }
  };
  for_each_entry(change, value);
  return any;
}

/// Largest difference of two predictions, over the largest residual of its channel.
double difference(const Residuals& a, const Residuals& b) {
  double most = 0;
  for (std::size_t c = 0; c < a.channel.size(); ++c) {
    double size = 0, apart = 0;
    for (std::size_t i = 0; i < a.channel[c].size(); ++i) {
      if (std::isnan(a.channel[c][i])) continue;
      size = std::max(size, std::abs(a.channel[c][i]));
      apart = std::max(apart, std::abs(a.channel[c][i] - b.channel[c][i]));
    }
    if (size > 0) most = std::max(most, apart / size);
  }
  return most;
}

TEST(MotionKey, LeavesOutOnlyWhatDoesNotMoveTheArm) {
  for (const Drive drive : {Drive::cable, Drive::rigid, Drive::none}) {
    ArmModel model = first_joints(2);
    const Log log = simulate(motion(model, 2)).measured;
    model.nominal.joint[1].drive = drive;
    const Record record = make_records(log, model, {})[0];
    Hypothesis base{model.nominal, {}};
    std::set<std::string> seen;
    const auto compare = [&](const ArmField& field, auto& value) {
      if (field.influence == Influence::motion) return;
      const Hypothesis before = base;
      if (!changed(value)) return;
      const Hypothesis other = base;
      base = before;
      const auto together = predict(record, {base, other}, 10);
      const Residuals alone = predict(record, {other}, 10)[0];
      const std::string name = std::string(field.part).append(".").append(field.name);
      ASSERT_TRUE(alone.finite && together[1].finite) << name;
      // Replaying a motion instead of integrating it leaves the last digits; a motion that is not the arm's own is off
      // by the change of 1 %.
      EXPECT_LT(difference(alone, together[1]), 1e-9) << name;
      if (difference(together[1], together[0]) > 1e-6) seen.insert(name);
    };
    for_each_joint_field(compare, base.nominal.joint[1]);
    // The changes are such that they show.
    EXPECT_EQ(seen.contains("motor.coulomb"), drive != Drive::none);
    EXPECT_TRUE(seen.contains("encoders.joint_offset"));
  }
}

/// A brake at the joint that grips with a lag behind the torque of the motor.
class Brake : public EffectOf<Brake> {
 public:
  std::string name() const override { return "brake"; }
  std::string summary() const override { return "a brake that follows the torque of the motor"; }
  unsigned stages() const override {
    return static_cast<unsigned>(EffectStage::motor) | static_cast<unsigned>(EffectStage::joint);
  }
  int n_states() const override { return 1; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"gain", "1", 0, 1, 0, 100}};
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force -= c.p[0] * c.z[0];
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = T(20.0) * (s[*c.joint].motor_torque - c.z[0]);
  }
};

TEST(MotionKey, HasTheTorquesThatAStateCarriesToTheJoint) {
  const Brake brake;
  const ArmModel model = first_joints(1);
  const Record record = make_records(simulate(motion(model, 2)).measured, model, {})[0];
  Hypothesis base{model.nominal, {place_effect(brake, model.nominal, 0)}};
  base.effects[0].p[0] = 20;
  Hypothesis other = base;
  other.nominal.joint[0].motor_coulomb *= 1.2;
  const auto together = predict(record, {base, other}, 10);
  const Residuals alone = predict(record, {other}, 10)[0];
  ASSERT_TRUE(alone.finite && together[1].finite);
  EXPECT_LT(difference(alone, together[1]), 1e-9);
  EXPECT_GT(difference(together[1], together[0]), 1e-6);
}

}  // namespace
}  // namespace halyard
