/// What effects of one signal promise.

#include "transmission/effects/one_signal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/effect_runs.h"

namespace halyard {
namespace {

constexpr EffectStage kForces[] = {EffectStage::motor, EffectStage::joint};
constexpr double JointSignals<double>::*kSignals[] = {
    &JointSignals<double>::command,           &JointSignals<double>::motor_angle,
    &JointSignals<double>::motor_rate,        &JointSignals<double>::joint_position,
    &JointSignals<double>::joint_rate,        &JointSignals<double>::external_force,
    &JointSignals<double>::stretch,           &JointSignals<double>::stretch_rate,
    &JointSignals<double>::joint_acceleration};

/// An arm with one effect, which is away from its neutral parameters.
struct Placed {
  Transmission<double> transmission;
  const EffectInstance<double>& e() const { return transmission.effects()[0]; }

  template <class T>
  void act(const EffectInstance<T>& effect, const ArmParameters<T>& arm, EffectStage stage, JointSignals<T>* s) const {
    effect.effect->act(stage, EffectContext<T>{arm, effect.joint, effect.p, nullptr, 0.7, nullptr}, s);
  }
  void act(EffectStage stage, JointSignals<double>* s) const { act(e(), transmission.arm(), stage, s); }
  bool acts_at(EffectStage stage) const { return (e().effect->stages() & static_cast<unsigned>(stage)) != 0; }
};

std::vector<Placed> effects_of_one_signal() {
  const ArmParameters<double> arm = random_arm(4, CableLaw::paper);
  std::mt19937_64 random(5);
  std::vector<Placed> all;
  for (const Effect* effect : effect_library()) {
    if (!dynamic_cast<const OneSignalEffect*>(effect)) continue;
    for (const EffectPlace place : effect_places(*effect, arm)) {
      const auto p = within_bounds(effect->parameters(arm, place), random);
      all.push_back({lift_transmission<double>(arm, {placed(effect->name(), arm, place, p)})});
    }
  }
  return all;
}

void randomise(JointSignals<double>* s, std::mt19937_64& random, double JointSignals<double>::*but) {
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 3; ++k)
    for (const auto signal : kSignals)
      if (signal != but) s[k].*signal = unit(random);
}

TEST(OneSignal, SomeEffectsOfEachStagePromiseIt) {
  for (const EffectStage stage :
       {EffectStage::motor, EffectStage::joint, EffectStage::stretch, EffectStage::cable_force})
    EXPECT_TRUE(std::ranges::any_of(effects_of_one_signal(), [&](const Placed& p) { return p.acts_at(stage); }));
}

TEST(OneSignal, TheyHaveNoStatesAndActAtOneJointBetweenCommandAndSensors) {
  for (const Placed& p : effects_of_one_signal()) {
    EXPECT_EQ(p.e().effect->n_states(), 0) << effect_label(p.e());
    EXPECT_TRUE(p.e().joint.has_value()) << effect_label(p.e());
    EXPECT_FALSE(p.acts_at(EffectStage::command)) << effect_label(p.e());
    EXPECT_FALSE(p.acts_at(EffectStage::sensors)) << effect_label(p.e());
  }
}

TEST(OneSignal, ForcesAtMotorAndJointDependOnItAlone) {
  std::mt19937_64 random(6);
  for (const Placed& p : effects_of_one_signal())
    for (const EffectStage stage : kForces) {
      if (!p.acts_at(stage)) continue;
      constexpr double JointSignals<double>::*kOf[] = {
          &JointSignals<double>::motor_angle, &JointSignals<double>::motor_rate, &JointSignals<double>::joint_position,
          &JointSignals<double>::joint_rate};
      const auto signal = kOf[static_cast<int>(dynamic_cast<const OneSignalEffect&>(*p.e().effect).signal_at(stage))];
      const auto force =
          stage == EffectStage::motor ? &JointSignals<double>::motor_torque : &JointSignals<double>::joint_force;
      JointSignals<double> s[kMaxJoints];
      for (int trial = 0; trial < 5; ++trial) {
        randomise(s, random, nullptr);
        double added[2];
        for (double& a : added) {
          randomise(s, random, signal);
          for (int k = 0; k < 3; ++k) s[k].*force = 0;
          p.act(stage, s);
          for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(s[k].*force == 0 || k == *p.e().joint) << effect_label(p.e()) << ", joint " << k;
          a = s[*p.e().joint].*force;
        }
        EXPECT_EQ(added[0], added[1]) << effect_label(p.e());
      }
    }
}

TEST(OneSignal, TheStretchIsReplacedByAFunctionOfItselfAndItsRateByThatOfTheFunction) {
  std::mt19937_64 random(7);
  for (const Placed& p : effects_of_one_signal()) {
    if (!p.acts_at(EffectStage::stretch)) continue;
    const int k = *p.e().joint;
    const auto dual = lift_transmission<Dual>(random_arm(4, CableLaw::paper), {p.e()});
    const auto replaced = [&](const Dual& stretch, double rate) {
      JointSignals<double> others[kMaxJoints];
      randomise(others, random, nullptr);
      JointSignals<Dual> s[kMaxJoints];
      for (int i = 0; i < 3; ++i) s[i].motor_angle = others[i].motor_angle, s[i].joint_rate = others[i].joint_rate;
      s[k].stretch = stretch, s[k].stretch_rate = rate;
      p.act(dual.effects()[0], dual.arm(), EffectStage::stretch, s);
      return s[k];
    };
    for (const double x : {-2e-3, -1e-5, 3e-6, 1e-3}) {
      const auto moving = replaced(Dual::seed(x, 0), 0.02), still = replaced(Dual::seed(x, 0), 0);
      EXPECT_EQ(moving.stretch.a, still.stretch.a) << effect_label(p.e());
      EXPECT_NEAR(moving.stretch_rate.a, still.stretch_rate.a + moving.stretch.d[0] * 0.02, 1e-15)
          << effect_label(p.e());
    }
  }
}

TEST(OneSignal, TheCablesForceHasAFunctionOfTheStretchAddedAtBothEnds) {
  std::mt19937_64 random(8);
  bool acted = false;  // parameters at a bound may be neutral
  for (const Placed& p : effects_of_one_signal()) {
    if (!p.acts_at(EffectStage::cable_force)) continue;
    const int k = *p.e().joint;
    double added[2];
    for (double& a : added) {
      JointSignals<double> s[kMaxJoints];
      randomise(s, random, nullptr);
      s[k].stretch = 0.3;
      p.act(EffectStage::cable_force, s);
      EXPECT_EQ(s[k].cable_force_motor, s[k].cable_force_joint) << effect_label(p.e());
      a = s[k].cable_force_joint;
    }
    acted = acted || added[0] != 0;
    EXPECT_EQ(added[0], added[1]) << effect_label(p.e());
  }
  EXPECT_TRUE(acted);
}

}  // namespace
}  // namespace halyard
