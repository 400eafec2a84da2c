// Input that is well formed and cannot be meant: one line that says where and what, and exit code 2.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/input_error.h"
#include "tests/support/bad_input.h"

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

}  // namespace
}  // namespace halyard::testing_program
