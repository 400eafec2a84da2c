// The main job end to end, as ./run without arguments does it, but without recordings of real rigs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/support/program_run.h"

namespace halyard::testing_program {
namespace {

using nlohmann::json;

class Tour : public ProgramTest {};

std::vector<std::string> addresses_in(const std::string& html) {
  static const std::regex address("<a href=\"([^\"]*)\"");
  std::vector<std::string> all;
  for (std::sregex_iterator i(html.begin(), html.end(), address), end; i != end; ++i) all.push_back((*i)[1]);
  return all;
}

TEST_F(Tour, ShowsTheExperimentsAndFindsTheUndeclaredEffectWithoutAnyRecordings) {
  fs::create_directories(path("none"));
  const std::string printed = done({"tour", "--out", "out", "--recordings", "none"});

  const std::vector<std::string> lines = lines_of(printed);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.back(), "report: out/report.html");
  EXPECT_TRUE(contains(printed, "  simulated  sr_ukf ")) << printed;
  EXPECT_TRUE(contains(printed, "paper, Table IV, UKF")) << printed;
  std::size_t missing = 0;
  for (const std::string& line : lines) missing += contains(line, ": not at hand; examples/measured/");
  EXPECT_EQ(missing, 6u) << printed;

  std::set<std::string> names;
  for (const auto& [name, text] : files_in(path("out"))) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"experiments/experiments.csv", "experiments/experiments.json",
                                          "experiments/report.html", "report.html", "undeclared_effect/diagnosis.json",
                                          "undeclared_effect/model.xml", "undeclared_effect/report.html"}));
  const std::vector<std::string> addresses = addresses_in(text_of(path("out/report.html")));
  EXPECT_EQ(addresses.size(), 3u);
  for (const std::string& address : addresses) EXPECT_TRUE(fs::exists(path("out") / address)) << address;

  // The scenario of the log gives joint 2 a backlash of 0.2 mm. 5 % is half of what the model's own stiffness is known
  // to.
  const json diagnosis = json::parse(text_of(path("out/undeclared_effect/diagnosis.json")));
  ASSERT_EQ(diagnosis.at("effects").size(), 1u) << diagnosis.dump(2);
  const json& effect = diagnosis.at("effects").at(0);
  EXPECT_EQ(effect.at("effect"), "backlash");
  EXPECT_EQ(effect.at("joint"), 2);
  EXPECT_NEAR(effect.at("parameters").at("half_gap").at("value").get<double>(), 2e-4, 0.05 * 2e-4);
  const json& error = diagnosis.at("error").at("joint_position_rms");
  EXPECT_LT(error.at("after").at(1).get<double>(), 0.1 * error.at("before").at(1).get<double>());
  EXPECT_TRUE(contains(effect.at("why").get<std::string>(), "position residual of joint 2")) << effect.dump(2);
  for (const char* estimator : {"ekf", "sr_ukf"}) {
    const json& of = diagnosis.at("estimators").at(estimator).at("joint_position_rms");
    EXPECT_LT(of.at("after").at(1).get<double>(), 0.1 * of.at("before").at(1).get<double>()) << estimator;
  }
  EXPECT_TRUE(contains(done({"check", "out/undeclared_effect/model.xml"}), "effects: backlash of joint 2 (half_gap "));
}

TEST_F(Tour, SaysWhichFolderIsWrongBeforeItStarts) {
  const RunResult recordings = run({"tour", "--out", "out", "--recordings", "nowhere"});
  EXPECT_EQ(recordings.exit_code, 2);
  EXPECT_EQ(recordings.err,
            "halyard tour: --recordings 'nowhere': is no folder; give one with a folder for each rig\n");
  const RunResult examples = run({"tour", "--out", "out", "--examples", "nowhere"});
  EXPECT_EQ(examples.exit_code, 2);
  EXPECT_TRUE(contains(examples.err, "--examples 'nowhere': has no raven2/raven2.xml")) << examples.err;
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace halyard::testing_program
