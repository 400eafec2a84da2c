// Arguments that do not fit: one line that names them, exit code 2, and no output.
#include <gtest/gtest.h>

#include "tests/app/bad_input/bad_input.h"
#include "tests/support/environment.h"

namespace halyard::testing_program {
namespace {

const std::string kCommands =
    "expected one of simulate, estimate, compare, diagnose, identify, experiments, sweep, merge, plugins, check, tour; "
    "see halyard --help";

TEST_F(BadInput, ACommandThatIsMissingOrUnknown) {
  expect_line({}, "halyard: a command is missing; " + kCommands);
  expect_line({"estimte"}, "halyard: no command 'estimte'; " + kCommands);
  expect_line({"--verbose"}, "halyard: The following argument was not expected: --verbose; see halyard --help");
}

TEST_F(BadInput, ArgumentsThatDoNotFit) {
  const auto expect_usage = [&](const std::vector<std::string>& arguments, const std::string& fault) {
    const std::string command = "halyard " + arguments.front();
    expect_line(arguments, command + ": " + fault + "; see " + command + " --help or halyard --help");
  };
  expect_usage({"simulate"}, "SCENARIO.xml is required");
  expect_usage({"simulate", "experiment_a.xml"}, "--out is required");
  expect_usage({"simulate", "experiment_a.xml", "--out"}, "--out: 1 required LOG.csv missing");
  expect_usage({"simulate", "experiment_a.xml", "more.xml", "--out", "new.csv"}, "more.xml was not expected");
  expect_usage({"simulate", "experiment_a.xml", "--out", "new.csv", "--fast"}, "--fast was not expected");
  expect_usage({"estimate", "--model", "raven2.xml", "--data", "log.csv", "--out", "e.csv"}, "--estimator is required");
  expect_usage({"estimate", "--model", "raven2.xml", "--data", "log.csv", "--estimators", "ekf", "--out", "e.csv"},
               "--estimators was not expected; did you mean --estimator?");
  expect_line({"--model", "raven2.xml", "estimate", "--data", "log.csv", "--estimator", "ekf", "--out", "e.csv"},
              "halyard estimate: --model stands before the command; give it behind halyard estimate; see halyard "
              "estimate --help or halyard --help");
  const std::vector<std::string> compare = {"compare", "log.csv", "--model", "raven2.xml", "--out", "cmp"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), compare.begin(), compare.end());
    return more;
  };
  expect_usage(with({"--estimators", "ekf", "--skip", "-1"}), "--skip: '-1': expected a finite number, at least 0");
  expect_line(with({"--estimators", "ekf,ekf", "--skip", "0"}),
              "estimators 'ekf,ekf': 'ekf' is listed twice; list it once");
  expect_line(with({"--estimators", ""}), "estimators '': an empty name; expected names with one comma between them");
  expect_line(with({"--estimators", "ekf", "--runs", "3"}),
              "halyard compare: --robot, --runs and --noise are for scenarios, and 'log.csv' is a log; leave them out");
  expect_line(with({"--estimators", "ekf", "--runs", "08"}),  // a decimal number
              "halyard compare: --robot, --runs and --noise are for scenarios, and 'log.csv' is a log; leave them out");
  expect_line({"compare", "experiment_a.xml", "--estimators", "ekf", "--out", "cmp", "--use-joint-torque"},
              "halyard compare: --use-joint-torque is for logs, and 'experiment_a.xml' is a scenario, which has no "
              "measured load; leave it out");
  expect_line({"compare", "log.csv", "--estimators", "kinematics", "--out", "cmp"},
              "halyard compare: --model is missing; a log needs the model file of its robot, --model M.xml");
  expect_line({"check", "raven2.xml", "--time-limit", "3"},
              "halyard check: --time-limit is for a module (.so), and 'raven2.xml' is none; leave it out");
  expect_line({"check", "ekf.so", "--column", "motor_position_1=x"},
              "halyard check: --column is for a log (.csv), and 'ekf.so' is a module; leave it out");
  const std::vector<std::string> diagnose = {"diagnose", "--model", "raven2.xml", "--data", "log.csv", "--out", "out"};
  const auto rehearsed = [&](std::vector<std::string> more) {
    more.insert(more.begin(), diagnose.begin(), diagnose.end());
    return more;
  };
  expect_usage(rehearsed({"--rehearse", "0"}), "--rehearse: '0': expected a whole number, at least 1, at most 10000");
  expect_usage(rehearsed({"--seed", "3"}), "--seed requires --rehearse");
  for (const std::string jobs : {"0", "many"})
    expect_usage({"sweep", "sweep.xml", "--out", "out", "--jobs", jobs},
                 "--jobs: '" + jobs + "': expected a whole number, at least 1, at most 1024");
}

// Each is longer than a screen, and expect_line() sees to it that no message is.
TEST_F(BadInput, ATextAsLongAsAFileIsShortenedInTheMessage) {
  const std::string text(100'000, 'x');
  expect_line({"estimate", "--model", text, "--estimator", "ekf", "--data", "log.csv", "--out", "e.csv"},
              "xxx{any}xxx: no such file; give the path of an XML file");
  expect_line({"simulate", "experiment_a.xml", "--out", "new.csv", "--" + text},
              "halyard simulate: --xxx{any}xxx was not expected; see halyard simulate --help or halyard --help");
  const Environment unknown("HALYARD_INSTRUCTION_SET", text);
  expect_line(
      {"--version"},
      "HALYARD_INSTRUCTION_SET is \"xxx{any}xxx\", expected generic, avx2 or avx512; unset it for the widest of "
      "this processor");
}

TEST_F(BadInput, ALineBreakInANameIsNoneInTheMessage) {
  expect_line({"simulate", "experiment\na.xml", "--out", "new.csv"},
              "experiment a.xml: no such file; give the path of an XML file");
}

}  // namespace
}  // namespace halyard::testing_program
