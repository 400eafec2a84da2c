#include "diagnosis/fit/fit_parameter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

TEST(FitParameter, AWholeNumberHasWholeBounds) {
  const Evidence evidence = small_evidence();
  const ArmModel model = first_joints(2);
  for (const char* name : {"torque_ripple", "capstan_eccentricity"}) {
    const Hypothesis h{model.nominal, {place_effect(*find_effect(name), model.nominal, 1)}};
    const std::vector<FitParameter> all = effect_parameters(evidence, h, model.nominal, 0);
    for (const FitParameter& p : all) {
      if (!p.is_whole) continue;
      EXPECT_EQ(p.lower, std::round(p.lower)) << name;
      EXPECT_EQ(p.upper, std::round(p.upper)) << name;
      EXPECT_LE(p.lower, p.starts.front()) << name;
      EXPECT_FALSE(ends_at_bound(p, p.lower)) << name << ": the lowest order that the motion shows is plausible";
    }
  }
}

TEST(FitParameter, OfTheModelStaysBesideAnEffectThatChangesSeveralInOneProportion) {
  const ArmModel model = first_joints(2);
  const auto of_model = [&](const char* effect, EffectPlace joint) {
    const PlacedEffect placed = place_effect(*find_effect(effect), model.nominal, joint);
    int changed = 0, covered = 0;
    for (const FitParameter& p : baseline_parameters(model)) {
      changed += effect_changes(placed, model.nominal, p);
      covered += effect_covers(placed, model.nominal, p);
    }
    return std::pair(changed, covered);
  };
  const auto [by_payload, covered_by_payload] = of_model("payload", kWholeArm);
  EXPECT_GT(by_payload, 1) << "mass, centre of mass and inertia";
  EXPECT_EQ(covered_by_payload, 0);
  const auto [by_stiffness, covered_by_stiffness] = of_model("stiffness", 1);
  EXPECT_EQ(by_stiffness, 2) << "stiffness and damping";
  EXPECT_EQ(covered_by_stiffness, 2);
}

TEST(FitParameter, OfAPositionLiesWhereTheJointIsAndNotWhereItsEncoderReads) {
  constexpr double kOffset = 0.3;  // rad
  const ArmModel given = first_joints(1);
  ArmModel model = given;
  Log log = simulate(motion(given, 3)).measured;
  const Span span = Evidence(make_records(log, given, {}), given).joint_span(0);
  for (double& q : log.joint_position[0]) q += kOffset;
  model.nominal.joint[0].joint_encoder_offset = kOffset;
  const Span of_readings = Evidence(make_records(log, model, {}), model).joint_span(0);
  EXPECT_NEAR(of_readings.first, span.first, 1e-12);
  EXPECT_NEAR(of_readings.last, span.last, 1e-12);
}

TEST(FitParameter, OfAWaveNumberStartsAtEveryHalfPeriodOfTheMotion) {
  const ArmModel model = first_joints(3);
  Scenario slow = motion(model, 3);
  for (Sine& sine : slow.trajectory[2].sines) sine.amplitude *= 0.1;  // m
  const Evidence evidence(make_records(simulate(slow).measured, model, {}), model);
  const Hypothesis h{model.nominal, {place_effect(*find_effect("encoder_eccentricity"), model.nominal, 2)}};
  const FitParameter p = effect_parameters(evidence, h, model.nominal, 0)[2];
  ASSERT_EQ(p.name, "wave_number");
  const Span span = evidence.joint_span(2);
  for (std::size_t i = 1; i < p.starts.size(); ++i)
    EXPECT_LE((p.starts[i] - p.starts[i - 1]) * (span.last - span.first), 1.001 * std::numbers::pi);
  EXPECT_EQ(p.starts.front(), p.lower);
  EXPECT_GT(p.starts.back(), 0.99 * p.upper);
}

/// The log of a motor's torque may be a current.
TEST(FitParameter, TheFloorOfATorqueIsInTheUnitOfTheLog) {
  constexpr double kScale = 0.02;  // N m per A
  const ArmModel given = first_joints(2);
  ArmModel model = given;
  Log log = simulate(motion(given, 6)).measured;
  const Evidence in_newton_metres(make_records(log, given, {}), given);
  for (double& torque : log.motor_torque[0]) torque /= kScale;
  model.nominal.joint[0].torque_scale = kScale;
  const Evidence in_amperes(make_records(log, model, {}), model);
  EXPECT_NEAR(in_amperes.resolved()[0] / in_newton_metres.resolved()[0], 1 / kScale, 1e-6 / kScale);
  const auto rms = [](const Evidence& evidence, const ArmModel& arm) {
    return std::sqrt(evidence.score({arm.nominal, {}}).mean_square[0]);
  };
  EXPECT_NEAR(rms(in_amperes, model) / rms(in_newton_metres, given), 1 / kScale, 1e-3 / kScale)
      << "and so is the residual";
}

TEST(FitParameter, OfASpeedNearStandstillIsAtMostAQuarterOfTheFastestMotion) {
  const ArmModel model = first_joints(1);
  const JointParameters<double>& j = model.nominal.joint[0];
  const Hypothesis h{model.nominal, {place_effect(*find_effect("stribeck"), model.nominal, 0)}};
  const std::vector<FitParameter> all = effect_parameters(made_evidence(), h, model.nominal, 0);
  ASSERT_EQ(all.size(), 4u);
  constexpr double kFastest = 0.51;  // rad/s
  EXPECT_NEAR(all[1].upper, kFastest / 4, 1e-3);
  EXPECT_NEAR(all[3].upper, kFastest / 4 * j.pulley_radius / j.motor_travel(), 0.1);
  // Of 15, 50 and 150 mrad/s of the joint, and 1.5, 5 and 15 rad/s of the motor.
  EXPECT_EQ(all[1].starts, (std::vector<double>{3 * j.joint_smoothing, 10 * j.joint_smoothing}));
  EXPECT_EQ(all[3].starts.size(), 3u);
}

TEST(FitParameter, OfTheGreatestSpeedOfAMotorStartsAboveItsFastestMotion) {
  const ArmModel model = first_joints(1);
  const Hypothesis h{model.nominal, {place_effect(*find_effect("actuator_saturation"), model.nominal, 0)}};
  const FitParameter p = effect_parameters(made_evidence(), h, model.nominal, 0)[2];
  ASSERT_EQ(p.name, "no_load_speed");
  EXPECT_TRUE(std::ranges::is_sorted(p.starts));
  EXPECT_EQ(p.starts.size(), 3 + 4u);
  for (const double left : {0.02, 0.06, 0.2, 0.5}) {
    // The torque at the fastest motion is this share of that at standstill.
    const double start = made_evidence().greatest_speed(0) / (1 - left);
    EXPECT_NEAR(std::ranges::min(p.starts, {}, [&](double s) { return std::abs(s - start); }), start, 1e-9) << left;
  }
}

TEST(FitParameter, OfAnOrderIsOneThatPassesOneAndAHalfPeriodsInTheMotion) {
  const ArmModel model = first_joints(1);
  const Hypothesis h{model.nominal, {place_effect(*find_effect("encoder_eccentricity"), model.nominal, 0)}};
  const FitParameter p = effect_parameters(made_evidence(), h, model.nominal, 0)[2];
  ASSERT_EQ(p.name, "order");
  // The joint moves over 0.6 rad: 1.5 · 2π / 0.6 = 15.7.
  EXPECT_EQ(p.lower, 16);
  EXPECT_EQ(p.starts.front(), 16);
}

TEST(FitParameter, OfAnOrderNeedsAMotionOfOneAndAHalfPeriodsOfTheHighest) {
  const ArmModel model = first_joints(1);
  const auto has_enough = [&](const char* name, double way) {
    const Log log = log_along(4, 100, [&](double t) { return 0.8 - way / 2 * std::cos(1.7 * t); });
    return has_enough_periods(Evidence(make_records(log, model, {}), model),
                              place_effect(*find_effect(name), model.nominal, 0), model.nominal);
  };
  // Its highest order is 64: 1.5 · 2π / 64 = 0.147 rad. The records begin near one end of the motion.
  EXPECT_TRUE(has_enough("encoder_eccentricity", 0.16));
  EXPECT_FALSE(has_enough("encoder_eccentricity", 0.14));
  EXPECT_TRUE(has_enough("encoder_offset", 0.14)) << "has no periods";
  const JointParameters<double>& j = model.nominal.joint[0];
  const double of_capstan = 1.5 * 2 * std::numbers::pi * j.capstan_radius / j.pulley_radius;
  EXPECT_TRUE(has_enough("capstan_eccentricity", 1.1 * of_capstan));
  EXPECT_FALSE(has_enough("capstan_eccentricity", 0.95 * of_capstan));
}

}  // namespace
}  // namespace halyard
