// Runs that are killed (SIGKILL) at any moment: what they leave is whole, and the next run ends as if nothing had been.
#include <gtest/gtest.h>

#include <random>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

class FaultsOfAKill : public Faults {
 protected:
  /// Times that each run is killed. HALYARD_KILLS in the environment says how often.
  static int kills(int usual) {
    const char* wanted = std::getenv("HALYARD_KILLS");
    return wanted != nullptr ? std::atoi(wanted) : usual;
  }

  /// How long the command takes. `files` becomes what it leaves in out/, which is removed.
  Milliseconds measure(const Arguments& command, Files& files) const {
    const auto start = std::chrono::steady_clock::now();
    done(command);
    const Milliseconds duration = std::chrono::steady_clock::now() - start;
    files = files_in(path("out"));
    fs::remove_all(path("out"));
    return duration;
  }

  void kill_after(const Arguments& command, Milliseconds wait) const {
    BackgroundRun run(program_, folder_, command, err_path());
    std::this_thread::sleep_for(wait);
  }  // killed here

  /// Every file under its own name is that of the undisturbed run; the journal of a sweep grows.
  void expect_whole(const Files& whole) const {
    if (!fs::exists(path("out"))) return;
    for (const auto& [name, text] : files_in(path("out")))
      EXPECT_TRUE(!whole.contains(name) || name == "cells/all.jsonl" || text == whole.at(name)) << name;
  }

  void TearDown() override {
    fs::remove(err_path());
    Faults::TearDown();
  }
};

TEST_F(FaultsOfAKill, EveryCommandEndsWithTheSameFilesWhenItIsRunAgain) {
  std::mt19937 random(15);
  const std::size_t n_quick = quick_commands().size();
  const std::vector<Arguments> all = commands();
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE(line_of(all[i]));
    Files whole;
    const Milliseconds duration = measure(all[i], whole);
    for (int k = 0; k < kills(i < n_quick ? 5 : 1); ++k) {
      kill_after(all[i], duration * std::uniform_real_distribution(0.0, 1.0)(random));
      expect_whole(whole);
      const RunResult again = run(all[i]);
      EXPECT_EQ(again.exit_code, 0) << again.err;
      EXPECT_TRUE(files_in(path("out")) == whole) << "leftovers, or another result";
      fs::remove_all(path("out"));
    }
  }
}

TEST_F(FaultsOfAKill, ASweepIsResumedToTheSameBytesAfterFiftyKills) {
  write_text(path("tiny.xml"),
             "<sweep name=\"tiny\" scenario=\"experiment_a.xml\" estimators=\"kinematics\" duration=\"0.1\" skip=\"0\">"
             "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" from=\"0.5\" to=\"2\" steps=\"8\" "
             "applies_to=\"robot\"/></sweep>");
  const Arguments command = {"sweep", "tiny.xml", "--out", "out", "--resume", "--jobs", "2"};
  Files whole;
  const Milliseconds duration = measure(command, whole);
  std::mt19937 random(20);
  for (int k = 0; k < kills(50); ++k) {
    // Half of them are killed twice.
    for (int n = 0; n < 1 + k % 2; ++n)
      kill_after(command, duration * std::uniform_real_distribution(0.0, 1.1)(random));
    expect_whole(whole);
    done(command);
    EXPECT_TRUE(files_in(path("out")) == whole) << "leftovers, or another table, after kill " << k;
    fs::remove_all(path("out"));
  }
}

TEST_F(FaultsOfAKill, ASweepThatWasKilledWhileItJoinedItsPointsLeavesNothing) {
  done({"sweep", "sweep.xml", "--out", "whole"});
  const Files whole = files_in(path("whole"));
  kill_while_writing(path("out/cells/all.jsonl"));
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  EXPECT_TRUE(files_in(path("out")) == whole);
}

TEST_F(FaultsOfAKill, WhatAKilledRunLeftBesideAFileGoesWithTheNextRun) {
  kill_while_writing(path("new/log.csv"));
  done({"simulate", "experiment_a.xml", "--out", "new/log.csv"});
  EXPECT_EQ(files_in(path("new")).size(), 2u);  // log and truth
}

}  // namespace
}  // namespace halyard::testing_program
