// Input that is well formed and cannot be meant: one line that says where and what, and exit code 2.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/input_error.h"
#include "tests/support/bad_input.h"

namespace halyard::testing_program {
namespace {

/// A log whose columns are changed.
class ChangedLog {
 public:
  explicit ChangedLog(const std::vector<std::string>& lines) : lines_(lines) {}

  template <class Change>
  std::string with(const std::vector<std::string>& columns, const Change& change) const {
    std::string text;
    std::vector<bool> changed;
    for (const std::string& line : lines_) {
      if (line.starts_with('#')) continue;
      std::istringstream cells(line);
      std::string row;
      std::size_t i = 0;
      const bool header = changed.empty();
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (header) changed.push_back(std::ranges::find(columns, cell) != columns.end());
        else if (changed[i]) cell = std::to_string(change(std::stod(cell)));
        row += (i == 0 ? "" : ",") + cell;
      }
      text += row + "\n";
    }
    return text;
  }

 private:
  std::vector<std::string> lines_;
};

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

TEST_F(BadInput, ARunThatDoesNotFitIntoMemory) {
  write_text(path("long.xml"), replaced(text_of(path("experiment_a.xml")), "duration=\"0.1\"", "duration=\"1e9\""));
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"check", "long.xml"},
                                             {"simulate", "long.xml", "--out", "new.csv"},
                                             {"compare", "long.xml", "--estimators", "kinematics", "--out", "cmp"}})
    expect_refused(command, {"long.xml: scenario", "of memory", "take a shorter duration"});
}

TEST_F(BadInput, ALogThatDoesNotFitIntoMemory) {
  write_text(path("huge.csv"), "time\n");
  fs::resize_file(path("huge.csv"), std::uintmax_t(1) << 43);  // 8 TB, none of them on the disk
  const RunResult run =
      this->run({"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", "huge.csv", "--out", "e.csv"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(contains(run.err, "huge.csv: needs about 2.64e+04 GB of memory")) << run.err;
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
  const std::vector<std::string> lines = lines_of(text_of(path("moving.csv")));
  std::string spike;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t first = lines[i].find(','), second = lines[i].find(',', first + 1);
    spike += (i == 60 ? lines[i].substr(0, first) + ",1e6" + lines[i].substr(second) : lines[i]) + "\n";
  }
  write_text(path("spike.csv"), spike);
  const auto expect_blamed = [&](const std::string& data, const std::vector<std::string>& parts) {
    expect_refused({"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", data, "--out", "e.csv"},
                   parts);
    expect_refused({"compare", data, "--model", "raven2.xml", "--estimators", "ekf", "--out", "cmp"}, parts);
    const RunResult run =
        this->run({"compare", data, "--model", "raven2.xml", "--estimators", "kinematics,ekf", "--out", "cmp"});
    EXPECT_EQ(run.exit_code, 0);
    for (const std::string& part : parts) EXPECT_TRUE(contains(run.err, part)) << run.err;
    fs::remove_all(path("cmp"));
  };
  write_text(path("degrees.csv"), ChangedLog(lines).with({"motor_position_1", "motor_position_2", "motor_position_3"},
                                                         [](double x) { return 180 / 3.14159265 * x; }));
  expect_blamed("degrees.csv", {"degrees.csv: motor_position_1:", "as if it were degrees", "(estimator ekf on"});
  expect_blamed("spike.csv", {"spike.csv:61: motor_torque_1: 1e+06 N m at", "correct this cell", "(estimator ekf on"});
}

}  // namespace
}  // namespace halyard::testing_program
