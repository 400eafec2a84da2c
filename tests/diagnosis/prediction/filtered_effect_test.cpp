#include "diagnosis/prediction/filtered_effect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_arm.h"

namespace halyard {
namespace {

constexpr double kSigma = 0.01;  // s

PlacedEffect ripple(const ArmParameters<double>& arm) {
  PlacedEffect e = place_effect(*find_effect("torque_ripple"), arm, 1);
  e.p[0] = 0.3, e.p[1] = -0.2, e.p[2] = 6;
  return e;
}

/// What the effect adds to the torque of motor 2.
double torque_added(const Effect& effect, const ArmParameters<double>& arm, const double* p, double angle, double rate,
                    double torque_before = 0) {
  JointSignals<double> s[kMaxJoints];
  s[1].motor_angle = angle, s[1].motor_rate = rate, s[1].motor_torque = torque_before;
  effect.act(EffectStage::motor, EffectContext<double>{arm, 1, p, nullptr, 0, nullptr}, s);
  return s[1].motor_torque - torque_before;
}

TEST(FilteredEffect, APeriodicTorqueIsWhatAGaussianFilterLeavesOfIt) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const PlacedEffect e = ripple(arm);
  const FilteredEffects seen({e}, arm, kSigma, 0);
  for (const double rate : {0.0, 3.0, 20.0, 40.0})
    for (const double angle : {0.1, 2.0}) {
      // The convolution with the Gaussian, by the trapezoidal rule, which is exact to rounding over eight deviations.
      constexpr int kSteps = 400;
      double filtered = 0, weight = 0;
      for (int i = -kSteps; i <= kSteps; ++i) {
        const double u = 8.0 * i / kSteps, w = std::exp(-0.5 * u * u);
        filtered += w * torque_added(*e.effect, arm, e.p, angle - rate * u * kSigma, rate);
        weight += w;
      }
      // 800 terms of at most 0.5 N m, each rounded, and tails beyond eight deviations of 1e-15.
      EXPECT_NEAR(torque_added(*seen[0], arm, e.p, angle, rate), filtered / weight, 1e-13) << rate << " rad/s";
    }
}

TEST(FilteredEffect, APeriodicErrorOfAJointSensorIsAttenuatedWhereItsReadingsAre) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  PlacedEffect e = place_effect(*find_effect("encoder_eccentricity"), arm, 0);
  e.p[2] = 8;
  const auto error_added = [&](const Effect& effect, double position, double rate) {
    JointSignals<double> s[kMaxJoints];
    s[0].joint_position = position, s[0].joint_rate = rate, s[0].joint_error = 0.1;
    effect.act(EffectStage::sensors, EffectContext<double>{arm, 0, e.p, nullptr, 0, nullptr}, s);
    return s[0].joint_error - 0.1;
  };
  const FilteredEffects seen({e}, arm, 0, kSigma);
  for (const double rate : {0.0, 2.0, 20.0}) {
    constexpr int kSteps = 400;  // the convolution, as of the torque
    double filtered = 0, weight = 0;
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double u = 8.0 * i / kSteps, w = std::exp(-0.5 * u * u);
      filtered += w * error_added(*e.effect, 0.4 - rate * u * kSigma, rate);
      weight += w;
    }
    EXPECT_NEAR(error_added(*seen[0], 0.4, rate), filtered / weight, 1e-13) << rate << " rad/s";
  }
  EXPECT_EQ(FilteredEffects({e}, arm, kSigma, 0)[0], e.effect) << "compared with the readings themselves";
}

TEST(FilteredEffect, LeavesTheTorqueOfOthersAlone) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const PlacedEffect e = ripple(arm);
  const FilteredEffects seen({e}, arm, kSigma, 0);
  // Two roundings of 5.5 N m.
  EXPECT_NEAR(torque_added(*seen[0], arm, e.p, 0.7, 20, 5), torque_added(*seen[0], arm, e.p, 0.7, 20), 2e-15);
}

TEST(FilteredEffect, WhatIsNotPeriodicOrNotFilteredIsSeenAsItIs) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  const PlacedEffect e = ripple(arm), friction = place_effect(*find_effect("motor_friction"), arm, 1);
  EXPECT_EQ(FilteredEffects({e}, arm, 0, 0)[0], e.effect);
  const FilteredEffects seen({friction, e}, arm, kSigma, 0);
  EXPECT_EQ(seen[0], friction.effect);
  EXPECT_NE(seen[1], e.effect);
}

}  // namespace
}  // namespace halyard
