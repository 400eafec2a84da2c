/// The journals that keep the results of a sweep.

#include "evaluation/sweep/sweep_cells.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "tests/support/message_of.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Errors without standard deviations: within_two_std is NaN.
std::vector<double> errors_of_size(double size) { return {1001, size, 1.25 * size, 3 * size, -size / 3, kNan}; }

/// The second estimator fails at even points.
SweepCell cell_at(std::size_t point) {
  SweepCell cell;
  cell.point = point;
  cell.results.resize(2);
  cell.results[0].values = {errors_of_size(1e-3 / 3), errors_of_size(double(point))};
  if (point % 2 == 0) cell.results[1].failure = "took more than 10 s";
  cell.results[1].values.assign(2, std::vector<double>(6, kNan));
  return cell;
}

class SweepCells : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    grid_.id = "12ab";
    grid_.axes = {{.parameters = {"joint1.cable.stiffness"}, .unit = "N/m", .values = {1, 2, 3, 4, 5, 6}}};
    grid_.estimators = {"kinematics", "./mine.so"};
    grid_.units = {{"rad", "deg", 57}, {"m", "mm", 1000}};
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path store(const Shard& shard, const std::vector<std::size_t>& points) const {
    CellJournal journal(folder_, grid_, shard);
    for (const std::size_t point : points) journal.add(cell_at(point));
    return journal_path(folder_, shard);
  }
  StoredCells stored() const { return StoredCells({folder_}, grid_); }
  static std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void append(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::app) << text; }

  SweepGrid grid_;
  const fs::path folder_ = fs::temp_directory_path() / ("halyard_sweep_cells_" + std::to_string(::getpid()));
};

TEST_F(SweepCells, AreGivenBackToTheLastBit) {
  store({}, {4});
  EXPECT_FALSE(stored().has(3));
  ASSERT_TRUE(stored().has(4));
  const SweepCell read = stored().read(4), written = cell_at(4);
  EXPECT_EQ(read.point, 4u);
  ASSERT_EQ(read.results.size(), 2u);
  EXPECT_EQ(read.results[1].failure, "took more than 10 s");
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t c = 0; c < 6; ++c) {
        const double a = read.results[i].values[k].at(c), b = written.results[i].values[k][c];
        EXPECT_TRUE((a == b && std::signbit(a) == std::signbit(b)) || (std::isnan(a) && std::isnan(b)))
            << a << ", " << b;
      }
  EXPECT_EQ(read.shown(grid_, 0, 0, 1), 4) << "the mean absolute error";
}

TEST_F(SweepCells, HaveTheColumnsOfTheirMeasuresInOrder) {
  grid_.measures = parse_measures("counts,nees");
  SweepCell cell{0, {{"", {}}, {"", {}}}};
  for (SweepCell::Result& result : cell.results) result.values.assign(2, {1001, 2, 3, 0.9, 0.8, 1.2, 400});
  EXPECT_EQ(cell.shown(grid_, 0, 1, 1), 2) << "measurements not accepted";
  EXPECT_EQ(cell.shown(grid_, 1, 1, 1), 0.9) << "mean NEES";
  CellJournal(folder_, grid_, {}).add(cell);
  EXPECT_EQ(stored().read(0).results[1].values, cell.results[1].values);
  grid_.measures = parse_measures("errors");
  EXPECT_NE(message_of([&] { stored().read(0); }).find("damaged at byte"), std::string::npos);
}

TEST_F(SweepCells, OfAllShardsCountTogether) {
  EXPECT_EQ(store({1, 2}, {0, 2}).filename(), "1_of_2.jsonl");
  EXPECT_EQ(store({}, {5}).filename(), "all.jsonl");
  EXPECT_EQ(stored().count(), 3u);
  EXPECT_EQ(stored().count_failed(), 2u);
}

TEST_F(SweepCells, FromSeveralThreadsAreAllStored) {
  CellJournal journal(folder_, grid_, {});
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < 6; ++i) threads.emplace_back([&journal, i] { journal.add(cell_at(i)); });
  threads.clear();
  EXPECT_EQ(stored().count(), 6u);
}

// What a run leaves that is killed while it writes a line.
TEST_F(SweepCells, ALineThatWasCutOffDoesNotCountAndIsReplaced) {
  const std::string whole = text_of(store({}, {0, 1, 2}));
  const fs::path path = journal_path(folder_, {});
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;  // start of the last line
  for (const std::size_t length : {last, last + 1, last + 20, whole.size() - 1}) {
    fs::resize_file(path, length);
    EXPECT_EQ(stored().count(), 2u);
    store({}, {2});
    EXPECT_EQ(text_of(path), whole);
  }
  fs::resize_file(path, 5);  // of the first line
  EXPECT_EQ(stored().count(), 0u);
  store({}, {0, 1, 2});
  EXPECT_EQ(text_of(path), whole);
}

TEST_F(SweepCells, OfMoreJournalsThanAProcessMayOpenAreRead) {
  const fs::path first = store({}, {0});
  const std::string text = text_of(first);
  for (int i = 1; i < 400; ++i) append(folder_ / "cells" / (std::to_string(i) + "_of_400.jsonl"), text);
  append(folder_ / "cells" / "last.jsonl", text_of(store({1, 9999}, {3})));
  fs::remove(journal_path(folder_, {1, 9999}));
  rlimit limit;
  ::getrlimit(RLIMIT_NOFILE, &limit);
  const rlimit few{320, limit.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &few);
  const StoredCells cells = stored();
  EXPECT_EQ(cells.count(), 2u);
  EXPECT_EQ(cells.read(3).point, 3u);
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

// A limit of the file size stands for a full disk.
TEST_F(SweepCells, AFullDiskKeepsTheCellsBefore) {
  const fs::path path = store({}, {0, 1});
  const auto size = fs::file_size(path);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit;
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{size + 10, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  CellJournal journal(folder_, grid_, {});
  for (int i = 0; i < 2; ++i) {
    try {
      journal.add(cell_at(2));
      ADD_FAILURE() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), path.string() +
                                  ": not written: File too large; the points before are kept: make room and "
                                  "run again with --resume");
    }
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(fs::file_size(path), size);
  EXPECT_EQ(stored().count(), 2u);
}

TEST_F(SweepCells, ThatAreDamagedAreRefused) {
  const fs::path path = store({}, {0});
  const std::string good = text_of(path);
  for (const char* line : {"x", "{\"point\":7,\"failed\":0,\"results\":[]}", "{\"point\":1,\"failed\":}"}) {
    append(path, std::string(line) + "\n");
    EXPECT_NE(message_of([&] { stored(); }).find("all.jsonl: is no result of halyard sweep or is damaged at byte"),
              std::string::npos)
        << line;
    fs::resize_file(path, good.size());
  }
  for (const char* line : {"{\"point\":1,\"failed\":0,\"results\":[]}", "{\"point\":1,\"failed\":0,\"results\":[}",
                           "{\"point\":1,\"failed\":0,\"results\":[{\"failure\":\"\",\"joints\":[[1,2]]}]}"}) {
    append(path, std::string(line) + "\n");
    EXPECT_NE(message_of([&] { stored().read(1); }).find("damaged at byte"), std::string::npos) << line;
    fs::resize_file(path, good.size());
  }
}

TEST_F(SweepCells, OfAnotherSweepAreRefused) {
  const fs::path path = store({}, {0});
  grid_.id = "34cd";
  EXPECT_EQ(message_of([&] { stored(); }),
            path.string() + ": belongs to another sweep; remove it, or give a folder of its own to each sweep");
}

TEST_F(SweepCells, SayWhichProgramsHaveWrittenThem) {
  store({1, 3}, {0});
  store({2, 3}, {1});
  EXPECT_EQ(stored().programs(), std::vector{this_program()}) << "once";
  CellJournal(folder_, grid_, {3, 3}, "another").add(cell_at(2));
  EXPECT_EQ(stored().programs(), (std::vector<std::string>{this_program(), "another"}));
}

TEST_F(SweepCells, OfAnEarlierProgramAreRead) {
  const fs::path path = store({}, {0, 3});
  const std::string text = text_of(path);
  std::ofstream(path, std::ios::binary) << "{\"sweep\":\"12ab\",\"points\":6}" << text.substr(text.find('\n'));
  EXPECT_EQ(stored().count(), 2u);
  EXPECT_EQ(stored().programs(), std::vector<std::string>{""}) << "it wrote no build";
}

TEST_F(SweepCells, OfAJournalWithoutACompleteLineHaveNoProgram) {
  const fs::path path = store({}, {0});
  fs::resize_file(path, 20);
  EXPECT_TRUE(stored().programs().empty());
}

TEST_F(SweepCells, ALaterResultReplacesAFailureAndNothingElse) {
  SweepCell repeated = cell_at(4), other = cell_at(3);
  repeated.results[1].failure.clear();
  other.results[0].values = {errors_of_size(7), errors_of_size(7)};
  store({}, {3, 4});
  CellJournal journal(folder_, grid_, {});
  journal.add(repeated);
  journal.add(other);
  EXPECT_FALSE(stored().has_failed(4));
  EXPECT_EQ(stored().line(4), journal_line(repeated));
  EXPECT_EQ(stored().line(3), journal_line(cell_at(3)));
}

TEST_F(SweepCells, AJournalThatCannotBeReadToItsEndIsNotTakenForAShorterOne) {
  fs::create_directories(folder_ / "cells" / "all.jsonl");  // can be opened, not read
  EXPECT_THROW(stored(), std::runtime_error);
  EXPECT_THROW(CellJournal(folder_, grid_, {}).add(cell_at(1)), std::runtime_error);
}

TEST_F(SweepCells, AJournalThatSomebodyRemovesIsAnErrorOfTheRun) {
  CellJournal journal(folder_, grid_, {});
  journal.add(cell_at(1));
  fs::remove_all(folder_);
  for (const std::size_t point : {2, 3}) EXPECT_THROW(journal.add(cell_at(point)), std::runtime_error);
}

}  // namespace
}  // namespace halyard
