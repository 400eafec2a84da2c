#include "evaluation/sweep/sweep_merge.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "evaluation/sweep/sweep_store.h"
#include "evaluation/sweep/sweep_table.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// A grid of three points, one estimator, one joint; the cell of point p has the RMS error p.
class SweepMerge : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    grid_.name = "test";
    grid_.id = "1";
    grid_.file = "study.xml";
    grid_.axes = {{.parameters = {"joint1.cable.stiffness"}, .unit = "N/m", .values = {1, 2, 3}}};
    grid_.estimators = {"kinematics"};
    grid_.units = {{"rad", "deg", 57}};
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path part(const std::string& name, const std::vector<std::size_t>& points, const std::string& id = "1") {
    SweepGrid grid = grid_;
    grid.id = id;
    store_grid(folder_ / name, grid);
    CellJournal journal(folder_ / name, grid, {});
    for (const std::size_t p : points) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      SweepCell cell{p, {{"", {{0, nan, double(p), nan, nan, nan}}}}};
      if (p == failed_) cell.results[0].failure = "crashed";
      journal.add(cell);
    }
    return folder_ / name;
  }

  SweepResult merge(const std::vector<fs::path>& parts) {
    OutputFiles files;
    SweepResult whole = merge_sweep(files, parts, folder_ / "whole");
    files.commit();
    return whole;
  }

  SweepGrid grid_;
  std::size_t failed_ = 99;  ///< the point where the estimator fails
  const fs::path folder_ = fs::temp_directory_path() / ("halyard_sweep_merge_" + std::to_string(::getpid()));
};

TEST_F(SweepMerge, PutsTheCellsOfItsPartsInOrder) {
  const SweepResult whole = merge({part("a", {2}), part("b", {0, 1})});
  ASSERT_EQ(whole.cells.count(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(whole.cells.read(p).point, p);
    EXPECT_EQ(whole.cells.read(p).results[0].values[0][2], static_cast<double>(p));
  }
  EXPECT_EQ(collect_cells({folder_ / "whole"}, read_grid(folder_ / "whole")).count(), 3u) << "and stores them";
}

TEST_F(SweepMerge, IntoOneOfItsPartsLeavesOneJournal) {
  OutputFiles files;
  merge_sweep(files, {part("a", {2}), part("b", {0, 1})}, folder_ / "a");
  files.commit();
  const auto journals = journals_in(folder_ / "a");
  ASSERT_EQ(journals.size(), 1u);
  EXPECT_EQ(StoredCells({folder_ / "a"}, grid_).count(), 3u);
}

TEST_F(SweepMerge, KeepsWhatItsFolderHoldsOfTheSweep) {
  part("whole", {0, 2});
  EXPECT_EQ(merge({part("a", {1})}).cells.count(), 3u);
  EXPECT_EQ(StoredCells({folder_ / "whole"}, grid_).count(), 3u);
  EXPECT_EQ(merge({part("b", {2})}).cells.journal(2), journal_path(folder_ / "b", {})) << "a part counts first";
}

TEST_F(SweepMerge, DoesNotReplaceTheJournalOfAnotherSweep) {
  const fs::path journal = journal_path(part("whole", {0}, "2"), {});
  fs::remove(folder_ / "whole/sweep.json");
  const std::string message = message_of([&] { merge({part("a", {0, 1, 2})}); });
  EXPECT_TRUE(message.starts_with(journal.string() + ": belongs to another sweep")) << message;
}

TEST_F(SweepMerge, NamesThePointThatNoPartHas) {
  const std::string message = message_of([&] { merge({part("a", {0}), part("b", {2})}); });
  EXPECT_NE(message.find("1 of 3 points are in none of the folders, the first is point 1"), message.npos) << message;
  EXPECT_FALSE(fs::exists(folder_ / "whole")) << "nothing is written of a sweep that is not whole";
}

TEST_F(SweepMerge, RefusesPartsOfDifferentSweeps) {
  const std::string message = message_of([&] { merge({part("a", {0, 1}), part("b", {2}, "2")}); });
  EXPECT_NE(message.find("b: holds another sweep than"), message.npos) << message;
  EXPECT_THROW(merge({}), std::invalid_argument);
}

TEST_F(SweepMerge, OfPointsOfAnotherProgramNamesThatProgram) {
  store_grid(folder_ / "a", grid_);
  CellJournal journal(folder_ / "a", grid_, {}, "another");
  for (const std::size_t p : {0, 1, 2}) journal.add({p, {{"crashed", {{}}}}});
  merge({folder_ / "a"});
  EXPECT_EQ(StoredCells({folder_ / "whole"}, grid_).programs(), std::vector<std::string>{"another"});
}

TEST_F(SweepMerge, RefusesPointsOfDifferentPrograms) {
  part("a", {0, 1});
  CellJournal(folder_ / "a", grid_, {2, 2}, "another").add({2, {{"crashed", {{}}}}});
  EXPECT_EQ(message_of([&] { merge({folder_ / "a"}); }),
            "halyard merge: the points are of different programs (another; " + this_program() +
                "); compute all parts with one of them");
}

TEST_F(SweepMerge, WritesATableWithARowForEachPointEstimatorAndJoint) {
  failed_ = 1;
  grid_.effect_modules = {"own.so"};
  const SweepResult whole = merge({part("a", {0, 1, 2})});
  OutputFiles files;
  EXPECT_EQ(write_sweep_table(files, folder_ / "sweep.csv", whole.grid, whole.cells).failures, 1u);
  files.commit();
  std::ifstream file(folder_ / "sweep.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text,
            "point,joint1.cable.stiffness,estimator,joint,unit,samples,mean_absolute_error,rms_error,peak_error,bias,"
            "within_two_std,failure,repeat_with\n"
            "0,1,kinematics,1,rad,0,,0,,,,,\n"
            "1,2,kinematics,1,rad,0,,1,,,,crashed,halyard sweep study.xml --point 1 --effects own.so\n"
            "2,3,kinematics,1,rad,0,,2,,,,,\n");
}

TEST_F(SweepMerge, WritesATableOfLimits) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  grid_.estimators = {};
  grid_.measures = {&limits_measure()};
  grid_.effects = {{"backlash", "half_gap", {"m"}}};
  store_grid(folder_, grid_);
  CellJournal journal(folder_, grid_, {});
  journal.add({0, {{"", {{1e-5, 2e-5}}}}});
  journal.add({1, {{"", {{1e-4, nan}}}}});
  journal.add({2, {{"crashed", {{nan, nan}}}}});
  OutputFiles files;
  write_sweep_table(files, folder_ / "sweep.csv", grid_, StoredCells({folder_}, grid_));
  files.commit();
  std::ifstream file(folder_ / "sweep.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(
      text,
      "point,joint1.cable.stiffness,effect,parameter,joint,unit,detection_limit,naming_limit,failure,repeat_with\n"
      "0,1,backlash,half_gap,1,m,1e-05,2e-05,,\n"
      "1,2,backlash,half_gap,1,m,0.0001,,,\n"
      "2,3,backlash,half_gap,1,m,,,crashed,halyard sweep study.xml --point 2\n");
}

}  // namespace
}  // namespace halyard
