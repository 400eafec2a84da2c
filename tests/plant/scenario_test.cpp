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

constexpr double kOneDegree = std::numbers::pi / 180;
const std::string kExamples = HALYARD_SOURCE_DIR "/examples/raven2/";

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
  const Scenario a = read_scenario(kExamples + "experiment_a.xml"), b = read_scenario(kExamples + "experiment_b.xml"),
                 c = read_scenario(kExamples + "experiment_c.xml");
  EXPECT_EQ(a.robot.nominal.joint[0].tension, 51.0);
  EXPECT_EQ(b.robot.nominal.joint[0].tension, 27.5);
  EXPECT_EQ(b.robot.nominal.joint[1].tension, 17.7);
  EXPECT_EQ(b.robot.nominal.joint[2].tension, 13.7);
  EXPECT_EQ(b.assumed->nominal.joint[0].tension, 51.0);  // the controller has the model's numbers
  ASSERT_EQ(c.robot.effects.size(), 1u);
  EXPECT_EQ(c.robot.effects[0].effect->name(), "payload");
  EXPECT_EQ(c.robot.effects[0].p[0], 0.1);
  for (const Scenario* s : {&a, &b, &c}) {
    EXPECT_EQ(s->trajectory[1].sines.at(0).frequency_hz, 0.3852);
    EXPECT_DOUBLE_EQ(s->trajectory[1].center, 90 * kOneDegree);
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
  EXPECT_EQ(c.assumed->nominal.joint[0].law, CableLaw::paper);
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
    return unstretched_joints(s.assumed->nominal, motors, Eigen::VectorXd::Zero(3));
  };
  // What gravity stretches is left: 0.04 deg, 0.23 deg, 0.22 mm at most.
  const Eigen::VectorXd error = told(a) - a.robot.home();
  EXPECT_LT(std::abs(error(0)), 0.05 * kOneDegree);
  EXPECT_LT(std::abs(error(1)), 0.3 * kOneDegree);
  EXPECT_LT(std::abs(error(2)), 0.3e-3);
  // A ratio larger by 5.64 % over 45 deg.
  a.homed = false;
  EXPECT_NEAR(told(a)(0) / a.robot.home()(0), 1 / 1.0564, 2e-3);
}

TEST_F(ScenarioFile, HasDefaultsAndKeepsUnnamedJointsAtHome) {
  const Scenario s = read("");
  EXPECT_EQ(s.seed, 1u);
  EXPECT_EQ(s.fade_in_s, 2);
  EXPECT_EQ(s.trajectory[0].kind, JointTrajectory::Kind::hold);
  EXPECT_DOUBLE_EQ(s.trajectory[0].center, 45 * kOneDegree);
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
  const std::string massless = R"(<set parameter="joint1.link.mass" value="0"/>)",
                    without_inertia = R"(<set parameter="joint1.link.inertia" value="0"/>)";
  EXPECT_NE(message(massless), "no error") << "a link without mass that has an inertia";
  EXPECT_EQ(message(massless + without_inertia), "no error") << "both changes together are right";
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

TEST_F(ScenarioFile, ReadsTheColumnsOfASampleFileAsThoseOfALog) {
  for (const char* header : {"time,path", "\"time\",\"path\"", "\n\ntime,path", "  # of a robot\ntime,path",
                             "\xef\xbb\xbf"
                             "time,path",
                             "\xef\xbb\xbf# of a robot\ntime,path"}) {
    write("x.csv", header + std::string("\n0,0.5\n1,1\n"));
    const Scenario s = read(R"(<trajectory joint="1" kind="samples" file="x.csv" column="path"/>)");
    EXPECT_EQ(s.trajectory[0].sample_position, (std::vector<double>{0.5, 1})) << header;
  }
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

TEST_F(ScenarioFile, RefusesTolerancesThatNoIntegratorKeeps) {
  const auto integrator = [this](const std::string& attributes) { return message("<integrator " + attributes + "/>"); };
  const std::string relative = "s.xml: scenario 's': the integrator's relative tolerance must be from 1e-14 to below 1";
  EXPECT_EQ(integrator(R"(treatment="simbody_rkm" relative_tolerance="1")"), relative);
  EXPECT_EQ(integrator(R"(treatment="simbody_cpodes" relative_tolerance="2")"), relative);
  EXPECT_EQ(integrator(R"(relative_tolerance="1e-20")"), relative);
  EXPECT_EQ(integrator(R"(absolute_tolerance="1e-300")"),
            "s.xml: scenario 's': the integrator's absolute tolerance must be at least 1e-15");
  EXPECT_EQ(integrator(R"(treatment="simbody_rkm" absolute_tolerance="1e-9")"),
            "s.xml:2: <integrator absolute_tolerance=\"1e-9\">: an integrator of Simbody's has only a relative "
            "tolerance; remove it");
  EXPECT_EQ(integrator(R"(treatment="simbody_rkm" relative_tolerance="0.9")"), "no error");
}

TEST_F(ScenarioFile, RefusesNoiseBeyondAnySensor) {
  EXPECT_EQ(message(R"(<sensors joint_position_noise="1e308"/>)"),
            "s.xml: scenario 's': the joint position noise must be from 0 to 1e6 in SI units");
  EXPECT_EQ(message(R"(<sensors torque_noise="0 1e300 0"/>)"),
            "s.xml: scenario 's': the torque noise must be from 0 to 1e6 in SI units");
}

TEST_F(ScenarioFile, RefusesMovesTooShortToBeCounted) {
  const auto moves = [this](const std::string& times) {
    return message("<trajectory joint=\"1\" kind=\"point_to_point\" points=\"0.5 0.6\" " + times + "/>");
  };
  EXPECT_EQ(moves(R"(move="1e-308" dwell="0")"),
            "s.xml: scenario 's': trajectory of joint 1: a move and its dwell must take at least 1e-6 s together");
  EXPECT_EQ(moves(R"(move="1e-308" dwell="1")"), "no error");
}

TEST_F(ScenarioFile, ItsEffectsActAfterThoseOfTheRobot) {
  ArmModel robot = read_model(kExamples + "raven2.xml");
  robot.effects = {place_neutral_effect(*find_effect("joint_friction"), robot.nominal, 1)};
  robot.effects[0].p[0] = -robot.nominal.joint[1].joint_coulomb;  // all of it
  write("robot.xml", model_to_xml(robot));
  const auto with = [this](const std::string& change) {
    read("<effects><effect name=\"joint_friction\" joint=\"2\" coulomb_change=\"" + change + "\"/></effects>");
    try {
      read_scenario(folder_ / "s.xml", folder_ / "robot.xml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(with("0.01"), "no error");
  EXPECT_EQ(with("-0.25"),
            (folder_ / "s.xml").string() +
                ":2: <effect>: with joint_friction of joint 2 after the effects before it, "
                "the coulomb of <friction> of joint 2 becomes -0.25, expected at least 0; make the change smaller, or "
                "remove one of the effects");
}

TEST_F(ScenarioFile, AnEffectThatMakesAnInertiaImpossibleIsNamed) {
  EXPECT_EQ(message(R"(<effects><effect name="payload" mass="-0.05"/></effects>)"),
            "s.xml: scenario 's': with payload the inertia of link 3 is that of no body; make the change smaller, or "
            "remove the effect");
  EXPECT_EQ(message(R"(<effects><effect name="payload" mass="-0.01"/></effects>)"), "no error");
}

}  // namespace
}  // namespace halyard
