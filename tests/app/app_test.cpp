// The program as a whole: simulate, check, plugins, help and progress, end to end.
#include <gtest/gtest.h>
#include <pty.h>

#include <cmath>

#include "tests/support/app_runs.h"

namespace halyard::testing_program {
namespace {

TEST_F(App, SimulateWritesALogAndItsGroundTruth) {
  write_short_scenario("experiment_a.xml");
  const std::string printed = done({"simulate", "experiment_a.xml", "--out", "run/log.csv"});
  EXPECT_TRUE(contains(printed, "\"A: high tension\": 1001 samples, 1 s, 3 joints")) << printed;

  const CsvFile log(path("run/log.csv")), truth(path("run/log.truth.csv"));
  EXPECT_EQ(log.header, kLogColumns);
  std::vector<std::string> truth_columns = kLogColumns;
  truth_columns.insert(truth_columns.end(), {"joint_velocity_1", "joint_velocity_2", "joint_velocity_3"});
  EXPECT_EQ(truth.header, truth_columns);
  ASSERT_EQ(log.rows.size(), 1001u);
  EXPECT_EQ(log.column("time"), truth.column("time"));

  const double count = 2 * M_PI / 80000;  // rad of joint 1's encoder
  const std::vector<double> measured = log.column("joint_position_1"), exact = truth.column("joint_position_1");
  for (std::size_t i = 0; i < measured.size(); ++i) {
    // Rounded to the nearest count; 1e-8 for 9 printed digits.
    EXPECT_LE(std::abs(measured[i] - exact[i]), count / 2 + 1e-8);
  }
  EXPECT_NE(measured, exact);
}

TEST_F(App, TheSameSimulationGivesTheSameBytes) {
  write_short_scenario("experiment_c.xml", "0.3");
  done({"simulate", "experiment_c.xml", "--out", "1/log.csv"});
  done({"simulate", "experiment_c.xml", "--out", "2/log.csv"});
  EXPECT_TRUE(files_in(path("1")) == files_in(path("2")));
  EXPECT_EQ(files_in(path("1")).size(), 2u);
}

TEST_F(App, CheckTellsWhatAFileIs) {
  EXPECT_TRUE(contains(done({"check", example("raven2.xml")}), "valid model \"RAVEN-II\""));
  const std::string scenario = done({"check", example("experiment_c.xml")});
  EXPECT_TRUE(contains(scenario, "valid scenario \"C: payload\"")) << scenario;
  EXPECT_TRUE(contains(scenario, "effects: payload")) << scenario;
  EXPECT_TRUE(contains(done({"check", example("tension_sweep.xml")}), "14 points"));
}

TEST_F(App, CheckTellsAlsoTheValuesThatAnEffectOfTheFileLeavesOut) {
  EXPECT_TRUE(contains(done({"check", example("undeclared_effect.xml")}),
                       "effects: backlash of joint 2 (half_gap 0.0002 m, rounding 0 m)"));
}

TEST_F(App, CheckNotesARangeThatMayBeInDegrees) {
  const std::string model = text_of(example("raven2.xml"));
  EXPECT_FALSE(contains(done({"check", example("raven2.xml")}), "note:"));
  write_text(path("wide.xml"), replaced(model, "lower=\"0 deg\" upper=\"90 deg\"", "lower=\"0\" upper=\"90\""));
  EXPECT_TRUE(
      contains(done({"check", "wide.xml"}), "note: the range of joint 1 is 14.3 turns wide; if it is in degrees"));
}

TEST_F(App, CheckNotesAnArmThatTheFiltersWillRefuse) {
  const std::string model = text_of(example("raven2.xml"));
  const std::size_t friction = model.find("<friction"), smoothing = model.find("smoothing=\"", friction);
  ASSERT_NE(smoothing, model.npos);
  const std::size_t number = smoothing + std::string("smoothing=\"").size();
  write_text(path("sharp.xml"), model.substr(0, number) + "1e-9" + model.substr(model.find('"', number)));
  EXPECT_TRUE(contains(done({"check", "sharp.xml"}),
                       "note: the Kalman filters will refuse this arm: process model: a "
                       "step of 0.001 s would need"));
}

TEST_F(App, CheckMakesTheEstimatorsThatAModelHasOptionsFor) {
  write_short_scenario("experiment_a.xml");
  const std::string model = text_of(path("raven2.xml"));
  const auto with = [&](const std::string& estimator) { return replaced(model, "</arm>", estimator + "</arm>"); };
  write_text(path("raven2.xml"), with("<estimator name=\"ekf\" colour=\"blue\"/>"));
  EXPECT_TRUE(contains(run({"check", "experiment_a.xml"}).err, "raven2.xml: estimator ekf: unknown option 'colour'"));
  write_text(path("raven2.xml"), with("<estimator name=\"of_mine\" colour=\"blue\"/>"));
  EXPECT_TRUE(
      contains(done({"check", "raven2.xml"}), "not checked: options of estimators that are not installed: of_mine"));
}

TEST_F(App, CheckAcceptsEveryExample) {
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(HALYARD_SOURCE_DIR) / "examples/raven2")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_TRUE(contains(done({"check", entry.path().string()}), ": valid ")) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 7);
}

TEST_F(App, PluginsListsTheBuiltInEstimators) {
  const std::string printed = done({"plugins"});
  for (const char* name : {"kinematics ", "disturbance_sr_ukf ", "ekf ", "sr_ukf "})
    EXPECT_TRUE(contains("\n" + printed, std::string("\n") + name));
}

TEST_F(App, PluginsListsTheModulesThatItRefuses) {
  fs::create_directory(path("own"));
  fs::copy_file(HALYARD_BROKEN_PLUGINS "/crashes_in_table.so", path("own/crashes_in_table.so"));
  const RunResult result =
      run({"plugins"}, "HALYARD_PLUGIN_PATH='" + path("own").string() + "'; export HALYARD_PLUGIN_PATH;");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "\nekf ")) << result.out;
  EXPECT_TRUE(contains(result.out, "crashes_in_table.so: as it is opened: crashed: Segm")) << result.out;
}

TEST_F(App, HelpAndVersionGoToStdout) {
  const std::string help = done({"--help"});
  for (const char* command : {"simulate", "estimate", "compare", "sweep", "merge", "plugins", "check"}) {
    EXPECT_TRUE(contains(help, command));
  }
  EXPECT_TRUE(contains(done({"sweep", "--help"}), "--shard"));
  EXPECT_TRUE(done({"--version"}).starts_with("halyard "));
}

TEST_F(App, ProgressIsShownOnATerminalAndWipedAndNowhereElse) {
  write_short_scenario("experiment_a.xml", "4");
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    ::execl(HALYARD_PROGRAM, "halyard", "simulate", path("experiment_a.xml").c_str(), "--out", path("log.csv").c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ASSERT_GT(child, 0);
  std::string shown;
  char buffer[4096];
  for (ssize_t n; (n = ::read(terminal, buffer, sizeof buffer)) > 0;) shown.append(buffer, std::size_t(n));
  ::close(terminal);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  // Fraction, rate, time left; the line is wiped before the summary.
  EXPECT_TRUE(contains(shown, " %   ") && contains(shown, " s/s   ") && contains(shown, " s left")) << shown;
  EXPECT_TRUE(contains(shown, "\r\033[Kscenario \"A: high tension\"")) << shown;
  // done() sees to it that a pipe gets nothing.
  done({"simulate", "experiment_a.xml", "--out", "log.csv"});
}

}  // namespace
}  // namespace halyard::testing_program
