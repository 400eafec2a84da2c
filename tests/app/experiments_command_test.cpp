// halyard experiments, end to end on short runs of the RAVEN-II.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/app_runs.h"

namespace halyard::testing_program {
namespace {

using nlohmann::json;

/// The folder raven2 with the experiments and a robot that has one of the likely robot's effects, at joint 2.
class Experiments : public App {
 protected:
  void SetUp() override {
    App::SetUp();
    for (const char* name : {"experiment_a.xml", "experiment_b.xml", "experiment_c.xml", "raven2.xml"})
      write_text(path(std::string("raven2/") + name), text_of(example(name)));
    write_text(path("raven2/raven2_likely.xml"),
               replaced(text_of(example("raven2.xml")), "</arm>",
                        "<effects><effect name=\"stiffness\" joint=\"2\" stiffness_ratio=\"0.5\"/></effects></arm>"));
  }
};

TEST_F(Experiments, StandBesideThePublishedErrors) {
  const std::string printed = done({"experiments", "--examples", ".", "--duration", "0.7", "--no-effect-study",
                                    "--calibrated", "raven2/raven2.xml", "--out", "out"});
  EXPECT_TRUE(contains(printed, "sr_ukf")) << printed;
  EXPECT_TRUE(contains(printed, "joint 1 < joint 2 < joint 3")) << printed;
  const auto files = files_in(path("out"));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(lines_of(files.at("experiments.csv")).size(), 1u + 3 * 5 * 3);
  const json result = json::parse(files.at("experiments.json"));
  const json& published = result.at("measured_on_the_robot").at(0).at("mean_absolute_error");
  EXPECT_NEAR(published.at(1).get<double>(), 2.6383 * M_PI / 180, 1e-12);  // rounding
  EXPECT_DOUBLE_EQ(published.at(2).get<double>(), 2.507e-3);
  double sum = 0;
  for (const json& e : result.at("experiments")) {
    sum += e.at("estimators").at(0).at("joints").at(1).at("mean_absolute_error").get<double>();
  }
  EXPECT_NEAR(result.at("mean_of_experiments").at(0).at("mean_absolute_error").at(1).get<double>(), sum / 3, 1e-15);
  EXPECT_TRUE(contains(files.at("report.html"), "2.638"));
  EXPECT_TRUE(contains(files.at("report.html"), "What the numbers mean"));
}

TEST_F(Experiments, RunACalibratedModelBesideTheGivenOne) {
  // The robot itself: the filter then knows the stretch, which kinematics leaves out whatever the stiffness.
  done({"experiments", "--examples", ".", "--duration", "1.5", "--no-effect-study", "--calibrated",
        "raven2/raven2_likely.xml", "--out", "out"});
  const json means = json::parse(text_of(path("out/experiments.json"))).at("mean_of_experiments");
  std::map<std::string, double> error;
  for (const json& row : means)
    error[row.at("estimator").get<std::string>()] = row.at("mean_absolute_error").at(1).get<double>();
  ASSERT_EQ(error.size(), 5u) << means.dump(2);
  EXPECT_LT(error.at("sr_ukf, calibrated"), 0.1 * error.at("sr_ukf"));
  EXPECT_EQ(error.at("kinematics, calibrated"), error.at("kinematics"));
}

TEST_F(Experiments, TellWhichEffectMakesTheError) {
  done({"experiments", "--examples", ".", "--duration", "0.6", "--calibrated", "raven2/raven2.xml", "--out", "out"});
  const CsvFile table(path("out/effects.csv"));
  const auto error = [&](const char* effects, const char* estimator) {
    return table.number(table.row_with({{"effects", effects}, {"estimator", estimator}, {"joint", "2"}}),
                        "mean_absolute_error");
  };
  // None, two alone, all, all but each of two; two estimators, three joints.
  EXPECT_EQ(table.rows.size(), 6u * 2 * 3);
  // The payload is there in C alone, the cable in all three. What is switched off leaves what the other makes alone.
  EXPECT_EQ(error("all but stiffness", "kinematics"), error("payload alone", "kinematics"));
  EXPECT_EQ(error("all but payload", "sr_ukf"), error("stiffness alone", "sr_ukf"));
  EXPECT_GT(error("stiffness alone", "sr_ukf"), 10 * error("none", "sr_ukf"));
  // With all, as the experiments themselves.
  const json means = json::parse(text_of(path("out/experiments.json"))).at("mean_of_experiments");
  const double of_experiments = means.at(0).at("mean_absolute_error").at(1).get<double>();
  EXPECT_NEAR(error("all", "kinematics"), of_experiments, 1e-8 * of_experiments);  // 9 digits of CSV
}

TEST_F(Experiments, ACalibratedModelMayHaveARigidDrive) {
  std::string rigid = text_of(example("raven2.xml"));
  const std::size_t joint = rigid.find("drive=\"cable\"", rigid.find("drive=\"cable\"") + 1);
  rigid.replace(joint, 13, "drive=\"rigid\"");
  const std::size_t cable = rigid.find("<cable", joint);
  rigid.replace(cable, rigid.find("/>", cable) + 2 - cable, "<rigid pulley_radius=\"0.02\"/>");
  write_text(path("rigid.xml"), rigid);
  done({"experiments", "--examples", ".", "--duration", "0.7", "--no-effect-study", "--calibrated", "rigid.xml",
        "--out", "out"});
  EXPECT_EQ(files_in(path("out")).size(), 3u);
}

TEST_F(Experiments, ACalibratedModelOfAnotherArmIsRefused) {
  write_text(path("turning.xml"), replaced(text_of(example("raven2.xml")), "type=\"prismatic\"", "type=\"revolute\""));
  const RunResult result = run({"experiments", "--examples", ".", "--duration", "0.7", "--no-effect-study",
                                "--calibrated", "turning.xml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "turning.xml: its joints are not of the RAVEN-II's types")) << result.err;
}

TEST_F(Experiments, ADurationWithoutACountedErrorIsRefused) {
  const RunResult result = run({"experiments", "--examples", ".", "--duration", "0.3", "--no-effect-study",
                                "--calibrated", "raven2/raven2.xml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "--duration 0.3: expected more than 0.5 s")) << result.err;
}

}  // namespace
}  // namespace halyard::testing_program
