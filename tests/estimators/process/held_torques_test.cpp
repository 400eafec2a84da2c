/// How uncertain torques become that are held for want of a command.

#include "estimators/process/held_torques.h"

#include <gtest/gtest.h>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

/// Commands of motor 1 that change by 0.2 N m every 10 ms: s² = 4 N² m² / s.
HeldTorques zigzag(double until_s) {
  HeldTorques held;
  for (int i = 0; i * 0.01 <= until_s; ++i) held.take(1, 0.01 * i, i % 2 * 0.2);
  return held;
}

TEST(HeldTorques, AreKnownOverOneAndAHalfOfTheirUsualPeriods) {
  const HeldTorques held = zigzag(1);
  EXPECT_EQ(held.impulse_variance(1, 1, 1.015 - 1e-9), 0);
  EXPECT_GT(held.impulse_variance(1, 1, 1.015 + 1e-3), 0);
}

TEST(HeldTorques, WanderAsTheCommandsHaveChanged) {
  const HeldTorques held = zigzag(1);
  // s² Δ³ / 3 of the whole gap, in one step or in several.
  EXPECT_NEAR(held.impulse_variance(1, 1, 1.115), 4 * 1e-3 / 3, 1e-12);
  EXPECT_NEAR(held.impulse_variance(1, 1, 1.05) + held.impulse_variance(1, 1.05, 1.115), 4 * 1e-3 / 3, 1e-12);
}

TEST(HeldTorques, OfAMissingCommandGoOnBeingHeld) {
  HeldTorques held = zigzag(1);
  held.take(1, 1.05, kNan);
  EXPECT_NEAR(held.impulse_variance(1, 1, 1.115), 4 * 1e-3 / 3, 1e-12);
  held.take(1, 1.11, 0);
  EXPECT_EQ(held.impulse_variance(1, 1.11, 1.115), 0) << "the command is known again";
}

TEST(HeldTorques, AfterALongGapAreWhatTheyWereBefore) {
  HeldTorques held = zigzag(1);
  held.take(1, 9, 0);
  EXPECT_NEAR(held.impulse_variance(1, 9, 9.115), 4 * 1e-3 / 3, 1e-12);
}

TEST(HeldTorques, OfOneCommandAloneAreTakenForConstant) {
  HeldTorques held;
  held.take(0, 0, 0.5);
  EXPECT_EQ(held.impulse_variance(0, 0, 10), 0);
  EXPECT_EQ(held.impulse_variance(1, 0, 10), 0) << "no command at all";
}

/// A moving arm of which 100 ms are missing: how many readings the gate refuses after the gap.
int refused_after_a_gap(bool torques_are_there) {
  const ArmModel model = raven2();
  const ArmRun run = run_arm(model, 1.5);
  const auto filter = make_sr_ukf(model, {{"gate", "0.9999"}});
  filter->reset(run.samples[0]);
  int refused = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    Sample sample = run.samples[i];
    if (sample.time_s > 0.8 && sample.time_s < 0.9) {
      if (!torques_are_there) continue;
      sample.motor_position.setConstant(kNan);
    }
    refused += !filter->update(sample).accepted;
  }
  return refused;
}

TEST(HeldTorques, LetAFilterTakeTheFirstReadingsAfterAGap) {
  EXPECT_EQ(refused_after_a_gap(true), 0);
  EXPECT_EQ(refused_after_a_gap(false), 0);
}

}  // namespace
}  // namespace halyard
