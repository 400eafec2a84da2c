/// Torques in the units of a log: what the model says is needed, and a scale that it does not know.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/calibration/calibrate.h"
#include "diagnosis/calibration/torque_comparison.h"
#include "diagnosis/prediction/measured_units.h"
#include "model/input_error.h"
#include "plant/simulate.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// A log of two joints in motion, simulated once.
const Log& moving_log() {
  static const Log log = [] {
    Log simulated = simulate(motion(first_joints(2), 6)).measured;
    simulated.source = "rig.csv";
    return simulated;
  }();
  return log;
}

TEST(TorqueComparison, OfARightModelNeedsWhatWasRecordedWhereTheMotorMoves) {
  const ArmModel model = first_joints(2);
  const std::vector<Record> records = make_records(moving_log(), model, {});
  const TorqueComparison c = compare_torques(model, records);
  ASSERT_EQ(c.recorded.size(), 2u);
  EXPECT_NEAR(c.step, 5 * records[0].dt, 1e-12);
  for (int k = 0; k < 2; ++k) {
    ASSERT_EQ(c.recorded[k].size(), (records[0].size + 4) / 5);
    ASSERT_EQ(c.needed[k].size(), c.recorded[k].size());
    double off = 0, all = 0, moving = 0;
    for (std::size_t i = 0; i < c.needed[k].size(); ++i) {
      const double rate = std::abs(records[0].motor_rate[k][5 * i]);
      if (rate <= 2 * model.nominal.joint[k].motor_smoothing) {
        EXPECT_TRUE(std::isnan(c.needed[k][i])) << "at rest, " << i;
      }
      if (!std::isfinite(c.needed[k][i])) continue;
      moving += 1;
      off += std::pow(c.recorded[k][i] - c.needed[k][i], 2), all += std::pow(c.recorded[k][i], 2);
    }
    EXPECT_GT(moving, 0.5 * static_cast<double>(c.needed[k].size()));
    EXPECT_LT(off, 0.05 * 0.05 * all) << "joint " << k + 1;
  }
}

TEST(TorqueComparison, IsInTheUnitOfTheLogWhateverTheScaleOfTheModel) {
  ArmModel model = first_joints(2);
  const TorqueComparison newtons = compare_torques(model, make_records(moving_log(), model, {}));
  model.nominal.joint[1].torque_scale = 0.25;  // N m per unit
  Log log = moving_log();
  for (double& t : log.motor_torque[1]) t *= 4;
  const TorqueComparison units = compare_torques(model, make_records(log, model, {}));
  for (std::size_t i = 0; i < newtons.needed[1].size(); ++i) {
    if (!std::isfinite(newtons.needed[1][i])) continue;
    EXPECT_NEAR(units.recorded[1][i], 4 * newtons.recorded[1][i], 1e-9);
    EXPECT_NEAR(units.needed[1][i], 4 * newtons.needed[1][i], 1e-9);
    if (std::isfinite(newtons.needed[0][i])) {
      EXPECT_NEAR(units.needed[0][i], newtons.needed[0][i], 1e-9);
    }
  }
}

TEST(TorqueComparison, OfARecordWithoutTorqueHasNone) {
  const ArmModel model = first_joints(2);
  Log log = moving_log();
  log.motor_torque[0].clear();
  const TorqueComparison c = compare_torques(model, make_records(log, model, {}));
  ASSERT_EQ(c.recorded[0].size(), c.recorded[1].size());
  for (const double t : c.recorded[0]) EXPECT_TRUE(std::isnan(t));
  for (const double t : c.needed[0]) EXPECT_TRUE(std::isnan(t));
}

TEST(Calibrated, AScaleThatIsUnknownIsFoundWhateverTheModelSays) {
  ArmModel model = first_joints(2);
  Log log = moving_log();
  for (double& t : log.motor_torque[0]) t *= 8;  // a current of 0.125 N m/A
  model.joints[0].tolerances.torque_scale = 1;
  for (const double guess : {0.01, 1.0, 30.0}) {
    model.nominal.joint[0].torque_scale = guess;
    const ArmModel found = calibrated(model, make_records(log, model, {}));
    // Friction and the filters leave a few percent of the torque.
    EXPECT_NEAR(found.nominal.joint[0].torque_scale, 0.125, 0.05 * 0.125) << guess;
    EXPECT_EQ(found.nominal.joint[1].torque_scale, model.nominal.joint[1].torque_scale);
  }
}

TEST(Calibrated, AScaleThatIsKnownStays) {
  ArmModel model = first_joints(2);
  model.nominal.joint[0].torque_scale = 3;
  model.joints[0].tolerances.torque_scale = 0.99;
  EXPECT_EQ(calibrated(model, make_records(moving_log(), model, {})).nominal.joint[0].torque_scale, 3);
  model.joints[0].tolerances.torque_scale = 1;
  model.nominal.joint[0].drive = Drive::none;
  EXPECT_EQ(calibrated(model, make_records(moving_log(), model, {})).nominal.joint[0].torque_scale, 3);
}

TEST(Calibrated, ATorqueThatDoesNotGoWithTheMotionIsRefused) {
  ArmModel model = first_joints(2);
  model.joints[0].tolerances.torque_scale = 1;
  Log log = moving_log();
  std::mt19937 random(1);
  for (double& t : log.motor_torque[0]) t = std::normal_distribution<double>()(random);
  const std::string told = message_of([&] { calibrated(model, make_records(log, model, {})); });
  EXPECT_TRUE(told.starts_with("rig.csv: motor_torque_1, of unknown scale, does not go with the motor's motion "))
      << told;
  log = moving_log();
  for (double& t : log.motor_torque[0]) t *= -1;
  EXPECT_NE(message_of([&] { calibrated(model, make_records(log, model, {})); }), "no InputError");
}

TEST(UnknownScale, IsThatOfADrivenMotorWithoutTolerance) {
  ArmModel model = first_joints(2);
  model.joints[1].tolerances.torque_scale = 1;
  ArmParameters<double> arm = model.nominal;
  const std::vector<ParameterInfo> all = named_parameters(arm);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(is_unknown_scale(model, i), all[i].key == "joint2.motor.torque_scale") << all[i].key;
}

/// κ of motor 1 of a record whose commands are those of the log.
double ratio_of(const Record& record, const Hypothesis& h) {
  CommandHistory history(record.n, 10);
  for (std::size_t i = 0; i < record.size; ++i) {
    const double commands[] = {record.torque[0][i], record.torque[1][i]};
    history.push(record.time(i), commands);
  }
  return acting_over_commanded(record, h, 0, history);
}

TEST(ActingOverCommanded, IsTheScaleOfTheMotor) {
  const ArmModel model = first_joints(2);
  Record record = make_records(moving_log(), model, {})[0];
  Hypothesis h{model.nominal, {}};
  h.nominal.joint[0].torque_scale = -0.7;
  EXPECT_DOUBLE_EQ(ratio_of(record, h), 0.7);
  // An effect that scales the torque, alone and on top of the motor's own scale.
  PlacedEffect weak = place_neutral_effect(*find_effect("torque_scale"), model.nominal, 0);
  weak.p[0] = 0.5;
  h.nominal.joint[0].torque_scale = 1;
  h.effects = {weak};
  EXPECT_NEAR(ratio_of(record, h), 0.5, 1e-9);
  h.nominal.joint[0].torque_scale = 0.6;
  EXPECT_NEAR(ratio_of(record, h), 0.3, 1e-9);
  // Never less than a twentieth of the motor's scale.
  h.effects[0].p[0] = 1e-3;
  EXPECT_NEAR(ratio_of(record, h), 0.05 * 0.6, 1e-9);
}

TEST(ActingOverCommanded, OfAnEffectOfTheCommandIsTheShareThatActs) {
  const ArmModel model = first_joints(2);
  Record record = make_records(moving_log(), model, {})[0];
  PlacedEffect saturates = place_neutral_effect(*find_effect("actuator_saturation"), model.nominal, 0);
  saturates.p[0] = 0.6;   // of the torque beyond
  saturates.p[1] = 1e-9;  // N m: all of it is beyond
  Hypothesis h{model.nominal, {saturates}};
  h.nominal.joint[0].torque_scale = 0.5;
  EXPECT_NEAR(ratio_of(record, h), 0.5 * (1 - 0.6), 1e-6);
  h.effects[0].p[0] = 0.999;
  EXPECT_NEAR(ratio_of(record, h), 0.05 * 0.5, 1e-12) << "a twentieth at least";
  record.torque[0].assign(record.size, 0.125);
  EXPECT_EQ(ratio_of(record, h), 0.5) << "a command that never changes tells nothing";
}

TEST(Calibrated, ALargeMeanTorqueDoesNotHideThatATorqueGoesWithTheMotion) {
  // Gravity, much larger than its changes over a small motion without friction.
  ArmModel model = first_joints(2);
  for (int k = 0; k < 2; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j.motor_coulomb = j.joint_coulomb = 0;
    j.mass *= 3;
  }
  Scenario scenario = motion(model, 3);
  for (JointTrajectory& t : scenario.trajectory)
    for (Sine& sine : t.sines) sine.amplitude *= 0.1;
  const Log log = simulate(scenario).measured;
  model.joints[1].tolerances.torque_scale = 1;
  const std::vector<Record> records = make_records(log, model, {});
  const TorqueComparison c = compare_torques(model, records);
  double n = 0, mean = 0, square = 0;
  for (const double t : c.needed[1])
    if (std::isfinite(t)) n += 1, mean += t, square += t * t;
  mean /= n;
  ASSERT_GT(mean * mean, 10 * (square / n - mean * mean)) << "the test shows nothing";
  EXPECT_NEAR(calibrated(model, records).nominal.joint[1].torque_scale, 1, 0.05);
}

}  // namespace
}  // namespace halyard
