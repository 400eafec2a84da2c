#include "plant/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/input_error.h"
#include "plant/trajectory.h"
#include "tests/support/message_of.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

Scenario experiment(const std::string& letter, double duration) {
  Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/experiment_" + letter + ".xml");
  s.duration_s = duration;
  return s;
}

std::string refusal_of(const Scenario& scenario) {
  return message_of([&] { simulate(scenario); });
}

TEST(Faster, LeavesAChosenEngineAlone) {
  Scenario scenario;
  EXPECT_EQ(faster(scenario).engine, Engine::halyard);
  scenario.engine = Engine::simbody;
  EXPECT_EQ(faster(scenario).engine, Engine::simbody);
  scenario.engine.reset();
  scenario.integrator.kind = IntegratorKind::simbody_rkm;
  EXPECT_EQ(faster(scenario).engine, std::nullopt);
}

TEST(Simulate, LogsReadingsAndTheTorquesThatFollowFromThem) {
  Scenario scenario = experiment("a", 0.2);
  scenario.fade_in_s = 0.05;
  scenario.noise.motor_torque.assign(3, 1e-3);  // disturbs the arm, is not in the log
  const SimulationResult result = simulate(scenario);
  const Log &log = result.measured, &truth = result.truth;
  ASSERT_EQ(log.size(), 201u);
  const ArmParameters<double>& arm = scenario.robot.nominal;
  const double count = 2 * std::numbers::pi / 4000;
  Eigen::VectorXd error_before;
  bool noisy = false;
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_DOUBLE_EQ(log.time[i], 1e-3 * i);
    Eigen::VectorXd q(3), error(3);
    for (int k = 0; k < 3; ++k) q(k) = desired_position(scenario.trajectory[k], scenario.fade_in_s, log.time[i]);
    const Eigen::VectorXd wanted = unstretched_motors(arm, q);
    for (int k = 0; k < 3; ++k) {
      const double reading = log.motor_position[k][i];
      EXPECT_NEAR(std::remainder(reading, count), 0, 1e-12);
      EXPECT_LE(std::abs(reading - truth.motor_position[k][i]), 0.5 * count + 1e-12);
      const double resolution = arm.joint[k].joint_encoder_resolution;
      EXPECT_LE(std::abs(log.joint_position[k][i] - truth.joint_position[k][i]), 0.5 * resolution + 1e-12);
      error(k) = wanted(k) - reading;
    }
    if (i == 0) error_before = error;
    for (int k = 0; k < 3; ++k) {
      const ControllerParameters& c = scenario.robot.joints[k].controller;
      const double torque = c.kp * error(k) + c.kd * (error(k) - error_before(k)) / 1e-3;
      EXPECT_NEAR(log.motor_torque[k][i], std::clamp(torque, -c.torque_limit, c.torque_limit), 1e-12);
      noisy = noisy || std::abs(truth.motor_torque[k][i] - log.motor_torque[k][i]) > 1e-3;
    }
    error_before = error;
  }
  EXPECT_TRUE(noisy);
}

TEST(Simulate, StartsAtRestWithTheCablesHoldingTheArm) {
  const SimulationResult r = simulate(experiment("a", 0.01));
  const double pull = (r.truth.motor_position[1][0] * 5.675e-3 / 12.25 -
                       56.298e-3 * (r.truth.joint_position[1][0] + 0.14545 * r.truth.joint_position[0][0])) *
                      2 * 88e3 * 56.298e-3;
  EXPECT_GT(std::abs(pull), 0.1);  // N m: gravity stretches cable 2
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(r.truth.joint_velocity[k][0], 0);
    EXPECT_DOUBLE_EQ(r.truth.joint_position[k][0], experiment("a", 1).robot.joints[k].home);
  }
}

TEST(Simulate, RepeatsToTheLastBitAndFollowsItsSeed) {
  Scenario scenario = experiment("c", 0.1);
  scenario.noise.motor_torque.assign(3, 1e-3);
  const Log first = simulate(scenario).truth, again = simulate(scenario).truth;
  EXPECT_EQ(first.motor_position, again.motor_position);
  EXPECT_EQ(first.joint_velocity, again.joint_velocity);
  scenario.seed = 2;
  EXPECT_NE(first.motor_position, simulate(scenario).truth.motor_position);
}

TEST(Simulate, ReportsItsProgress) {
  std::vector<double> done;
  simulate(experiment("a", 0.5), [&](double share) { done.push_back(share); });
  EXPECT_EQ(done.size(), 6u);
  EXPECT_EQ(done.front(), 0);
  EXPECT_EQ(done.back(), 1);
}

/// RMS of joint k's position less what an inelastic arm would have for the motor readings, around its mean.
double lost_motion(const Scenario& scenario, const Log& log, int k) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    Eigen::VectorXd q_m(3);
    for (int j = 0; j < 3; ++j) q_m(j) = log.motor_position[j][i];
    const double lost = log.joint_position[k][i] - unstretched_joints(scenario.assumed->nominal, q_m, q_m)(k);
    sum += lost;
    squares += lost * lost;
  }
  const double n = static_cast<double>(log.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

TEST(Simulate, TakesEffectsAsTruth) {
  const auto run = [](const char* effect, int joint, std::vector<double> p) {
    Scenario s = experiment("a", 4);
    s.fade_in_s = 1;
    if (*effect) {
      PlacedEffect placed = place_effect(*find_effect(effect), s.robot.nominal, joint);
      std::copy(p.begin(), p.end(), placed.p);
      s.robot.effects = {placed};
    }
    return std::pair(s, simulate(s).measured);
  };
  const auto [nominal, log] = run("", 0, {});
  const double plain = lost_motion(nominal, log, 1);
  const auto [with_gap, gap_log] = run("backlash", 1, {0.35e-3});
  // Lost motion of a gap of ±h seen from the joint: up to ±h / r_l = 6.2 mrad.
  EXPECT_GT(lost_motion(with_gap, gap_log, 1), plain + 1e-3);
  EXPECT_LT(lost_motion(with_gap, gap_log, 1), plain + 6.3e-3);
  const auto [soft, soft_log] = run("hysteresis", 2, {});
  EXPECT_NE(soft_log.joint_position, log.joint_position);
  const auto [offset, offset_log] = run("encoder_offset", 1, {0.01, 0});
  EXPECT_NE(offset_log.motor_position, log.motor_position);
}

TEST(Simulate, RunsWithEveryEffectOfTheLibrary) {
  for (const Effect* effect : effect_library()) {
    Scenario scenario = experiment("a", 0.1);
    scenario.fade_in_s = 0.05;
    const ArmParameters<double>& arm = scenario.robot.nominal;
    scenario.robot.effects = {place_effect(*effect, arm, effect_places(*effect, arm).front())};
    const SimulationResult result = simulate(scenario);
    const JointDescription& range = scenario.robot.joints[0];
    for (const double q : result.truth.joint_position[0]) {
      ASSERT_GT(q, range.lower) << effect->name();
      ASSERT_LT(q, range.upper) << effect->name();
    }
  }
}

TEST(Simulate, ControlsTheTrueArmByTheModelItAssumes) {
  Scenario scenario = experiment("a", 0.05);
  scenario.robot.nominal.joint[0].capstan_radius *= 1.05;
  scenario.homed = false;
  const Log log = simulate(scenario).measured;
  // At the start the true motor stands 5 % off the angle that the controller wants of it.
  const double wanted = unstretched_motors(scenario.assumed->nominal, scenario.robot.home())(0);
  EXPECT_NEAR(log.motor_position[0][0], wanted / 1.05, 1e-3 * wanted);
}

TEST(Simulate, HomingSetsTheZeroWhateverTheEncoderHadBefore) {
  Scenario scenario = experiment("a", 0.01);
  scenario.quantise = false;
  scenario.homed = true;
  const double reading = simulate(scenario).measured.motor_position[0][0];
  scenario.robot.nominal.joint[0].motor_encoder_offset = 0.5;
  EXPECT_NEAR(simulate(scenario).measured.motor_position[0][0], reading, 1e-12) << "of the robot alone";
  scenario.assumed->nominal.joint[0].motor_encoder_offset = 10;
  EXPECT_NEAR(simulate(scenario).measured.motor_position[0][0], reading + 10, 1e-12) << "as the controller assumes";
}

TEST(Simulate, HomedFindsTheZerosThatTheModelDoesNotKnow) {
  Scenario scenario = experiment("a", 0.5);
  scenario.robot.nominal.joint[1].motor_encoder_offset = 0.3;
  scenario.homed = false;
  ArmModel model = scenario.robot;
  const Log as_read = simulate(scenario).measured;
  EXPECT_EQ(simulate_homed(scenario, model).measured.motor_position, as_read.motor_position);
  model.nominal.joint[1].motor_zero_known = false;
  const Log homed = simulate_homed(scenario, model).measured;
  EXPECT_EQ(homed.motor_position[0], as_read.motor_position[0]);
  // But for the stretch of the cable under the arm's weight, 0.3 mm: as much at the motor as the zero is wrong.
  Scenario right = scenario;
  right.robot.nominal.joint[1].motor_encoder_offset = 0;
  EXPECT_NEAR(homed.motor_position[1][0], simulate_homed(right, model).measured.motor_position[1][0], 5e-3);
}

TEST(Simulate, HomingLeavesTheOffsetThatAnEffectAddsOnce) {
  Scenario scenario = experiment("a", 0.1);
  scenario.quantise = false;
  const auto offset_of = [](const Scenario& s) {
    const SimulationResult r = simulate(s);
    return r.measured.motor_position[0].back() - r.truth.motor_position[0].back();
  };
  const double without = offset_of(scenario);
  PlacedEffect e = place_neutral_effect(*find_effect("encoder_offset"), scenario.robot.nominal, 0);
  e.p[0] = 0.1;
  scenario.robot.effects = {e};
  double last = 0;
  for (const bool homed : {false, true})
    for (const bool is_known : {false, true}) {
      scenario.homed = homed;
      scenario.assumed->effects = is_known ? std::vector{e} : std::vector<PlacedEffect>{};
      const double added = offset_of(scenario) - without;
      EXPECT_GT(std::abs(added), 0.1);
      if (last != 0) EXPECT_NEAR(added, last, 1e-9) << homed << is_known;
      last = added;
    }
}

TEST(Simulate, TheControllerKnowsTheOffsetOfAnEncoderThatTheModelStates) {
  Scenario scenario = experiment("a", 0.3);
  scenario.quantise = false;
  scenario.homed = false;
  const std::vector<double> right = simulate(scenario).truth.joint_position[0];
  scenario.robot.nominal.joint[0].motor_encoder_offset = 10;
  const std::vector<double> unknown = simulate(scenario).truth.joint_position[0];
  EXPECT_GT(std::abs(unknown.back() - right.back()), 0.01) << "an error that only the robot has";
  scenario.assumed->nominal.joint[0].motor_encoder_offset = 10;
  const std::vector<double> stated = simulate(scenario).truth.joint_position[0];
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(stated[i], right[i], 1e-9) << i;
}

TEST(Simulate, TheControllerKnowsTheEffectsOfItsModel) {
  Scenario scenario = experiment("a", 0.01);
  scenario.quantise = false;
  scenario.homed = true;
  PlacedEffect ratio = place_neutral_effect(*find_effect("capstan_ratio"), scenario.robot.nominal, 1);
  ratio.p[0] = 1.1;
  scenario.robot.effects.push_back(ratio);
  scenario.assumed->effects = scenario.robot.effects;
  const SimulationResult r = simulate(scenario);
  EXPECT_NEAR(r.measured.motor_position[1][0], r.truth.motor_position[1][0], 1e-12) << "homing finds no zero to move";
}

TEST(Simulate, AddsTheNoiseOfTheRobotsEncodersToThatOfTheScenario) {
  Scenario scenario = experiment("a", 2);
  scenario.quantise = false;
  scenario.robot.nominal.joint[1].motor_encoder_noise = 3e-4;
  scenario.robot.nominal.joint[1].joint_encoder_noise = 3e-4;
  scenario.noise.joint_reading.assign(3, 4e-4);
  const SimulationResult r = simulate(scenario);
  const auto deviation = [](const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(a[i] - b[i], 2) / static_cast<double>(a.size());
    return std::sqrt(square);
  };
  const auto of_motor = [&](int k) { return deviation(r.measured.motor_position[k], r.truth.motor_position[k]); };
  const auto of_joint = [&](int k) { return deviation(r.measured.joint_position[k], r.truth.joint_position[k]); };
  constexpr double kScatter = 0.06;  // of a deviation of 2001 readings: 1.6 %, four times
  EXPECT_NEAR(of_motor(0), 0, 1e-12);
  EXPECT_NEAR(of_motor(1), 3e-4, kScatter * 3e-4);
  EXPECT_NEAR(of_joint(0), 4e-4, kScatter * 4e-4);
  EXPECT_NEAR(of_joint(1), 5e-4, kScatter * 5e-4);
}

TEST(Simulate, RefusesWhatCannotBeRun) {
  Scenario scenario = experiment("a", 1);
  scenario.trajectory.pop_back();
  EXPECT_THROW(simulate(scenario), InputError);
  for (double IntegratorOptions::*tolerance :
       {&IntegratorOptions::relative_tolerance, &IntegratorOptions::absolute_tolerance}) {
    scenario = experiment("a", 1);
    scenario.integrator.*tolerance = 0;
    EXPECT_THROW(simulate(scenario), InputError);
  }
  scenario = experiment("a", 1);
  scenario.robot.nominal.joint[1].stiffness = 1e-3;
  try {
    simulate(scenario);
    FAIL() << "ran";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.substr(0, 73), "scenario 'A: high tension': joint 2: no stretch of its cable up to 1 m gi");
  }
}

TEST(Simulate, SaysWhichJointAnAbsurdForceMovesBeyondAnyCable) {
  Scenario scenario = experiment("a", 0.01);
  for (double& g : scenario.robot.nominal.gravity) g *= 1e160;
  const std::string what = refusal_of(scenario);
  EXPECT_TRUE(what.starts_with("scenario 'A: high tension': joint 1: no stretch of its cable up to 1 m gives the "))
      << what;
  EXPECT_LT(what.size(), 200u) << "numbers have few digits";
}

TEST(Simulate, NeedsAControllerWhereAJointIsToMove) {
  Scenario a = experiment("a", 0.01);
  a.robot.joints[1].controller = {};
  EXPECT_NE(refusal_of(a).find("trajectory of joint 2: the joint has no controller that follows it"), std::string::npos)
      << refusal_of(a);
  a.trajectory[1] = {};
  a.trajectory[1].center = a.robot.joints[1].home;
  EXPECT_EQ(refusal_of(a), "no InputError") << "an arm without a motion to follow may fall";
}

TEST(Simulate, EndsWhereTheControlledArmIsUnstable) {
  Scenario a = experiment("a", 1);
  a.robot.joints[0].controller = {.kp = 1e4, .kd = 0, .torque_limit = 0};
  EXPECT_NE(refusal_of(a).find("motor 1 turns faster than 100000 rad/s at 0.0"), std::string::npos) << refusal_of(a);
}

}  // namespace
}  // namespace halyard
