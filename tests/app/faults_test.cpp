// What can go wrong around a run: a full disk, signals, closed pipes, another run. Outputs are complete or as before.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>
#include <regex>
#include <set>

#include "model/output/folder_lock.h"
#include "tests/support/app_runs.h"
#include "tests/support/background_run.h"
#include "tests/support/german_locale.h"

namespace halyard::testing_program {
namespace {

using Arguments = std::vector<std::string>;

std::string fixture(const std::string& name) { return std::string(HALYARD_BROKEN_PLUGINS) + "/" + name + ".so"; }

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
  }

  static Arguments motor_columns() { return {kLogColumns.begin(), kLogColumns.begin() + 7}; }

  /// Commands that write, with their outputs in out/.
  static std::vector<Arguments> quick_commands() {
    return {
        {"simulate", "experiment_a.xml", "--out", "out/log.csv"},
        {"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "out/e.csv"},
        {"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "out"},
        {"sweep", "sweep.xml", "--out", "out"},
        {"experiments", "--duration", "0.6", "--no-effect-study", "--calibrated", "raven2.xml", "--out", "out"}};
  }
  static std::vector<Arguments> slow_commands() {
    return {{"identify", "--model", "raven2.xml", "--data", "long.csv", "--parameters", "coupling", "--out", "out"},
            {"diagnose", "--model", "raven2.xml", "--data", "long.csv", "--out", "out"},
            {"diagnose", "--plan", "raven2.xml", "experiment_b.xml", "--out", "out"}};
  }
  static std::vector<Arguments> commands() {
    std::vector<Arguments> all = quick_commands();
    for (const Arguments& command : slow_commands()) all.push_back(command);
    return all;
  }

  static Arguments compare_with(const std::string& module, const std::string& step_limit_s) {
    return {"compare",      "log.csv",    "--model", "raven2.xml", "--estimators", "kinematics," + fixture(module),
            "--step-limit", step_limit_s, "--out",   "out"};
  }

  /// Runs that would go on for long, with their outputs in out/.
  std::vector<Arguments> long_runs() const {
    write_text(path("long.xml"), replaced(text_of(path("experiment_a.xml")), "duration=\"1\"", "duration=\"3600\""));
    write_text(path("hanging.xml"),
               replaced(text_of(path("sweep.xml")), "\"kinematics\"", "\"" + fixture("starts_a_process") + "\""));
    return {{"simulate", "long.xml", "--out", "out/log.csv"},
            compare_with("starts_a_session", "3600"),
            {"sweep", "hanging.xml", "--out", "out"},
            {"diagnose", "--model", "raven2.xml", "--data", example("undeclared_effect.csv"), "--out", "out"}};
  }

  /// Number of processes in these groups.
  static std::ptrdiff_t size_of(const std::set<pid_t>& groups) {
    return std::ranges::count_if(running_processes(), [&](const Process& p) { return groups.contains(p.group); });
  }

  /// The process groups below a run, once at least one of its estimators has started a process of its own. A worker has
  /// two processes, each in its own group.
  static std::set<pid_t> groups_with_help(const BackgroundRun& run, bool in_own_session) {
    std::set<pid_t> groups;
    EXPECT_TRUE(comes_true([&] {
      groups.clear();
      const std::vector<Process> below = run.descendants();
      for (const Process& p : below)
        if (p.group != ::getpgrp()) groups.insert(p.group);  // in this group until it has its own
      const std::size_t of_workers = 2 * run.children().size();
      return of_workers > 0 && (in_own_session ? groups.size() : below.size()) > of_workers;
    }));
    return groups;
  }

  /// Each runs in the first process that its worker has started.
  static void crash_estimators(const BackgroundRun& run) {
    EXPECT_TRUE(comes_true([&] { return run.children().size() == 1; })) << "the other one has not ended";
    const std::vector<Process> workers = run.children();
    for (const Process& p : run.descendants())
      if (std::ranges::find(workers, p.parent, &Process::id) != workers.end() && p.group == p.id) ::kill(p.id, SIGSEGV);
  }

  std::string err_path() const { return folder_.string() + ".err"; }

  static std::string line_of(const Arguments& arguments) {
    std::string line = "halyard";
    for (const std::string& argument : arguments) line += " " + argument;
    return line;
  }

  void expect_full_disk(const Arguments& command, const std::string& limit) const {
    SCOPED_TRACE(line_of(command));
    const auto before = files_in(folder_);
    const RunResult result = run(command, limit);
    EXPECT_EQ(result.exit_code, 1);
    expect_line(result.err, "not written: File too large");
    EXPECT_TRUE(files_in(folder_) == before) << "files were left or changed";
  }

  /// What was printed, but how long a step took.
  static std::string without_times(const std::string& text) {
    return std::regex_replace(text, std::regex("[0-9.e+-]+ us a step"), "us a step");
  }

  /// One line with `part` on stderr.
  static void expect_line(const std::string& err, const std::string& part) {
    EXPECT_EQ(std::ranges::count(err, '\n'), 1) << err;
    EXPECT_TRUE(contains(err, part)) << err << "lacks: " << part;
  }
};

// A limit of the file size stands for a full disk: it needs no root. The first files of each command are below it.
TEST_F(Faults, AFullDiskLeavesOldOutputsAsTheyWere) {
  for (const char* name : {"log.csv", "log.truth.csv", "e.csv", "report.html", "comparison.csv", "experiments.csv"})
    write_text(path("out") / name, "old");
  for (const Arguments& command : quick_commands()) {
    if (command[0] != "sweep") expect_full_disk(command, "ulimit -f 160;");  // 80 KiB
  }
}

TEST_F(Faults, AFullDiskAfterALongComputationLeavesOldOutputsAsTheyWere) {
  write_short_scenario("experiment_b.xml", "5");
  done({"simulate", "experiment_b.xml", "--out", "long.csv"});
  for (const char* name : {"model.xml", "identify.json", "report.html", "plan.json"})
    write_text(path("out") / name, "old");
  for (const Arguments& command : slow_commands()) expect_full_disk(command, "ulimit -f 400;");  // 200 KiB
}

TEST_F(Faults, AFullDiskLeavesTheFinishedPointsOfASweep) {
  const Arguments command = {"sweep", "sweep.xml", "--out", "out"};
  const RunResult result = run(command, "ulimit -f 160;");
  EXPECT_EQ(result.exit_code, 1);
  expect_line(result.err, "File too large");
  EXPECT_FALSE(fs::exists(path("out/sweep.csv"))) << "the table without the report";
  EXPECT_EQ(lines_of(text_of(path("out/cells/all.jsonl"))).size(), 1u + 8);
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  done({"sweep", "sweep.xml", "--out", "whole"});
  EXPECT_TRUE(files_in(path("out")) == files_in(path("whole")));
}

TEST_F(Faults, AFolderThatCannotBeWrittenIsRefusedAtOnce) {
  fs::create_directories(path("read_only"));
  ::chmod(path("read_only").c_str(), 0555);
  for (Arguments command : commands()) {
    SCOPED_TRACE(line_of(command));
    const fs::path file = fs::path(command.back()).filename();
    const std::string below = file.has_extension() ? "/" + file.string() : "";
    command.back() = "log.csv" + below;
    const RunResult in_file = run(command);
    EXPECT_EQ(in_file.exit_code, 2);
    expect_line(in_file.err, "is not a folder");
    if (::geteuid() == 0) continue;  // root writes everywhere
    command.back() = "read_only" + below;
    const RunResult read_only = run(command);
    EXPECT_EQ(read_only.exit_code, 2);
    expect_line(read_only.err, "no permission to write");
  }
}

TEST_F(Faults, ASignalEndsARunAndAllThatItStartedAndLeavesNothing) {
  for (const Arguments& command : long_runs())
    for (const int signal : {SIGINT, SIGTERM}) {
      SCOPED_TRACE(line_of(command) + ", signal " + std::to_string(signal));
      const auto before = files_in(folder_);
      const bool starts_workers = command[0] == "compare" || command[0] == "sweep";
      BackgroundRun run(program_, folder_, command, err_path());
      std::set<pid_t> groups;
      if (starts_workers) groups = groups_with_help(run, command[0] == "compare");
      else std::this_thread::sleep_for(std::chrono::milliseconds(500));
      run.send(signal);
      EXPECT_EQ(run.wait(), 128 + signal);
      expect_line(text_of(err_path()), signal == SIGINT ? "halyard: ended by SIGINT" : "halyard: ended by SIGTERM");
      EXPECT_EQ(contains(text_of(err_path()), "points are kept: go on with the same command and --resume"),
                command[0] == "sweep");
      EXPECT_TRUE(comes_true([&] { return size_of(groups) == 0; })) << "what an estimator started goes on";
      auto after = files_in(folder_);
      after.erase("out/sweep.json");  // the description of a sweep stands from the start
      EXPECT_TRUE(after == before) << "files were left or changed";
      fs::remove_all(path("out"));
    }
  fs::remove(err_path());
}

TEST_F(Faults, WhatAnEstimatorStartsEndsWithItsRun) {
  for (const std::string module : {"starts_a_process", "starts_a_session"})
    for (const std::string end : {"limit of a step", "killed program", "crash"}) {
      SCOPED_TRACE(module + ", " + end);
      BackgroundRun run(program_, folder_, compare_with(module, end == "limit of a step" ? "1" : "3600"), err_path());
      const std::set<pid_t> groups = groups_with_help(run, module == "starts_a_session");
      if (end == "killed program") run.send(SIGKILL);
      if (end == "crash") crash_estimators(run);
      EXPECT_EQ(run.wait(), end == "killed program" ? 128 + SIGKILL : 0);
      EXPECT_TRUE(comes_true([&] { return size_of(groups) == 0; })) << "what an estimator started goes on";
    }
  fs::remove(err_path());
}

TEST_F(Faults, AnIgnoredSignalStaysIgnored) {
  write_short_scenario("experiment_b.xml", "10");
  // The process of the shell becomes that of the program.
  const RunResult result = run({"simulate", "experiment_b.xml", "--out", "new.csv"},
                               "trap '' INT; (for i in 1 2 3 4 5; do sleep 0.1; kill -INT $$; done) &");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Faults, AClosedPipeIsAnErrorWithCompleteOutputs) {
  for (const Arguments& command : {quick_commands()[0], quick_commands()[2]}) {
    SCOPED_TRACE(line_of(command));
    int pipe[2];
    ASSERT_EQ(::pipe2(pipe, O_CLOEXEC), 0);
    BackgroundRun run(program_, folder_, command, err_path(), pipe[1]);
    ::close(pipe[0]);
    ::close(pipe[1]);
    EXPECT_EQ(run.wait(), 1);
    expect_line(text_of(err_path()), "stdout: cannot be written: Broken pipe");
  }
  EXPECT_EQ(files_in(path("out")).size(), 5u);  // log and truth; table, numbers and report
  fs::remove(err_path());
}

TEST_F(Faults, AClosedStreamTakesNoPartOfTheOutputs) {
  done({"simulate", "experiment_a.xml", "--out", "open/log.csv"});
  const std::string command = "cd '" + folder_.string() + "' && '" + program_.string() +
                              "' simulate experiment_a.xml --out closed/log.csv >&- 2>&-";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1) << "the summary cannot be printed";
  EXPECT_TRUE(files_in(path("closed")) == files_in(path("open")));
}

TEST_F(Faults, NeitherHomeNorTemporaryFolderIsNeeded) {
  const Arguments simulate = {"simulate", "experiment_a.xml", "--out", "new/log.csv"};
  const Arguments compare = {"compare", "new/log.csv", "--model", "raven2.xml", "--estimators", "ekf", "--out", "new"};
  for (const Arguments& command : {simulate, compare}) {
    const RunResult result = run(command, "unset HOME; TMPDIR=/proc/none; export TMPDIR;");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(text_of(path("new/log.csv")), text_of(path("sensed.csv")));
}

TEST_F(Faults, ALocaleWithDecimalCommasChangesNothing) {
  if (!make_german_locale(path("locale"))) GTEST_SKIP() << kNoGermanLocale;
  // The program leaves its locale alone: what is preloaded sets it, as a program that embeds halyard may.
  const std::string german = "export LOCPATH='" + path("locale").string() + "' LC_ALL=" + kGermanLocale +
                             " ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0 LD_PRELOAD=" HALYARD_SETS_LOCALE ";";
  write_short_scenario("experiment_b.xml", "3");
  done({"simulate", "experiment_b.xml", "--out", "b.csv"});
  std::vector<Arguments> all = quick_commands();
  all.push_back({"diagnose", "--model", "raven2.xml", "--data", "b.csv", "--out", "out"});
  all.push_back({"diagnose", "--plan", "raven2.xml", "experiment_b.xml", "--out", "out"});
  for (const Arguments& command : all) {
    SCOPED_TRACE(line_of(command));
    fs::remove_all(path("out"));
    const std::string usual = done(command);
    const auto files = files_in(path("out"));
    fs::remove_all(path("out"));
    const RunResult result = run(command, german);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(without_times(result.out), without_times(usual));
    EXPECT_TRUE(files_in(path("out")) == files);
  }
}

TEST_F(Faults, AKilledSweepIsResumedToTheSameBytes) {
  done({"sweep", "sweep.xml", "--out", "whole"});
  const auto whole = files_in(path("whole"));
  std::mt19937 random(20);
  for (int i = 0; i < 4; ++i) {
    fs::remove_all(path("out"));
    const Arguments command = {"sweep", "sweep.xml", "--out", "out", "--resume", "--jobs", "2"};
    {
      BackgroundRun run(program_, folder_, command, err_path());
      std::this_thread::sleep_for(std::chrono::milliseconds(100 + random() % 1000));
    }  // killed here
    done(command);
    EXPECT_TRUE(files_in(path("out")) == whole) << "leftovers, or another table";
  }
  fs::remove(err_path());
}

TEST_F(Faults, ASweepThatWasKilledWhileItJoinedItsPointsLeavesNothing) {
  done({"sweep", "sweep.xml", "--out", "whole"});
  const auto whole = files_in(path("whole"));
  kill_while_writing(path("out/cells/all.jsonl"));
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  EXPECT_TRUE(files_in(path("out")) == whole);
}

TEST_F(Faults, WhatAKilledRunLeftBesideAFileGoesWithTheNextRun) {
  kill_while_writing(path("new/log.csv"));
  done({"simulate", "experiment_a.xml", "--out", "new/log.csv"});
  EXPECT_EQ(files_in(path("new")).size(), 2u);  // log and truth
}

TEST_F(Faults, ASweepWithoutAWorkerIsToBeResumedToTheSameBytes) {
  done({"sweep", "sweep.xml", "--out", "whole"});
  // The worker goes while the sweep runs: it is there when the estimators are checked, and the first start removes it.
  write_text(path("worker"), "#!/bin/sh\n[ -e started ] && rm -f worker\ntouch started\nexec " +
                                 (program_.parent_path() / "libexec/halyard/halyard_worker").string() + " \"$@\"\n");
  fs::permissions(path("worker"), fs::perms::owner_all);
  const RunResult broken = run({"sweep", "sweep.xml", "--out", "out", "--jobs", "1"},
                               "HALYARD_WORKER='" + path("worker").string() + "'; export HALYARD_WORKER;");
  EXPECT_EQ(broken.exit_code, 2);
  expect_line(broken.err, "HALYARD_WORKER");
  EXPECT_FALSE(contains(text_of(path("out/cells/all.jsonl")), "is no file")) << "stored as a failure of the estimator";
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  EXPECT_TRUE(files_in(path("out")) == files_in(path("whole")));
}

TEST_F(Faults, AShardLeavesAnotherSweepAlone) {
  done({"sweep", "sweep.xml", "--out", "out"});
  const auto before = files_in(path("out"));
  write_text(path("other.xml"), replaced(text_of(path("sweep.xml")), "steps=\"8\"", "steps=\"4\""));
  const RunResult shard = run({"sweep", "other.xml", "--out", "out", "--shard", "1/2"});
  EXPECT_EQ(shard.exit_code, 2);
  expect_line(shard.err, "holds results of another sweep");
  EXPECT_TRUE(files_in(path("out")) == before);
  const RunResult whole = run({"sweep", "other.xml", "--out", "out"});
  EXPECT_EQ(whole.exit_code, 0);
  expect_line(whole.err, "they are removed");
}

TEST_F(Faults, AMergeDoesNotTakeTheJournalOfAShardThatRuns) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2"});
  const FolderLock shard(path("out"), "1_of_2");
  const RunResult merge = run({"merge", "out"});
  EXPECT_EQ(merge.exit_code, 2);
  expect_line(merge.err, "another run writes into this folder");
  EXPECT_TRUE(fs::exists(path("out/cells/1_of_2.jsonl")));
}

TEST_F(Faults, ATerminalThatGoesEndsNoRun) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  BackgroundRun run(program_, folder_, {"sweep", "sweep.xml", "--out", "out", "--jobs", "1"}, ::ptsname(terminal));
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/cells/all.jsonl")); }));
  ::close(terminal);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_TRUE(fs::exists(path("out/sweep.csv")));
}

TEST_F(Faults, ASecondRunIntoAnOutputIsRefused) {
  // One run into a folder and one into files in it: they do not disturb each other.
  BackgroundRun into_folder(program_, folder_, long_runs()[1], err_path());
  BackgroundRun into_files(program_, folder_, long_runs()[0], err_path());
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/.halyard.lock")); }));
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/.halyard.log.truth.csv.lock")); }));
  for (Arguments command : commands()) {
    const bool writes_file = command.back() != "out";
    if (command[0] == "estimate") command.back() = "out/log.truth.csv";  // which `simulate` writes, too
    SCOPED_TRACE(line_of(command));
    const RunResult second = run(command);
    EXPECT_EQ(second.exit_code, 2);
    expect_line(second.err, writes_file ? "another run writes this file" : "another run writes into this folder");
  }
  done(quick_commands()[1]);
  for (BackgroundRun* first : {&into_folder, &into_files}) {
    first->send(SIGKILL);
    EXPECT_EQ(first->wait(), 128 + SIGKILL);
  }
  for (const std::size_t i : {0, 2}) done(quick_commands()[i]);
  EXPECT_EQ(files_in(path("out")).size(), 6u);  // log, truth and estimates; table, numbers and report
  fs::remove(err_path());
}

}  // namespace
}  // namespace halyard::testing_program
