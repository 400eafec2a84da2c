// Input that is well formed and cannot be meant: one line that says where and what, and exit code 2.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/input_error.h"
#include "tests/app/bad_input.h"

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

TEST_F(BadInput, AModelThatNoArmCanHave) {
  struct Case {
    const char *from, *to;
    std::vector<std::string> parts;
  };
  const std::vector<Case> cases = {
      {"inertia=\"3.0309e-3 1.4398e-3 1.6716e-3 0.0286e-3 -0.0762e-3 -1.2880e-3\"",
       "inertia=\"1e-3 1e-3 4e-3 0 0 0\"",
       {"<link inertia=", "expected none above the sum of the other two", "check the entries"}},
      {"mass=\"0.503\"", "mass=\"-0.503\"", {"<link mass=\"-0.503\">: expected a number of at least 0"}},
      {"gear_ratio=\"12.25\"", "gear_ratio=\"0\"", {"<motor gear_ratio=\"0\">: expected a number greater than 0"}},
      {"coefficient=\"0.007797\"",
       "coefficient=\"1e18\"",
       {"coupling matrix [3 x 3] has rank", "correct the coupling coefficients"}},
      {"home=\"45 deg\"", "home=\"100 deg\"", {"<range home=\"100 deg\">: expected a position from lower to upper"}},
      {"lower=\"0 deg\"", "lower=\"91 deg\"", {"<range upper=", "expected an upper end above the lower one"}}};
  for (const Case& c : cases) {
    write_text(path("bad.xml"), replaced(text_of(example("raven2.xml")), c.from, c.to));
    std::vector<std::string> parts = c.parts;
    parts.push_back("bad.xml:");
    expect_refused({"check", "bad.xml"}, parts);
    expect_refused({"diagnose", "--model", "bad.xml", "--data", "log.csv", "--out", "out"}, parts);
  }
}

TEST_F(BadInput, AScenarioWithoutTime) {
  const std::string scenario = text_of(path("experiment_a.xml"));
  for (const auto& [to, part] : std::vector<std::pair<std::string, std::string>>{
           {"duration=\"0\"", "bad.xml:4: <scenario duration=\"0\">: expected a number greater than 0"},
           {"duration=\"1e-6\"",
            "bad.xml: scenario 'A: high tension': the duration must be at least one control period"}}) {
    write_text(path("bad.xml"), replaced(scenario, "duration=\"0.1\"", to));
    expect_refused({"check", "bad.xml"}, {part});
    expect_refused({"simulate", "bad.xml", "--out", "new.csv"}, {part});
  }
  write_text(path("bad.xml"), replaced(scenario, "<control period=\"0.001\"", "<control period=\"0\""));
  expect_refused({"check", "bad.xml"}, {"<control period=\"0\">: expected a number greater than 0"});
}

TEST_F(BadInput, ALogInOtherUnitsOrOfAnArmThatIsOff) {
  write_moving_log();
  const ChangedLog moving(lines_of(text_of(path("moving.csv"))));
  const auto expect_found = [&](const std::string& text, const std::vector<std::string>& parts) {
    write_text(path("bad.csv"), text);
    const RunResult check = run({"check", "bad.csv", "--model", "raven2.xml"});
    EXPECT_EQ(check.exit_code, 2);
    for (const std::string& part : parts) EXPECT_TRUE(contains(check.err, part)) << check.err;
    expect_refused({"diagnose", "--model", "raven2.xml", "--data", "bad.csv", "--out", "out"}, parts);
  };
  const auto times = [](double factor) { return [factor](double x) { return factor * x; }; };
  expect_found(moving.with({"time"}, times(1e3)), {"bad.csv: time:", "milliseconds", "unit=ms"});
  expect_found(moving.with({"motor_position_1"}, times(180 / 3.14159265)),
               {"bad.csv: motor_position_1:", "degrees", "unit=deg"});
  expect_found(moving.with({"motor_torque_1", "motor_torque_2", "motor_torque_3", "motor_position_1",
                            "motor_position_2", "motor_position_3"},
                           times(0)),
               {"bad.csv: motor_position_1:", "switched off", "give a record in which the motors move"});
}

}  // namespace
}  // namespace halyard::testing_program
