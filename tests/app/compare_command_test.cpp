// halyard compare, end to end on short runs of the RAVEN-II.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/app_runs.h"

namespace halyard::testing_program {
namespace {

using nlohmann::json;

TEST_F(App, CompareJudgesEstimatorsByTheTruthOfASimulatedScenario) {
  write_short_scenario("experiment_a.xml", "1.5");
  const std::string printed = done(
      {"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics,sr_ukf", "--out", "cmp"});
  EXPECT_TRUE(contains(printed, "us a step")) << printed;
  const auto files = files_in(path("cmp"));
  ASSERT_EQ(files.size(), 3u);
  const json result = json::parse(files.at("comparison.json"));
  EXPECT_EQ(result.at("truth"), "truth of the simulation");
  const json &kinematics = result.at("estimators").at(0), &sr_ukf = result.at("estimators").at(1);
  const CsvFile table(path("cmp/comparison.csv"));
  for (int k = 0; k < 3; ++k) {
    const json &naive = kinematics.at("joints").at(k), &filter = sr_ukf.at("joints").at(k);
    EXPECT_EQ(filter.at("samples"), 1001);  // 0.5 .. 1.5 s
    const double gain =
        1 - filter.at("mean_absolute_error").get<double>() / naive.at("mean_absolute_error").get<double>();
    EXPECT_DOUBLE_EQ(filter.at("improvement_over_kinematics").get<double>(), gain);
    // The model is right, the cables stretch: a filter that knows it must gain most of kinematics' error.
    EXPECT_GT(gain, 0.5) << "joint " << k + 1;
    const double mean = filter.at("mean_absolute_error"), rms = filter.at("rms_error"), peak = filter.at("peak_error");
    EXPECT_TRUE(std::abs(filter.at("bias").get<double>()) <= mean && mean <= rms && rms <= peak);
    const std::size_t row = table.row_with({{"estimator", "sr_ukf"}, {"joint", std::to_string(k + 1)}});
    EXPECT_NEAR(table.number(row, "rms_error"), rms, 1e-8 * rms);  // 9 digits
  }
  const std::string& report = files.at("report.html");
  EXPECT_TRUE(contains(report, "Eq. 18"));
  EXPECT_TRUE(contains(report, "Joint 3: errors"));
}

TEST_F(App, CompareSaysWhichIsBetterAndWhetherEachKnowsHowFarOffItIs) {
  write_short_scenario("experiment_a.xml", "1.5");
  const std::vector<std::string> ask = {"compare", "experiment_a.xml", "--estimators", "kinematics,ekf", "--runs",
                                        "3",       "--noise"};
  const auto run = [&](const std::string& noise) {
    std::vector<std::string> arguments = ask;
    for (const std::string& more : {noise, std::string("--out"), "noise_" + noise}) arguments.push_back(more);
    done(arguments);
    return json::parse(text_of(path("noise_" + noise + "/comparison.json")));
  };
  const json right = run("1"), ten = run("10");
  for (int k = 0; k < 3; ++k) {
    const json& pair = right.at("paired").at(k);
    EXPECT_EQ(pair.at("verdict"), "better") << "joint " << k + 1;
    EXPECT_LT(pair.at("ci95").at(1), 0.5);
    EXPECT_EQ(right.at("estimators").at(0).at("joints").at(k).at("nees").at("verdict"), "none");
    const json& of_ten = ten.at("monte_carlo").at("estimators").at(1).at("joints").at(k);
    EXPECT_EQ(of_ten.at("nees").at("verdict"), "too sure") << "joint " << k + 1;
    EXPECT_LT(of_ten.at("instants_in_band"), 0.5);
  }
  const json& ekf = right.at("monte_carlo").at("estimators").at(1);
  EXPECT_EQ(ekf.at("failures"), 0);
  EXPECT_NEAR(ekf.at("nis").at("mean"), 1, 0.1);
  EXPECT_GT(ten.at("monte_carlo").at("estimators").at(1).at("nis").at("mean"), 10);
  EXPECT_TRUE(contains(text_of(path("noise_1/report.html")), "3 runs with seeds of their own"));
}

TEST_F(App, CompareLimitsTheStepsInAllItsRuns) {
  write_short_scenario("experiment_a.xml", "0.6");
  const RunResult result =
      run({"compare", "experiment_a.xml", "--estimators", "kinematics," HALYARD_BROKEN_PLUGINS "/never_returns.so",
           "--runs", "2", "--step-limit", "2", "--out", "cmp"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json never = json::parse(text_of(path("cmp/comparison.json"))).at("monte_carlo").at("estimators").at(1);
  EXPECT_EQ(never.at("failures"), 2);
  EXPECT_TRUE(contains(never.at("first_failure").get<std::string>(), "took more than 2 s")) << never;
}

TEST_F(App, TheSameComparisonGivesTheSameBytes) {
  write_short_scenario("experiment_a.xml", "0.6");
  for (const char* out : {"1", "2"}) {
    done({"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics,ekf,sr_ukf", "--runs",
          "2", "--out", out});
  }
  EXPECT_TRUE(files_in(path("1")) == files_in(path("2")));
}

TEST_F(App, CompareTakesALogAndAPluginByItsPath) {
  simulate_log();
  fs::copy(fs::path(HALYARD_PROGRAM).parent_path() / "plugins/kinematics.so", path("mine.so"));
  done({"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics,./mine.so", "--out", "cmp"});
  const json result = json::parse(text_of(path("cmp/comparison.json")));
  EXPECT_EQ(result.at("truth"), "joint sensors");
  const json &named = result.at("estimators").at(0), &loaded = result.at("estimators").at(1);
  EXPECT_EQ(loaded.at("estimator"), "./mine.so");
  EXPECT_EQ(loaded.at("joints").at(1).at("rms_error"), named.at("joints").at(1).at("rms_error"));
}

TEST_F(App, ComparePutsWhatIsWrongWithALogOnItsPage) {
  simulate_log();
  const std::vector<std::string> reversed = {
      "compare",    "log.csv", "--model", "raven2.xml", "--estimators",
      "kinematics", "--out",   "cmp",     "--column",   "motor_position_2=motor_position_2,scale=-1"};
  EXPECT_TRUE(contains(done(reversed), "warning: log.csv: motor_position_2: is reversed"));
  const json wrong = json::parse(text_of(path("cmp/comparison.json"))).at("wrong_columns");
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_TRUE(contains(wrong.at(0).get<std::string>(), "motor_position_2: is reversed"));
  EXPECT_TRUE(contains(text_of(path("cmp/report.html")), "motor_position_2: is reversed"));
  done({"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "right"});
  EXPECT_TRUE(json::parse(text_of(path("right/comparison.json"))).at("wrong_columns").empty());
}

TEST_F(App, CompareSaysByHowMuchAnEstimatorIsWorse) {
  simulate_log();
  // Takes a motor's angle for that of its joint.
  fs::copy(fs::path(HALYARD_BROKEN_PLUGINS) / "well_formed.so", path("mine.so"));
  const std::string printed =
      done({"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics,./mine.so", "--out", "cmp"});
  EXPECT_TRUE(contains(printed, " % worse than kinematics")) << printed;
  EXPECT_FALSE(contains(printed, "better than kinematics")) << printed;
}

TEST_F(App, CompareGivesEachMotorItsInnovationsThoughAJointBeforeItHasNone) {
  write_short_scenario("experiment_a.xml", "1.5");
  const std::string arm = text_of(path("raven2.xml"));
  const std::size_t motor = arm.find("<motor"), friction = arm.find("<friction"), control = arm.find("<controller");
  ASSERT_LT(motor, friction);
  // The first joint swings freely, about an axis along which gravity pulls, and no other's cable passes it.
  std::string swinging = arm;
  swinging.erase(control, arm.find("/>", control) + 2 - control);
  swinging.replace(motor, friction - motor, "");
  swinging = replaced(swinging, "drive=\"cable\"", "drive=\"none\"");
  swinging = replaced(replaced(swinging, "motor_counts=\"4000\" ", ""), "-9.81 0 0", "0 0 -9.81");
  for (const char* coefficient : {"0.14545", "0.007797"})
    swinging = replaced(swinging, "<coupling joint=\"1\" coefficient=\"" + std::string(coefficient) + "\"/>", "");
  done({"simulate", "experiment_a.xml", "--out", "driven.csv"});
  write_text(path("raven2.xml"), swinging);
  done({"simulate", "experiment_a.xml", "--out", "swinging.csv"});
  const std::vector<std::string> columns = CsvFile(path("swinging.csv")).header;
  EXPECT_EQ(std::ranges::count(columns, "motor_position_1"), 0);
  EXPECT_EQ(std::ranges::count(columns, "motor_torque_3"), 1);
  for (const std::string data : {"experiment_a.xml", "swinging.csv", "driven.csv"}) {
    done({"compare", data, "--model", "raven2.xml", "--estimators", "sr_ukf", "--out", "cmp"});
    const std::string report = text_of(path("cmp/report.html"));
    EXPECT_FALSE(contains(report, "innovation of motor 1 in time")) << data;
    EXPECT_TRUE(contains(report, "innovation of motor 2 in time")) << data;
    EXPECT_TRUE(contains(report, "innovation of motor 3 in time")) << data;
  }
  write_text(path("driven.xml"), arm);
  const RunResult other =
      run({"compare", "experiment_a.xml", "--model", "driven.xml", "--estimators", "sr_ukf", "--out", "other"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(other.err,
            "driven.xml: its joints are not those of the scenario's robot; give a model with as many "
            "joints, of the same types and driven alike\n");
}

TEST_F(App, CompareOfALogWithoutJointSensorsSaysThatThereIsNothingToJudgeBy) {
  simulate_log();
  const std::vector<std::string> motors(kLogColumns.begin(), kLogColumns.begin() + 7);
  rewrite("log.csv", "motors.csv", motors, motors, as_is);
  done({"compare", "motors.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "cmp"});
  const json result = json::parse(text_of(path("cmp/comparison.json")));
  EXPECT_TRUE(result.at("truth").is_null());
  EXPECT_TRUE(result.at("estimators").at(0).at("joints").at(0).at("rms_error").is_null());
  EXPECT_TRUE(contains(text_of(path("cmp/report.html")), "nothing to judge them by"));
}

}  // namespace
}  // namespace halyard::testing_program
