#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/diagnosis/summary/summary.h"
#include "bench/diagnosis/trial/redraw.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) /
      ("halyard_result_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::remove_all(path);
  fs::create_directories(path / "trials");
  return path;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(ResultOfATrial, KeepsWhyEarlierDrawsWereDropped) {
  const fs::path to = folder();
  Result r = trial(Kind::clean, {}, {});
  r.dropped = {"joint 1 left its range", "joint 2 left its range"};
  write_result(to, r);
  EXPECT_EQ(read_result(result_path(to, r.situation, r.index)).dropped, r.dropped);
  r.dropped.emplace();
  write_result(to, r);
  EXPECT_EQ(read_result(result_path(to, r.situation, r.index)).dropped, r.dropped);
}

TEST(ResultOfATrial, KeepsItsProgramWhichTheSummaryNames) {
  const fs::path to = folder();
  std::vector<Result> ran(3, trial(Kind::clean, {}, {}));
  ran[0].program = ran[2].program = "halyard 0.1.0, build 1f2e3d4c, avx2";
  write_result(to, ran[0]);
  EXPECT_EQ(read_result(result_path(to, ran[0].situation, ran[0].index)).program, ran[0].program);
  write_summary(to, ran);
  EXPECT_NE(text_of(to / "summary.md").find(" Diagnosed by halyard 0.1.0, build 1f2e3d4c, avx2 (2 trials)."),
            std::string::npos)
      << text_of(to / "summary.md");
}

TEST(ResultOfATrial, IsReadWithoutTheDroppedDraws) {
  const fs::path to = folder();
  const Result r = trial(Kind::clean, {}, {});
  write_result(to, r);
  const fs::path path = result_path(to, r.situation, r.index);
  EXPECT_FALSE(nlohmann::json::parse(text_of(path)).contains("dropped_draws"));
  EXPECT_FALSE(read_result(path).dropped);
}

TEST(ResultOfATrial, TellsItsDroppedDrawsInTheHeadOfTheSummary) {
  const fs::path to = folder();
  std::vector<Result> ran(4, trial(Kind::clean, {}, {}));
  ran[0].dropped = {"joint 1 left its range", "joint 1 left its range"};
  ran[1].dropped = {"no step converged"};
  ran[2].dropped.emplace();
  write_summary(to, ran);
  EXPECT_NE(text_of(to / "summary.md")
                .find("3 draws of 3 trials could not be recorded (2 times: joint 1 left its range; 1 times: no step "
                      "converged); 1 "
                      "trials do not tell how many of theirs could not be."),
            std::string::npos)
      << text_of(to / "summary.md");
}

TEST(ResultOfATrial, KeepsHowManySamplesTheIntervalsOfThePredictionContain) {
  const fs::path to = folder();
  Result r = trial(Kind::clean, {}, {});
  r.interval_coverage = {0.97, std::numeric_limits<double>::quiet_NaN(), 1};
  write_result(to, r);
  const std::optional<std::vector<double>> read = read_result(result_path(to, r.situation, r.index)).interval_coverage;
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 3u);
  EXPECT_EQ((*read)[0], 0.97);
  EXPECT_TRUE(std::isnan((*read)[1])) << "a joint without readings";
  EXPECT_EQ((*read)[2], 1);
}

TEST(ResultOfATrial, IsReadWithoutTheseIntervals) {
  const fs::path to = folder();
  const Result r = trial(Kind::clean, {}, {});
  write_result(to, r);
  const fs::path path = result_path(to, r.situation, r.index);
  EXPECT_FALSE(nlohmann::json::parse(text_of(path)).contains("joint_position_interval95"));
  EXPECT_FALSE(read_result(path).interval_coverage);
  write_summary(to, {r});
  EXPECT_EQ(text_of(to / "summary.md").find("prediction intervals"), std::string::npos);
}

TEST(DrawsOfATrial, AreRepeatedUntilOneIsPossible) {
  int draws = 0;
  std::vector<std::string> dropped;
  const auto third = [&] {
    if (++draws < 3) throw std::runtime_error("draw " + std::to_string(draws));
    return draws;
  };
  EXPECT_EQ(first_possible(third, dropped), 3);
  EXPECT_EQ(dropped, (std::vector<std::string>{"draw 1", "draw 2"}));
}

TEST(DrawsOfATrial, EndAfterTheMost) {
  std::vector<std::string> dropped;
  EXPECT_FALSE(first_possible([]() -> int { throw std::runtime_error("no"); }, dropped));
  EXPECT_EQ(dropped.size(), static_cast<std::size_t>(kMostDraws));
}

}  // namespace
}  // namespace halyard::blind
