// Each wrong file of the table is refused by every command that reads it: exit code 2, this one line on stderr, and no
// file left or changed.
#include <gtest/gtest.h>

#include "tests/app/bad_input/table_logs.h"
#include "tests/app/bad_input/table_models.h"
#include "tests/app/bad_input/table_scenarios.h"
#include "tests/app/bad_input/table_sweeps.h"

namespace halyard::testing_program {
namespace {

const std::string kSweep =
    "<sweep name=\"s\" scenario=\"experiment_a.xml\" skip=\"0\" estimators=\"kinematics\">\n"
    "<axis parameter=\"joint1.cable.stiffness\" values=\"1e5 2e5\"/>\n</sweep>\n";

std::vector<BadInputRow> all_rows() {
  std::vector<BadInputRow> rows = bad_models();
  for (const std::vector<BadInputRow>& more : {bad_scenarios(), bad_sweeps(), bad_logs()})
    rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

class BadInputTable : public BadInput, public ::testing::WithParamInterface<BadInputRow> {
 protected:
  static bool is_log(Wrong wrong) { return wrong == Wrong::log || wrong == Wrong::clock || wrong == Wrong::motion; }

  std::string right_text(Wrong wrong) const {
    switch (wrong) {
      case Wrong::model:
      case Wrong::options: return text_of(path("raven2.xml"));
      case Wrong::scenario: return text_of(path("experiment_a.xml"));
      case Wrong::sweep: return kSweep;
      case Wrong::log: return kHeader + kRows + "0.002,0,0,0,107,204,904\n";
      case Wrong::clock:
      case Wrong::motion: break;
    }
    write_moving_log("3");
    const std::string text = text_of(path("moving.csv"));
    fs::remove(path("moving.csv"));
    return text;
  }

  std::vector<std::vector<std::string>> commands(Wrong wrong) const {
    write_text(path("of_bad_model.xml"),
               replaced(replaced(kSweep, "estimators=", "model=\"bad.xml\" estimators="), "\"kinematics\"", "\"ekf\""));
    write_text(path("of_bad_scenario.xml"), replaced(kSweep, "experiment_a.xml", "bad.xml"));
    using Commands = std::vector<std::vector<std::string>>;
    switch (wrong) {
      case Wrong::options:
        return {{"check", "bad.xml"},
                {"estimate", "--model", "bad.xml", "--estimator", "ekf", "--data", "log.csv", "--out", "e.csv"},
                {"compare", "log.csv", "--model", "bad.xml", "--estimators", "ekf", "--skip", "0", "--out", "out"}};
      case Wrong::model: {
        Commands all = commands(Wrong::options);
        const Commands more = {
            {"check", "log.csv", "--model", "bad.xml"},
            {"simulate", "experiment_a.xml", "--robot", "bad.xml", "--out", "new.csv"},
            {"identify", "--model", "bad.xml", "--data", "log.csv", "--parameters", "coupling", "--out", "out"},
            {"diagnose", "--model", "bad.xml", "--data", "log.csv", "--out", "out"},
            {"diagnose", "--plan", "bad.xml", "experiment_a.xml", "--out", "out"},
            {"experiments", "--calibrated", "bad.xml", "--out", "out"},
            {"sweep", "of_bad_model.xml", "--out", "out"}};
        all.insert(all.end(), more.begin(), more.end());
        return all;
      }
      case Wrong::scenario:
        return {{"check", "bad.xml"},
                {"simulate", "bad.xml", "--out", "new.csv"},
                {"compare", "bad.xml", "--estimators", "ekf", "--skip", "0", "--out", "out"},
                {"diagnose", "--plan", "raven2.xml", "bad.xml", "--out", "out"},
                {"sweep", "of_bad_scenario.xml", "--out", "out"}};
      case Wrong::sweep: return {{"check", "bad.xml"}, {"sweep", "bad.xml", "--out", "out"}};
      case Wrong::log:
      case Wrong::clock: {
        Commands all = commands(Wrong::motion);
        const Commands more = {
            {"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", "bad.csv", "--out", "e.csv"},
            {"compare", "bad.csv", "--model", "raven2.xml", "--estimators", "ekf", "--skip", "0", "--out", "out"}};
        all.insert(all.end(), more.begin(), more.end());
        return all;
      }
      case Wrong::motion:
        return {{"check", "bad.csv", "--model", "raven2.xml"},
                {"diagnose", "--model", "raven2.xml", "--data", "bad.csv", "--out", "out"},
                {"identify", "--model", "raven2.xml", "--data", "bad.csv", "--parameters", "coupling", "--out", "out"}};
    }
    return {};
  }
};

TEST_P(BadInputTable, IsRefusedByEveryCommandThatReadsIt) {
  const BadInputRow& row = GetParam();
  const std::string file = is_log(row.wrong) ? "bad.csv" : "bad.xml";
  write_text(path(file), row.change(right_text(row.wrong)));
  for (const std::vector<std::string>& command : commands(row.wrong)) {
    std::string text;
    for (const std::string& argument : command) text += " " + argument;
    SCOPED_TRACE("halyard" + text);
    const auto before = files_in(folder_);
    const RunResult result = run(command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_LT(result.err.size(), kScreen);
    EXPECT_TRUE(is_like(result.err, row.line + "\n")) << result.err << "expected:\n" << row.line;
    EXPECT_TRUE(result.out.empty() || command.front() == "check") << result.out;  // check tells suspicions, too
    EXPECT_TRUE(files_in(folder_) == before) << "files were left or changed";
  }
}

std::string name_of(const ::testing::TestParamInfo<BadInputRow>& row) {
  const Wrong wrong = row.param.wrong;
  const char* kind = wrong <= Wrong::options    ? "Model"
                     : wrong == Wrong::scenario ? "Scenario"
                     : wrong == Wrong::sweep    ? "Sweep"
                                                : "Log";
  return std::string(kind) + row.param.name;
}

INSTANTIATE_TEST_SUITE_P(Files, BadInputTable, ::testing::ValuesIn(all_rows()), name_of);

}  // namespace
}  // namespace halyard::testing_program
