// Faults of sweeps alone: a worker that goes, another sweep in the folder, a shard that runs beside a merge.
#include <gtest/gtest.h>

#include "model/output/folder_lock.h"
#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

class FaultsOfSweeps : public Faults {};

TEST_F(FaultsOfSweeps, ASweepWithoutAWorkerIsToBeResumedToTheSameBytes) {
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

TEST_F(FaultsOfSweeps, AWorkerThatIsKilledEndsTheSweepAndIsNoResultOfIt) {
  for (const auto& [module, told] : {std::pair{"kills_its_process", "its process was killed, probably because memory"},
                                     std::pair{"finds_no_memory", "being made: memory ran out"}}) {
    write_text(path("fault.xml"),
               replaced(text_of(path("sweep.xml")), "\"kinematics\"", "\"" + fixture(module) + "\""));
    const RunResult ended = run({"sweep", "fault.xml", "--out", module});
    EXPECT_EQ(ended.exit_code, 1);
    expect_line(ended.err, told);
    EXPECT_FALSE(fs::exists(path(module) / "cells"));
  }
}

TEST_F(FaultsOfSweeps, AnotherSweepInTheFolderIsLeftAlone) {
  done({"sweep", "sweep.xml", "--out", "out"});
  const Files before = files_in(path("out"));
  write_text(path("other.xml"), replaced(text_of(path("sweep.xml")), "steps=\"8\"", "steps=\"4\""));
  for (const std::vector<std::string>& more : {{}, {"--resume"}, std::vector<std::string>{"--shard", "1/2"}}) {
    std::vector<std::string> arguments = {"sweep", "other.xml", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const RunResult other = run(arguments);
    EXPECT_EQ(other.exit_code, 2);
    expect_line(other.err, "holds results of another sweep");
    EXPECT_TRUE(files_in(path("out")) == before);
  }
}

/// The journal of a run as if another build of the program had written it.
void as_of_another_build(const std::string& journal) {
  const std::string text = text_of(journal);
  const std::size_t build = text.find(", build ") + 8;
  write_text(journal, text.substr(0, build) + "otherone" + text.substr(build + 8));
}

TEST_F(FaultsOfSweeps, PointsOfAnotherBuildAreNotMixedWithNewOnes) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  as_of_another_build(path("out/cells/1_of_2.jsonl"));
  const Files before = files_in(path("out"));
  for (const Arguments& command : {Arguments{"sweep", "sweep.xml", "--out", "out", "--resume"},
                                   Arguments{"sweep", "sweep.xml", "--out", "out", "--shard", "2/2"}}) {
    const RunResult mixed = run(command);
    EXPECT_EQ(mixed.exit_code, 2);
    expect_line(mixed.err, "out: holds points of another program (halyard 0.1.0, build otherone, ");
    EXPECT_TRUE(files_in(path("out")) == before);
  }
  done({"sweep", "sweep.xml", "--out", "new", "--shard", "2/2"});
  const RunResult merge = run({"merge", "out", "new", "--out", "all"});
  EXPECT_EQ(merge.exit_code, 2);
  expect_line(merge.err, "halyard merge: the points are of different programs (halyard 0.1.0, build otherone, ");
}

TEST_F(FaultsOfSweeps, PointsOfAnotherBuildAreNotSubmittedToSlurm) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  as_of_another_build(path("out/cells/1_of_2.jsonl"));
  write_text(path("bin/sbatch"), "#!/bin/sh\ntouch submitted; echo 17\n");
  fs::permissions(path("bin/sbatch"), fs::perms::owner_all);
  const RunResult refused = run({"sweep", "sweep.xml", "--out", "out", "--slurm", "--nodes", "2"},
                                "PATH='" + path("bin").string() + "':$PATH; export PATH;");
  EXPECT_EQ(refused.exit_code, 2);
  expect_line(refused.err, "out: holds points of another program (halyard 0.1.0, build otherone, ");
  EXPECT_FALSE(fs::exists(path("submitted")));
}

TEST_F(FaultsOfSweeps, TheStatusTellsThatThePointsAreOfTwoPrograms) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2"});
  const Arguments status = {"sweep", "sweep.xml", "--out", "out", "--status"};
  EXPECT_FALSE(contains(done(status), "programs"));
  as_of_another_build(path("out/cells/1_of_2.jsonl"));
  EXPECT_TRUE(contains(done(status),
                       "the points are of 2 programs, which halyard merge refuses: halyard 0.1.0, build "
                       "otherone, "))
      << done(status);
}

TEST_F(FaultsOfSweeps, AWholeSweepReplacesPointsOfAnotherBuild) {
  done({"sweep", "sweep.xml", "--out", "out"});
  const Files whole = files_in(path("out"));
  as_of_another_build(path("out/cells/all.jsonl"));
  EXPECT_EQ(run({"sweep", "sweep.xml", "--out", "out"}).exit_code, 0);
  EXPECT_TRUE(files_in(path("out")) == whole);
}

TEST_F(FaultsOfSweeps, AMergeDoesNotTakeTheJournalOfAShardThatRuns) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2"});
  const FolderLock shard(path("out"), "1_of_2");
  const RunResult merge = run({"merge", "out"});
  EXPECT_EQ(merge.exit_code, 2);
  expect_line(merge.err, "another run writes into this folder");
  EXPECT_TRUE(fs::exists(path("out/cells/1_of_2.jsonl")));
}

TEST_F(FaultsOfSweeps, TheStatusTellsThatARunGoesOn) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  const Arguments status = {"sweep", "sweep.xml", "--out", "out", "--status"};
  {
    const FolderLock shard(path("out"), "2_of_2");
    const std::string told = done(status);
    EXPECT_TRUE(contains(told, "4 of 8 points are done (50.0 %)\nrunning: a run writes into out\n")) << told;
    EXPECT_FALSE(contains(told, "to continue")) << told;
  }
  EXPECT_TRUE(contains(done(status), "to continue: halyard sweep sweep.xml --out out --resume\n"));
}

TEST_F(FaultsOfSweeps, AMergeReadsNoPointBeforeTheShardsHaveEnded) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  const FolderLock shard(path("out"), "2_of_2");
  const RunResult merge = run({"merge", "out"});
  EXPECT_EQ(merge.exit_code, 2);
  expect_line(merge.err, "another run writes into this folder");  // and not: points are in none of the folders
}

}  // namespace
}  // namespace halyard::testing_program
