#pragma once
/// What the tests of faults share: every command that writes, on small inputs, and runs that would go on for long.

#include <cstdlib>

#include "tests/support/app_runs.h"
#include "tests/support/background_run.h"

namespace halyard::testing_program {

using Arguments = std::vector<std::string>;
using Files = std::map<std::string, std::string>;

class Faults : public App {
 protected:
  void SetUp() override {
    App::SetUp();
    write_short_scenario("experiment_a.xml");
    done({"simulate", "experiment_a.xml", "--out", "sensed.csv"});
    rewrite("sensed.csv", "log.csv", motor_columns(), motor_columns(), as_is);
    write_text(path("sweep.xml"),
               "<sweep name=\"test\" scenario=\"experiment_a.xml\" estimators=\"kinematics\" duration=\"0.6\">"
               "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" from=\"0.5\" to=\"2\" steps=\"8\" "
               "scale=\"log\" applies_to=\"robot\"/></sweep>");
    // A Slurm that takes every job and has none: runs find it first.
    write_script("bin/sbatch", "echo 17");
    write_script("bin/squeue", "exit 0");
    ::setenv("PATH", (path("bin").string() + ":" + search_path_).c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", search_path_.c_str(), 1);
    App::TearDown();
  }

  static Arguments motor_columns() { return {kLogColumns.begin(), kLogColumns.begin() + 7}; }

  void write_script(const std::string& name, const std::string& text) const {
    write_text(path(name), "#!/bin/sh\n" + text + "\n");
    fs::permissions(path(name), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec |
                                    fs::perms::group_read | fs::perms::others_read);
  }

  /// Commands that write, with their outputs in out/, and the inputs that they need.
  std::vector<Arguments> quick_commands() const {
    write_parts_of_sweep();
    return {
        {"simulate", "experiment_a.xml", "--out", "out/log.csv"},
        {"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "out/e.csv"},
        {"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "out"},
        {"sweep", "sweep.xml", "--out", "out"},
        {"experiments", "--duration", "0.6", "--no-effect-study", "--calibrated", "raven2.xml", "--out", "out"},
        {"merge", "parts", "--out", "out"},
        {"sweep", "sweep.xml", "--slurm", "--nodes", "2", "--out", "out"}};
  }
  std::vector<Arguments> slow_commands() const {
    write_long_log();
    write_small_tour();
    return {{"identify", "--model", "raven2.xml", "--data", "long.csv", "--parameters", "coupling", "--out", "out"},
            {"diagnose", "--model", "raven2.xml", "--data", "long.csv", "--out", "out"},
            {"diagnose", "--plan", "axis/axis.xml", "axis/plan.xml", "--out", "out"},
            {"tour", "--examples", "examples", "--recordings", "none", "--out", "out"}};
  }
  std::vector<Arguments> commands() const {
    std::vector<Arguments> all = quick_commands();
    for (const Arguments& command : slow_commands()) all.push_back(command);
    return all;
  }

  static bool is_slurm(const Arguments& command) { return std::ranges::find(command, "--slurm") != command.end(); }
  static bool computes_sweep(const Arguments& command) { return command[0] == "sweep" && !is_slurm(command); }

  /// The two shards of the sweep, for merge.
  void write_parts_of_sweep() const {
    if (fs::exists(path("parts"))) return;
    for (const char* shard : {"1/2", "2/2"}) done({"sweep", "sweep.xml", "--out", "parts", "--shard", shard});
  }

  /// long.csv, 5 s of experiment B: identify and diagnose need more than 3 s. And an arm of one joint for a plan.
  void write_long_log() const {
    if (fs::exists(path("long.csv"))) return;
    write_short_scenario("experiment_b.xml", "5");
    write_text(path("experiment_b.xml"),
               replaced(text_of(path("experiment_b.xml")), "period=\"0.001\"", "period=\"0.002\""));
    done({"simulate", "experiment_b.xml", "--out", "long.csv"});
    write_text(path("axis/axis.xml"),
               replaced(text_of(fs::path(HALYARD_SOURCE_DIR) / "examples/measured/emps/emps.xml"), "</joint>",
                        "<controller kp=\"20\" kd=\"2\"/></joint>"));
    write_text(path("axis/plan.xml"),
               "<scenario name=\"one axis\" model=\"axis.xml\" duration=\"1.6\" seed=\"1\">"
               "<trajectory joint=\"1\" kind=\"sines\" center=\"0.1\"><sine amplitude=\"0.02\" frequency=\"1\"/>"
               "<sine amplitude=\"0.02\" frequency=\"1.7\"/></trajectory>"
               "<control period=\"0.001\" fade_in=\"0.5\"/></scenario>");
  }

  /// examples/ for a tour of a second: short experiments, and a robot and a log that the model explains. none/ has no
  /// recordings.
  void write_small_tour() const {
    if (fs::exists(path("examples"))) return;
    fs::create_directories(path("none"));
    fs::create_directories(path("examples"));
    fs::copy(fs::path(HALYARD_SOURCE_DIR) / "examples/raven2", path("examples/raven2"));
    for (const auto& [name, duration] : {std::pair{"experiment_a", "0.6"}, std::pair{"experiment_b", "0.6"},
                                         std::pair{"experiment_c", "0.6"}, std::pair{"calibration", "3.05"}}) {
      const fs::path file = path("examples/raven2") / (name + std::string(".xml"));
      const std::string text = text_of(file);
      const std::size_t at = text.find("duration=\"");
      ASSERT_NE(at, text.npos);
      write_text(file, text.substr(0, at + 10) + duration + text.substr(text.find('"', at + 10)));
    }
    const auto replace = fs::copy_options::overwrite_existing;
    fs::copy(path("long.csv"), path("examples/raven2/undeclared_effect.csv"), replace);
    fs::copy(path("raven2.xml"), path("examples/raven2/raven2_likely.xml"), replace);
  }

  static std::string fixture(const std::string& name) {
    return std::string(HALYARD_BROKEN_PLUGINS) + "/" + name + ".so";
  }

  static Arguments compare_with(const std::string& module, const std::string& step_limit_s) {
    return {"compare",      "log.csv",    "--model", "raven2.xml", "--estimators", "kinematics," + fixture(module),
            "--step-limit", step_limit_s, "--out",   "out"};
  }

  /// Runs that would go on for long, with their outputs in out/. merge and sweep --slurm never take long.
  std::vector<Arguments> long_runs() const {
    write_text(path("long.xml"), replaced(text_of(path("experiment_a.xml")), "duration=\"1\"", "duration=\"3600\""));
    write_text(path("hanging.xml"),
               replaced(text_of(path("sweep.xml")), "\"kinematics\"", "\"" + fixture("starts_a_process") + "\""));
    return {{"simulate", "long.xml", "--out", "out/log.csv"},
            compare_with("starts_a_session", "3600"),
            {"sweep", "hanging.xml", "--out", "out"},
            {"diagnose", "--model", "raven2.xml", "--data", example("undeclared_effect.csv"), "--out", "out"},
            {"estimate", "--model", "raven2.xml", "--estimator", fixture("starts_a_process"), "--data", "log.csv",
             "--out", "out/e.csv"},
            {"identify", "--model", "raven2.xml", "--data", example("undeclared_effect.csv"), "--parameters",
             "coupling,stiffness,damping", "--out", "out"},
            {"experiments", "--out", "out"},
            {"diagnose", "--plan", "raven2.xml", example("undeclared_effect.xml"), "--out", "out"},
            {"tour", "--recordings", example(""), "--out", "out"}};
  }

  std::string err_path() const { return folder_.string() + ".err"; }

  static std::string line_of(const Arguments& arguments) {
    std::string line = "halyard";
    for (const std::string& argument : arguments) line += " " + argument;
    return line;
  }

  /// One line with `part` on stderr.
  static void expect_line(const std::string& err, const std::string& part) {
    EXPECT_EQ(std::ranges::count(err, '\n'), 1) << err;
    EXPECT_TRUE(contains(err, part)) << err << "lacks: " << part;
  }

  /// The files of out/ after an undisturbed run, which leaves no out/.
  Files files_of(const Arguments& command) const {
    fs::remove_all(path("out"));
    done(command);
    const Files files = files_in(path("out"));
    fs::remove_all(path("out"));
    return files;
  }

  /// For run(): the program runs as a user who owns nothing. Empty if the tests do not run as root: they are that user.
  static std::string as_nobody() {
    if (::geteuid() != 0) return "";
    return "exec setpriv --reuid=65534 --regid=65534 --clear-groups -- sh -c '\"$@\"' sh";
  }
  /// That user may not reach the program, or setpriv may be missing.
  bool runs_as_nobody() const { return run({"--version"}, as_nobody()).exit_code == 0; }

 private:
  const std::string search_path_ = std::getenv("PATH");
};

}  // namespace halyard::testing_program
