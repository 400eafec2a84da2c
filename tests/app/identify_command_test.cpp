// halyard identify end to end: a coupling that the model has wrong, and effects that no coupling makes good.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program_run.h"

namespace halyard::testing_program {
namespace {

using nlohmann::json;

class IdentifyCommand : public ProgramTest {};

TEST_F(IdentifyCommand, WritesAModelThatOtherCommandsTake) {
  write_short_scenario("experiment_a.xml", "6");
  write_text(path("scenario.xml"),
             replaced(replaced(text_of(path("experiment_a.xml")), " homed=\"true\"", ""), "<trajectory joint=\"1\"",
                      "<set parameter=\"joint2.coupling.joint1\" value=\"0.152\"/><trajectory joint=\"1\""));
  done({"simulate", "scenario.xml", "--out", "log.csv"});
  write_text(path("log.csv"), replaced(text_of(path("log.csv")), "joint_position_3", "tool"));
  const std::string printed = done({"identify", "--model", "raven2.xml", "--data", "log.csv", "--parameters",
                                    "coupling", "--out", "out", "--column", "joint_position_3=tool"});
  EXPECT_TRUE(contains(printed, "joint 2 coupling with joint 1: 0.14545 -> 0.15")) << printed;

  const json all = json::parse(text_of(path("out/identify.json")));
  EXPECT_EQ(all.at("adopted"), true);
  EXPECT_EQ(all.at("doubts"), json::array());
  ASSERT_EQ(all.at("parameters").size(), 3u);
  const json& c01 = all.at("parameters").at(0);
  EXPECT_EQ(c01.at("name"), "joint 2 coupling with joint 1");
  EXPECT_EQ(c01.at("joint"), 2);
  EXPECT_EQ(c01.at("unit"), "1");
  EXPECT_EQ(c01.at("from"), 0.14545);
  EXPECT_EQ(c01.at("convergence"), "converged");
  EXPECT_NEAR(c01.at("value"), 0.152, 1e-4);
  EXPECT_LT(c01.at("ci95").at(0), c01.at("value"));
  EXPECT_GT(c01.at("ci95").at(1), c01.at("value"));
  const json& rms = all.at("error").at("joint_position_rms").at("sr_ukf");
  EXPECT_LT(rms.at("after").at(1), 0.1 * rms.at("before").at(1).get<double>());

  const CsvFile convergence(path("out/convergence.csv"));
  EXPECT_EQ(convergence.header.size(), 7u);
  EXPECT_LE(convergence.rows.size(), 1001u);
  const std::vector<double> c = convergence.column("joint2.coupling.joint1");
  EXPECT_EQ(c.front(), 0.14545);
  EXPECT_NEAR(c.back(), 0.152, 1e-3);
  const std::vector<double> deviation = convergence.column("joint2.coupling.joint1.std");
  EXPECT_LT(deviation.back(), 0.01 * deviation.front());

  done({"check", "out/model.xml"});
  EXPECT_TRUE(contains(done({"check", "log.csv", "--model", "out/model.xml"}), "nothing suspicious"));
  EXPECT_TRUE(contains(text_of(path("out/model.xml")), "coefficient=\"0.15"));
  EXPECT_TRUE(contains(text_of(path("out/report.html")), "Joint 2 coupling with joint 1: converged."));
}

TEST_F(IdentifyCommand, KeepsTheGivenNumbersIfOthersPredictWorse) {
  const std::string scenario = text_of(example("calibration.xml"));
  write_text(path("calibration.xml"), replaced(scenario, "duration=\"15\"", "duration=\"5\""));
  fs::copy(example("raven2.xml"), path("raven2.xml"));
  done({"simulate", "calibration.xml", "--robot", example("raven2_likely.xml"), "--out", "log.csv"});
  const std::string printed =
      done({"identify", "--model", "raven2.xml", "--data", "log.csv", "--parameters", "coupling", "--out", "out"});
  EXPECT_TRUE(contains(printed, "sr_ukf with the identified numbers is worse on the hold-out (joint 2 by ")) << printed;
  EXPECT_TRUE(contains(printed, "model.xml, with the given numbers: the identified ones predict the hold-out worse\n"))
      << printed;

  const json all = json::parse(text_of(path("out/identify.json")));
  EXPECT_EQ(all.at("adopted"), false);
  const std::string doubts = all.at("doubts").dump();
  EXPECT_TRUE(contains(doubts, "times what its noise explains")) << doubts;
  EXPECT_TRUE(contains(doubts, "model.xml keeps the given ones")) << doubts;
  EXPECT_NE(all.at("parameters").at(0).at("value"), all.at("parameters").at(0).at("from"));
  const json& rms = all.at("error").at("joint_position_rms").at("sr_ukf");
  EXPECT_GT(rms.at("after").at(1), 1.1 * rms.at("before").at(1).get<double>());
  EXPECT_TRUE(contains(text_of(path("out/report.html")), "model.xml keeps the given ones"));

  // The same estimates by the model that was written as by the one that was given.
  done({"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "given.csv"});
  done({"estimate", "--model", "out/model.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "kept.csv"});
  EXPECT_EQ(CsvFile(path("kept.csv")).rows, CsvFile(path("given.csv")).rows);
}

}  // namespace
}  // namespace halyard::testing_program
