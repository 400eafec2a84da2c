// A disk that is full, or fills up while a command writes. Old outputs stay, and a sweep keeps its points.
#include <gtest/gtest.h>

#include "tests/app/faults/faults.h"
#include "tests/app/faults/small_disk.h"

namespace halyard::testing_program {
namespace {

/// A limit of the file size stands for a full disk: it needs no root. The first files of each command are below it.
class FaultsOfALimit : public Faults {
 protected:
  void expect_full_disk(const Arguments& command, const std::string& limit) const {
    SCOPED_TRACE(line_of(command));
    const Files before = files_in(folder_);
    const RunResult result = run(command, limit);
    EXPECT_EQ(result.exit_code, 1);
    expect_line(result.err, "not written: File too large");
    EXPECT_TRUE(files_in(folder_) == before) << "files were left or changed";
  }
};

TEST_F(FaultsOfALimit, AFullDiskLeavesOldOutputsAsTheyWere) {
  for (const char* name : {"log.csv", "log.truth.csv", "e.csv", "report.html", "comparison.csv", "experiments.csv"})
    write_text(path("out") / name, "old");
  for (const Arguments& command : quick_commands()) {
    // A sweep keeps its points, see below. What sweep --slurm writes is smaller than the memory that it checks with.
    if (command[0] != "sweep") expect_full_disk(command, "ulimit -f 160;");  // 80 KiB
  }
}

TEST_F(FaultsOfALimit, AFullDiskAfterALongComputationLeavesOldOutputsAsTheyWere) {
  for (const char* name : {"model.xml", "identify.json", "report.html", "plan.json"})
    write_text(path("out") / name, "old");
  for (const Arguments& command : slow_commands()) expect_full_disk(command, "ulimit -f 300;");  // 150 KiB
}

TEST_F(FaultsOfALimit, AFullDiskLeavesTheFinishedPointsOfASweep) {
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

/// A file system of a few pages in disk/.
class FaultsOfASmallDisk : public Faults {
 protected:
  void SetUp() override {
    Faults::SetUp();
    if (!SmallDisk(path("disk"), 1).is_mounted()) GTEST_SKIP() << "a disk of a few pages cannot be mounted here";
  }

  static Arguments on_disk(Arguments command) {
    command.back() = "disk/" + command.back();
    return command;
  }

  void expect_no_space(const Arguments& command, std::size_t pages) const {
    SCOPED_TRACE(line_of(command) + ", " + std::to_string(pages) + " pages");
    const SmallDisk disk(path("disk"), pages + 1);
    write_text(path("disk/out/report.html"), "old");
    const RunResult result = run(command);
    EXPECT_EQ(result.exit_code, 1);
    expect_line(result.err, "No space left on device");
    Files after = files_in(path("disk/out"));
    if (is_slurm(command)) after.erase("sweep.json");  // the description of a sweep stands from the start
    EXPECT_TRUE(after == (Files{{"report.html", "old"}})) << "files were left or changed";
  }
};

TEST_F(FaultsOfASmallDisk, EveryCommandThatRunsOutOfSpaceLeavesOldOutputsAsTheyWere) {
  for (const Arguments& command : commands()) {
    if (computes_sweep(command)) continue;  // it keeps its points, see below
    const Arguments here = on_disk(command);
    std::size_t needed = 0;
    {
      const SmallDisk disk(path("disk"), 2000);
      done(here);
      needed = pages_of(files_in(path("disk/out")));
    }
    // In the last file, and for the quick ones also earlier. Of sweep --slurm the last is written when Slurm has the
    // job.
    const std::size_t last = is_slurm(command) ? 2 : 1;
    expect_no_space(here, needed - last);
    if (command[0] == "compare" || command[0] == "simulate" || command[0] == "merge") expect_no_space(here, needed / 3);
  }
}

TEST_F(FaultsOfASmallDisk, AJobOfSlurmThatCannotBeNotedIsTold) {
  const Arguments command = on_disk({"sweep", "sweep.xml", "--slurm", "--nodes", "2", "--out", "out"});
  const SmallDisk disk(path("disk"), 2);  // sweep.json and the script
  const RunResult result = run(command);
  EXPECT_EQ(result.exit_code, 1);
  expect_line(result.err, "No space left on device");
  expect_line(result.err, "scancel 17");
}

/// At each number of pages: before the first point, within the journal, while the points are joined, and in the report.
TEST_F(FaultsOfASmallDisk, ASweepWhoseDiskFillsUpIsResumedToTheSameBytes) {
  write_text(path("tiny.xml"),
             "<sweep name=\"tiny\" scenario=\"experiment_a.xml\" estimators=\"kinematics\" duration=\"0.1\" skip=\"0\">"
             "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" from=\"0.5\" to=\"2\" steps=\"60\" "
             "applies_to=\"robot\"/></sweep>");
  const Arguments command = on_disk({"sweep", "tiny.xml", "--jobs", "2", "--resume", "--out", "out"});
  Files whole;
  {
    const SmallDisk disk(path("disk"), 2000);
    done(command);
    whole = files_in(path("disk/out"));
  }
  const std::size_t journal = pages_of({{"", whole.at("cells/all.jsonl")}});
  const std::size_t needed = pages_of(whole) + journal;  // the joined points stand beside the journal
  ASSERT_GE(journal, 4u) << "the disk should fill up between two points";
  std::size_t kept = 0;
  for (const std::size_t pages : {1ul, 2ul, 3ul, journal, 2 * journal, needed / 2, needed - 1}) {
    SCOPED_TRACE(std::to_string(pages) + " of " + std::to_string(needed) + " pages");
    const SmallDisk disk(path("disk"), pages);
    const RunResult full = run(command);
    EXPECT_EQ(full.exit_code, 1);
    expect_line(full.err, "No space left on device");
    EXPECT_FALSE(fs::exists(path("disk/out/sweep.csv")));
    const fs::path points = path("disk/out/cells/all.jsonl");
    const std::size_t lines = fs::exists(points) ? lines_of(text_of(points)).size() : 0;
    EXPECT_GE(lines, kept) << "fewer points on a larger disk";
    kept = lines;
    ASSERT_TRUE(disk.resize(2000));
    done(command);
    EXPECT_TRUE(files_in(path("disk/out")) == whole) << "leftovers, or another table";
  }
  EXPECT_EQ(kept, 1u + 60) << "the last disk should hold all points";
}

}  // namespace
}  // namespace halyard::testing_program
