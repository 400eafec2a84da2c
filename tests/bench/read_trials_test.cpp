#include "bench/diagnosis/summary/read_trials.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bench/diagnosis/summary/summary.h"
#include "tests/bench/trials.h"
#include "tests/support/message_of.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

/// An empty folder of trials.
fs::path folder(const std::string& name) {
  const fs::path path =
      fs::path(testing::TempDir()) /
      ("halyard_trials_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name())) / name;
  fs::remove_all(path);
  fs::create_directories(path / "trials");
  return path;
}

void write_trial(const fs::path& to, int index, std::uint64_t seed = 7, double outliers = 0,
                 const std::string& rule = "") {
  Result r = trial(Kind::clean, {}, {});
  r.index = index;
  r.seed = seed;
  r.outliers = outliers;
  r.rule = rule;
  write_result(to, r);
}

std::string refusal_of(const std::vector<fs::path>& folders) {
  return message_of([&] { read_trials(folders); });
}

TEST(TrialsOfFolders, AreReadTogether) {
  const fs::path a = folder("a"), b = folder("b");
  write_trial(a, 1);
  write_trial(b, 0);
  const std::vector<Result> trials = read_trials({a, b});
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].index, 0);
  EXPECT_EQ(trials[1].index, 1);
}

TEST(TrialsOfFolders, AreNotCountedTwice) {
  const fs::path a = folder("a"), b = folder("b");
  write_trial(a, 0);
  write_trial(a, 1);
  write_trial(b, 1);
  const std::string name = "trials/clean-good-off1-raven2-000001.json";
  EXPECT_EQ(refusal_of({a, b}), (b / name).string() + ": is the same trial as " + (a / name).string() +
                                    "; remove one of them, or leave out its folder");
  EXPECT_EQ(refusal_of({a, a}).find("no InputError"), std::string::npos);
  // A copy under another name is the same trial, too.
  fs::copy_file(a / name, a / "trials" / "copy.json");
  EXPECT_NE(refusal_of({a}).find("is the same trial as"), std::string::npos);
}

TEST(TrialsOfFolders, OfDifferentDrawsAreRefused) {
  const fs::path a = folder("a"), seed = folder("seed"), outliers = folder("outliers"), rule = folder("rule");
  write_trial(a, 0);
  write_trial(seed, 1, 8);
  write_trial(outliers, 2, 7, 0.01);
  write_trial(rule, 3, 7, 0, "sure_name=0.5");
  EXPECT_NE(refusal_of({a, rule}).find("--rule sure_name=0.5, but "), std::string::npos) << refusal_of({a, rule});
  EXPECT_NE(refusal_of({a, rule}).find("has no --rule; "), std::string::npos) << refusal_of({a, rule});
  EXPECT_NE(refusal_of({a, seed}).find("seed 8, but " + a.string()), std::string::npos) << refusal_of({a, seed});
  EXPECT_NE(refusal_of({a, outliers}).find("outliers 0.01, but "), std::string::npos) << refusal_of({a, outliers});
}

fs::path write_lines(const fs::path& to, const std::string& text) {
  std::ofstream(to / "trials.jsonl") << text;
  return to / "trials.jsonl";
}

TEST(TrialsOfAFile, AreReadWithThoseOfFolders) {
  const fs::path a = folder("a"), b = folder("b");
  write_trial(a, 0);
  write_trial(a, 2);
  write_summary(b, read_trials({a}));
  write_trial(b, 1);
  const std::vector<Result> trials = read_trials({b / "trials.jsonl", b});
  ASSERT_EQ(trials.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(trials[i].index, i);
}

TEST(TrialsOfAFile, AreNotCountedTwice) {
  const fs::path a = folder("a");
  write_trial(a, 3);
  write_summary(a, read_trials({a}));
  EXPECT_EQ(refusal_of({a / "trials.jsonl", a}), (a / "trials" / "clean-good-off1-raven2-000003.json").string() +
                                                     ": is the same trial as " + a.string() +
                                                     "/trials.jsonl:1; remove one of them, or leave out its folder");
}

TEST(TrialsOfAFile, AreRefusedWithTheirLine) {
  const fs::path a = folder("a");
  const std::string good = result_line(trial(Kind::clean, {}, {}));
  EXPECT_NE(refusal_of({write_lines(a, good + "\n{}\n")}).find("trials.jsonl:2: not a result of a blind trial ("),
            std::string::npos)
      << refusal_of({a / "trials.jsonl"});
}

TEST(TrialsOfFolders, HaveToBeThere) {
  EXPECT_NE(refusal_of({folder("a") / "absent"}).find("holds no trials"), std::string::npos);
}

}  // namespace
}  // namespace halyard::blind
