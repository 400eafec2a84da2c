#include "plant/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "plant/trajectory.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::string kExamples = HALYARD_SOURCE_DIR "/examples/raven2/";

Scenario experiment(const std::string& letter, double duration) {
  Scenario s = read_scenario(kExamples + "experiment_" + letter + ".xml");
  s.duration_s = duration;
  return s;
}

/// What simulate() says of a scenario that it refuses.
std::string refusal(const Scenario& scenario) {
  try {
    simulate(scenario);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// Writes files into a folder of its own and reads a scenario from there.
class ScenarioFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("scenario_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// A scenario of the RAVEN-II with these elements inside, one second long.
  Scenario read(const std::string& inside, const std::string& attributes = "duration=\"1\"") const {
    write("s.xml", "<scenario name=\"s\" model=\"" + kExamples + "raven2.xml\" " + attributes + ">\n" + inside +
                       "\n</scenario>\n");
    return read_scenario(folder_ / "s.xml");
  }

  std::string message(const std::string& inside, const std::string& attributes = "duration=\"1\"") const {
    try {
      read(inside, attributes);
    } catch (const InputError& error) {
      std::string what = error.what();
      const std::string folder = folder_.string() + "/";
      for (auto at = what.find(folder); at != what.npos; at = what.find(folder)) what.erase(at, folder.size());
      return what;
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST(Experiments, AreThoseOfThePaper) {
  const Scenario a = experiment("a", 20), b = experiment("b", 20), c = experiment("c", 20);
  EXPECT_EQ(a.robot.nominal.joint[0].tension, 51.0);
  EXPECT_EQ(b.robot.nominal.joint[0].tension, 27.5);
  EXPECT_EQ(b.robot.nominal.joint[1].tension, 17.7);
  EXPECT_EQ(b.robot.nominal.joint[2].tension, 13.7);
  EXPECT_EQ(b.assumed->joint[0].tension, 51.0);  // the controller has the model's numbers
  ASSERT_EQ(c.robot.effects.size(), 1u);
  EXPECT_EQ(c.robot.effects[0].effect->name(), "payload");
  EXPECT_EQ(c.robot.effects[0].p[0], 0.1);
  for (const Scenario* s : {&a, &b, &c}) {
    EXPECT_EQ(s->trajectory[1].sines.at(0).frequency_hz, 0.3852);
    EXPECT_DOUBLE_EQ(s->trajectory[1].center, 90 * kDegree);
    EXPECT_DOUBLE_EQ(s->trajectory[2].sines.at(0).amplitude, 0.040);
    EXPECT_EQ(s->control_period_s, 1e-3);
    EXPECT_EQ(s->integrator.kind, IntegratorKind::automatic);
    EXPECT_TRUE(s->quantise);
  }
}

TEST(Experiments, HaveARobotThatDiffersFromItsModelByLawAndEffectsAlone) {
  const Scenario c = read_scenario(kExamples + "experiment_c.xml", kExamples + "raven2_likely.xml");
  ArmModel likely = c.robot;
  ASSERT_FALSE(likely.effects.empty());
  EXPECT_EQ(likely.effects.back().effect->name(), "payload");  // the scenario's own, after the robot's
  const ArmModel model = read_model(kExamples + "raven2.xml");
  likely.name = model.name;
  likely.effects.clear();
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(likely.nominal.joint[k].law, CableLaw::linear);
    likely.nominal.joint[k].law = model.nominal.joint[k].law;
  }
  EXPECT_EQ(model_to_xml(likely), model_to_xml(model));
  EXPECT_EQ(c.assumed->joint[0].law, CableLaw::paper);
}

TEST(Experiments, AreHomedWhereTheyStart) {
  Scenario a = read_scenario(kExamples + "experiment_a.xml", kExamples + "raven2_likely.xml");
  a.duration_s = 0.01;
  a.quantise = false;
  std::erase_if(a.robot.effects, [](const PlacedEffect& e) { return e.effect->name() != "capstan_ratio"; });
  const auto told = [&](const Scenario& s) {
    const SimulationResult r = simulate(s);
    Eigen::VectorXd motors(3);
    for (int k = 0; k < 3; ++k) motors(k) = r.measured.motor_position[k][0];
    return unstretched_joints(*s.assumed, motors, Eigen::VectorXd::Zero(3));
  };
  // What gravity stretches is left: 0.04 deg, 0.23 deg, 0.22 mm at most.
  const Eigen::VectorXd error = told(a) - a.robot.home();
  EXPECT_LT(std::abs(error(0)), 0.05 * kDegree);
  EXPECT_LT(std::abs(error(1)), 0.3 * kDegree);
  EXPECT_LT(std::abs(error(2)), 0.3e-3);
  // A ratio larger by 5.64 % over 45 deg.
  a.homed = false;
  EXPECT_NEAR(told(a)(0) / a.robot.home()(0), 1 / 1.0564, 2e-3);
}

TEST(Experiments, NeedAControllerWhereAJointIsToMove) {
  Scenario a = experiment("a", 0.01);
  a.robot.joints[1].controller = {};
  EXPECT_NE(refusal(a).find("trajectory of joint 2: the joint has no controller that follows it"), std::string::npos)
      << refusal(a);
  a.trajectory[1] = {};
  a.trajectory[1].center = a.robot.joints[1].home;
  EXPECT_EQ(refusal(a), "") << "an arm without a motion to follow may fall";
}

TEST(Experiments, EndWhereTheControlledArmIsUnstable) {
  Scenario a = experiment("a", 1);
  a.robot.joints[0].controller = {.kp = 1e4, .kd = 0, .torque_limit = 0};
  EXPECT_NE(refusal(a).find("motor 1 turns faster than 100000 rad/s at 0.0"), std::string::npos) << refusal(a);
}

TEST_F(ScenarioFile, HasDefaultsAndKeepsUnnamedJointsAtHome) {
  const Scenario s = read("");
  EXPECT_EQ(s.seed, 1u);
  EXPECT_EQ(s.fade_in_s, 2);
  EXPECT_EQ(s.trajectory[0].kind, JointTrajectory::Kind::hold);
  EXPECT_DOUBLE_EQ(s.trajectory[0].center, 45 * kDegree);
  EXPECT_TRUE(s.noise.motor_torque.empty());
}

TEST_F(ScenarioFile, MayHaveACamera) {
  EXPECT_FALSE(read("").camera.has_value());
  const Scenario s = read(R"(<camera rate="60" latency="0.02" dropout="0.5"/>)");
  ASSERT_TRUE(s.camera.has_value());
  EXPECT_EQ(s.camera->rate_hz, 60);
  EXPECT_EQ(s.camera->latency_s, 0.02);
  EXPECT_EQ(s.camera->noise_m, 5e-4);
  EXPECT_EQ(s.camera->dropout, 0.5);
  EXPECT_EQ(message(R"(<camera dropout="2"/>)"),
            "s.xml:2: <camera dropout=\"2\">: expected a share of the frames, from 0 to 1");
}

TEST_F(ScenarioFile, MayGiveSamplesOfAnotherLog) {
  write("x.csv", "time,path\n5,0.7\n5.5,0.8\n6,\n6.5,0.9\n");
  const Scenario s = read(R"(<trajectory joint="1" kind="samples" file="x.csv" column="path"/>)");
  const JointTrajectory& t = s.trajectory[0];
  EXPECT_EQ(desired_position(t, 0, 0), 0.7);  // the first sample is the start
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 1.0), 0.85);  // a missing sample is bridged
  EXPECT_EQ(desired_position(t, 0, 9), 0.9);
}

TEST_F(ScenarioFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message(R"(<trajectory joint="4" kind="hold" center="0"/>)"),
            "s.xml:2: <trajectory joint=\"4\">: expected a whole number from 1 to 3");
  EXPECT_EQ(message(R"(<trajectory joint="1" kind="hold" center="100 deg"/>)"),
            "s.xml: scenario 's': trajectory of joint 1: asks for 1.745329 rad at 0.000000 s, outside the joint's "
            "range 0.000000 to 1.570796 rad; make it smaller or move its center");
  EXPECT_EQ(message("<trajectory joint=\"3\" kind=\"hold\" center=\"0.4\"/>\n"
                    "<trajectory joint=\"3\" kind=\"hold\" center=\"0.4\"/>"),
            "s.xml:3: <trajectory joint=\"3\">: another <trajectory> is of this joint; remove one of them");
  EXPECT_EQ(message(R"(<trajectory joint="1" kind="sines" center="45 deg"/>)"),
            "s.xml:2: <trajectory>: expected at least one <sine amplitude=\"\" frequency=\"\"/>");
  EXPECT_EQ(message(R"(<set parameter="joint1.cable.stiffness" value="-3"/>)"),
            "s.xml:2: <set value=\"-3\">: the model so changed:8: <cable stiffness=\"-3\">: expected a number greater "
            "than 0");
  EXPECT_EQ(
      message("<set parameter=\"joint1.link.mass\" value=\"3\"/>\n<set parameter=\"joint1.link.mass\" value=\"4\"/>"),
      "s.xml:3: <set parameter=\"joint1.link.mass\">: is set twice; remove one of the two");
  EXPECT_EQ(message(R"(<set parameter="joint1.cable.stifness" value="3"/>)"),
            "s.xml:2: <set parameter=\"joint1.cable.stifness\">: the model has no such number; expected one of "
            "joint1.link.mass, joint1.link.com.x, joint1.link.com.y, joint1.link.com.z, joint1.link.inertia, "
            "joint1.motor.inertia, joint1.motor.coulomb, joint1.motor.viscous, "
            "joint1.motor.smoothing, joint1.motor.gear_ratio, joint1.motor.capstan_radius, "
            "joint1.motor.torque_scale, joint1.motor.torque_bias, joint1.cable.stiffness, joint1.cable.damping, "
            "joint1.cable.tension, joint1.cable.pulley_radius, joint1.friction.coulomb, joint1.friction.viscous, "
            "joint1.friction.smoothing");
  EXPECT_EQ(message(R"(<integrator treatment="euler"/>)"),
            "s.xml:2: <integrator treatment=\"euler\">: expected one of rosenbrock, dirk, imex, imex_link1, bdf, "
            "explicit_rk, simbody_rkm, simbody_cpodes");
  EXPECT_EQ(message("", R"(engine="mujoco")"),
            "s.xml:1: <scenario engine=\"mujoco\">: expected one of simbody, halyard");
  EXPECT_EQ(message(R"(<integrator treatment="rosenbrock"/>)", R"(duration="1" engine="simbody")"), "no error");
  EXPECT_NE(message(R"(<integrator treatment="simbody_rkm"/>)", R"(engine="halyard")").find("needs engine=\"simbody\""),
            std::string::npos);
  EXPECT_NE(message(R"(<trajectory joint="1" kind="hold" centre="0"/>)").find("<trajectory centre="),
            std::string::npos);
  EXPECT_NE(message(R"(<control period="1e-12"/>)").find("at least 1e-6 s"), std::string::npos);
  EXPECT_NE(message(R"(<control period="2"/>)").find("the duration must be at least one control period"),
            std::string::npos);
  EXPECT_NE(message("", "duration=\"-1\"").find("s.xml:1: <scenario duration=\"-1\">"), std::string::npos);
  EXPECT_NE(message(R"(<effects><effect name="stickiness" joint="1"/></effects>)").find("unknown effect"),
            std::string::npos);
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

TEST_F(ScenarioFile, SaysWhatIsWrongWithASampleFile) {
  EXPECT_EQ(message(R"(<trajectory joint="1" kind="samples" file="x.csv"/>)"),
            "s.xml:2: <trajectory file=\"x.csv\">: x.csv: no such file; correct the path, which is relative to this "
            "file's folder");
  write("x.csv", "time,path\n0,1\n");
  EXPECT_EQ(message(R"(<trajectory joint="1" kind="samples" file="x.csv"/>)"),
            "s.xml:2: <trajectory>: x.csv has no column 'joint_position_1'; it has 'time', 'path'; give one of "
            "these as column");
  write("x.csv", "time,path\n0,1\n1,one\n");
  const std::string cell = message(R"(<trajectory joint="1" kind="samples" file="x.csv" column="path"/>)");
  EXPECT_NE(cell.find("x.csv:3: column 'path'"), std::string::npos) << cell;
}

TEST(Trajectory, OfSinesStartsAtItsCenterAtRest) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::sines;
  t.center = 0.5;
  t.sines = {{0.2, 0.4, 1.0}, {0.1, 0.9, 0}};
  EXPECT_EQ(desired_position(t, 2, 0), 0.5);
  // f(s) grows as 10 s³: within 1 ms by less than 2e-9 of the amplitudes.
  EXPECT_NEAR(desired_position(t, 2, 1e-3), 0.5, 2e-9);
  const double after = 7.3, w = 2 * std::numbers::pi * after;
  EXPECT_DOUBLE_EQ(desired_position(t, 2, after), 0.5 + 0.2 * std::sin(0.4 * w + 1.0) + 0.1 * std::sin(0.9 * w));
}

TEST(Trajectory, BetweenPointsMovesWithMinimumJerkAndDwells) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::point_to_point;
  t.points = {1, 2, 4};
  t.move_s = 1;
  t.dwell_s = 0.5;
  EXPECT_EQ(desired_position(t, 0, 0), 1);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 0.5), 1.5);  // half way at half time
  EXPECT_EQ(desired_position(t, 0, 1.2), 2);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 2.0), 3);
  EXPECT_DOUBLE_EQ(desired_position(t, 0, 3.5), 2.5);  // from the last point to the first
  EXPECT_EQ(desired_position(t, 0, 4.5), 1);
  // Peak speed of a minimum-jerk move is 15/8 of the mean.
  EXPECT_NEAR((desired_position(t, 0, 0.5 + 1e-4) - desired_position(t, 0, 0.5 - 1e-4)) / 2e-4, 15.0 / 8, 1e-6);
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
    const double lost = log.joint_position[k][i] - unstretched_joints(*scenario.assumed, q_m, q_m)(k);
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
  const double wanted = unstretched_motors(*scenario.assumed, scenario.robot.home())(0);
  EXPECT_NEAR(log.motor_position[0][0], wanted / 1.05, 1e-3 * wanted);
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
    EXPECT_EQ(what.substr(0, 64), "scenario 'A: high tension': joint 2: no stretch of its cable giv");
  }
}

}  // namespace
}  // namespace halyard
