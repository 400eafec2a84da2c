// Signals that end a run while it computes, and those that it ignores.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

class FaultsOfASignal : public Faults {
 protected:
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

  /// Returns once the run takes signals, and a little later: it computes then.
  static void wait_until_it_computes(const BackgroundRun& run) {
    EXPECT_TRUE(comes_true([&] {
      for (const std::string& line : lines_of(text_of("/proc/" + std::to_string(run.id()) + "/status")))
        if (line.starts_with("SigBlk:")) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1) == 1;
      return false;
    }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }

  void TearDown() override {
    fs::remove(err_path());
    Faults::TearDown();
  }
};

TEST_F(FaultsOfASignal, EndsARunAndAllThatItStartedAndLeavesNothing) {
  for (const Arguments& command : long_runs())
    for (const int signal : {SIGINT, SIGTERM}) {
      SCOPED_TRACE(line_of(command) + ", signal " + std::to_string(signal));
      const Files before = files_in(folder_);
      const bool starts_workers = contains(line_of(command), "starts_a_") || command[0] == "sweep";
      BackgroundRun run(program_, folder_, command, err_path());
      std::set<pid_t> groups;
      if (starts_workers) groups = groups_with_help(run, command[0] == "compare");
      else wait_until_it_computes(run);
      run.send(signal);
      EXPECT_EQ(run.wait(), 128 + signal);
      expect_line(text_of(err_path()), signal == SIGINT ? "halyard: ended by SIGINT" : "halyard: ended by SIGTERM");
      EXPECT_EQ(contains(text_of(err_path()), "points are kept: go on with the same command and --resume"),
                command[0] == "sweep");
      EXPECT_TRUE(comes_true([&] { return size_of(groups) == 0; })) << "what an estimator started goes on";
      Files after = files_in(folder_);
      after.erase("out/sweep.json");  // the description of a sweep stands from the start
      EXPECT_TRUE(after == before) << "files were left or changed";
      fs::remove_all(path("out"));
    }
}

TEST_F(FaultsOfASignal, WhatAnEstimatorStartsEndsWithItsRun) {
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

TEST_F(FaultsOfASignal, AnIgnoredSignalStaysIgnored) {
  write_short_scenario("experiment_b.xml", "10");
  // The process of the shell becomes that of the program.
  const RunResult result = run({"simulate", "experiment_b.xml", "--out", "new.csv"},
                               "trap '' INT; (for i in 1 2 3 4 5; do sleep 0.1; kill -INT $$; done) &");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(FaultsOfASignal, WaitsUntilTheJobThatSlurmTakesIsNoted) {
  write_text(path("bin/sbatch"), "#!/bin/sh\nkill -INT $(cat process); sleep 0.5; echo 17\n");
  fs::permissions(path("bin/sbatch"), fs::perms::owner_all);
  // The process of the shell becomes that of the program.
  const RunResult result = run({"sweep", "sweep.xml", "--out", "out", "--slurm", "--nodes", "2"},
                               "echo $$ >process; PATH='" + path("bin").string() + "':$PATH; export PATH;");
  // The run may end before the signal does that has waited for the job.
  if (result.exit_code == 0) EXPECT_TRUE(contains(result.out, "submitted as Slurm job 17")) << result.out;
  else EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_TRUE(contains(text_of(path("out/slurm/job.json")), "\"job\": \"17\"")) << text_of(path("out/slurm/job.json"));
}

}  // namespace
}  // namespace halyard::testing_program
