// Input that is well formed and cannot be meant: one line that says where and what, and exit code 2.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/input_error.h"
#include "tests/app/bad_input/table.h"

namespace halyard::testing_program {
namespace {

TEST_F(BadInput, ANumberThatIsNoneOrOutOfRange) {
  const std::vector<std::string> compare = {"compare", "experiment_a.xml", "--estimators", "kinematics", "--out",
                                            "out"};
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> options = {
      {compare, {"--step-limit", "--noise", "--runs", "--skip"}},
      {{"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", "log.csv", "--out", "e.csv"}, {"--skip"}},
      {{"experiments", "--out", "out"}, {"--duration"}},
      {{"sweep", "sweep.xml", "--out", "out"}, {"--jobs"}},
      {{"check", HALYARD_BROKEN_PLUGINS "/never_returns.so"}, {"--time-limit"}}};
  for (const auto& [command, names] : options)
    for (const std::string& name : names)
      for (const char* value : {"nan", "inf", "-1", "1e999", "many", "1s", ""}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {name, value});
        expect_refused(arguments, {name, in_quotes(value), "expected a", "number"});
      }
}

TEST_F(BadInput, ALogThatDoesNotFitIntoMemory) {
  write_text(path("huge.csv"), "time\n");
  fs::resize_file(path("huge.csv"), std::uintmax_t(1) << 43);  // 8 TB, none of them on the disk
  const RunResult run =
      this->run({"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", "huge.csv", "--out", "e.csv"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(contains(run.err, "huge.csv: needs about 9.68e+04 GB of memory")) << run.err;
}

TEST_F(BadInput, AnEstimatorThatRefusesTheLogEndsItsOwnRowOfTheComparison) {
  const std::string refuses = HALYARD_BROKEN_PLUGINS "/refuses_in_update.so";
  const std::string message =
      "estimator " + refuses +
      " on moving.csv at 0.002 s: refused: plugin fixture: at 0.002 s: the record is not for me";
  write_moving_log();
  const RunResult run = this->run(
      {"compare", "moving.csv", "--model", "raven2.xml", "--estimators", "kinematics," + refuses, "--out", "cmp"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, message + "\n");
  EXPECT_TRUE(contains(run.out, refuses + ": refused the data\n")) << run.out;
  const nlohmann::json result = nlohmann::json::parse(text_of(path("cmp/comparison.json"))).at("estimators");
  EXPECT_TRUE(result.at(0).at("failure").is_null());
  EXPECT_EQ(result.at(1).at("failure"), message);
  EXPECT_TRUE(contains(text_of(path("cmp/report.html")), "the record is not for me"));
  fs::remove_all(path("cmp"));
  expect_refused({"compare", "moving.csv", "--model", "raven2.xml", "--estimators", refuses, "--out", "cmp"},
                 {message});
  expect_refused(
      {"estimate", "--model", "raven2.xml", "--estimator", refuses, "--data", "moving.csv", "--out", "e.csv"},
      {message});
}

TEST_F(BadInput, AWrongNumberOfTheLogIsBlamedForTheFailureOfAnEstimator) {
  write_moving_log("3");
  const std::string log = text_of(path("moving.csv"));
  const auto expect_blamed = [&](const std::string& data, std::vector<std::string> parts) {
    expect_refused({"identify", "--model", "raven2.xml", "--data", data, "--parameters", "coupling", "--out", "out"},
                   parts);
    parts.push_back("(estimator ekf on");
    expect_refused({"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", data, "--out", "e.csv"},
                   parts);
    expect_refused({"compare", data, "--model", "raven2.xml", "--estimators", "ekf", "--out", "cmp"}, parts);
    const RunResult run =
        this->run({"compare", data, "--model", "raven2.xml", "--estimators", "kinematics,ekf", "--out", "cmp"});
    EXPECT_EQ(run.exit_code, 0);
    for (const std::string& part : parts) EXPECT_TRUE(contains(run.err, part)) << run.err;
    fs::remove_all(path("cmp"));
  };
  const std::vector<std::string> motors(kMotorColumns.begin() + 3, kMotorColumns.end());
  write_text(path("degrees.csv"), scaled(motors, 180 / std::numbers::pi)(log));
  write_text(path("spike.csv"), single("motor_torque_1", 60, 1e6)(log));
  expect_blamed("degrees.csv", {"degrees.csv: motor_position_1:", "as if it were degrees"});
  expect_blamed("spike.csv", {"spike.csv:62: motor_torque_1: 1e+06 N m at", "correct this cell"});
}

}  // namespace
}  // namespace halyard::testing_program
