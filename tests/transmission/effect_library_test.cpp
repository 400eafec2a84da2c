#include "transmission/effects/library.h"

#include <gtest/gtest.h>

#include "model/arm_model.h"
#include "tests/support/effect_runs.h"
#include "transmission/effects/typical_size.h"

namespace halyard {
namespace {

/// As many parameters and states as an effect may have. The states stay as they are.
class FullEffect : public EffectOf<FullEffect> {
 public:
  std::string name() const override { return "full_effect"; }
  std::string summary() const override { return "as much as there is room for"; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return std::vector<EffectParameter>(kMaxEffectParameters, EffectParameter{"p", "1", 0, 1, 0, 2});
  }
  int n_states() const override { return kMaxEffectStates; }
  template <class T>
  void state_rate(const EffectContext<T>&, const JointSignals<T>*, T* z_dot) const {
    for (int i = 0; i < kMaxEffectStates; ++i) z_dot[i] = T(0.0);
  }
};

TEST(EffectLibrary, AnEffectIsCalledByItsNameAndTheNumberOfItsJoint) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  EXPECT_EQ(effect_label(placed("backlash", arm, 1, {})), "backlash of joint 2");
  EXPECT_EQ(effect_label(placed("payload", arm, kWholeArm, {})), "payload");
}

TEST(EffectLibrary, EffectsAreTheSameIfTheyAreOfOneKindAtOneJoint) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const PlacedEffect effect = placed("backlash", arm, 0, {});
  EXPECT_TRUE(same_name(effect, placed("backlash", arm, 0, {7})));
  EXPECT_FALSE(same_name(effect, placed("backlash", arm, 1, {})));
  EXPECT_FALSE(same_name(effect, placed("slack", arm, 0, {})));
}

TEST(EffectLibrary, NumbersBeyondTheirBoundsGoThereAndOthersStay) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const std::vector<EffectParameter> bounds = find_effect("stiffness")->parameters(arm, 0);
  PlacedEffect e = placed("stiffness", arm, 0, {0.5 * bounds[0].lower, 1.5, 2 * bounds[2].upper, 9});
  keep_within_bounds(e, arm);
  EXPECT_EQ(e.p[0], bounds[0].lower);
  EXPECT_EQ(e.p[1], 1.5);
  EXPECT_EQ(e.p[2], bounds[2].upper);
  EXPECT_EQ(e.p[3], 9) << "it has three parameters";
}

TEST(EffectLibrary, TypicalSizesOfStatesAreThoseAtWhichTheyYieldOrOne) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const auto scale_of = [&](const char* name) {
    const PlacedEffect e = placed(name, arm, 0, {0.25, 0.125});
    return e.effect->state_scale(arm, e.joint, e.p);
  };
  for (const char* name : {"hysteresis", "motor_presliding", "joint_presliding"})
    EXPECT_EQ(scale_of(name), std::vector<double>(1, 0.125)) << name;
  EXPECT_EQ(scale_of("creep"), std::vector<double>(1, typical_stretch(arm.joint[0])));
  EXPECT_EQ(FullEffect().state_scale(arm, 0, nullptr), std::vector<double>(kMaxEffectStates, 1.0)) << "it says nothing";
}

TEST(EffectLibrary, EffectsThatOnlyChangeParametersActAtNoStage) {
  for (const char* name : {"payload", "gravity_tilt", "coupling", "capstan_ratio", "encoder_offset", "torque_scale"})
    EXPECT_EQ(find_effect(name)->stages(), 0u) << name;
}

TEST(UsersEffect, WithAsManyStatesAndParametersAsThereIsRoomForIsTaken) {
  register_effect(std::make_unique<FullEffect>());
  const Effect* effect = find_effect("full_effect");
  ASSERT_NE(effect, nullptr);
  const PlacedEffect e = place_effect(*effect, random_arm(16, CableLaw::linear), 0);
  for (const double p : e.p) EXPECT_EQ(p, 1);
}

}  // namespace
}  // namespace halyard
