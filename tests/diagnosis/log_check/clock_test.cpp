/// Times of a log: their order and unit, their number, missing rows and jitter.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/log_check/clock_check.h"
#include "tests/diagnosis/log_check/checked_logs.h"

namespace halyard {
namespace {

TEST(LogCheck, NamesTimesThatDoNotIncrease) {
  Log log = right_log();
  log.time[100] = log.time[99];
  expect_one(log, "time", Severity::gross, {"in sample 101", "do not increase"});
  for (std::size_t i = 500; i < log.size(); ++i) log.time[i] -= 3;
  expect_one(log, "time", Severity::gross, {"the first of 2 times"});
}

TEST(LogCheck, NamesTheUnitOfTimes) {
  for (const auto& [factor, unit] :
       {std::pair(1e3, "unit=ms"), {1e6, "unit=us"}, {1e9, "scale=1e-09"}, {1. / 60, "scale=60"}}) {
    Log log = right_log();
    for (double& t : log.time) t *= factor;
    expect_one(log, "time", Severity::gross, {option("time", unit)});
  }
}

TEST(LogCheck, ReportsMissingRowsAndJitter) {
  Log log = slice(right_log(), 0, 1);
  for (std::size_t i = 1; i < right_log().size(); ++i) {
    if (i > 2000 && i < 2050) continue;
    const Log row = slice(right_log(), i, i + 1);
    log.time.push_back(row.time[0]);
    for (const auto signal : {&Log::motor_torque, &Log::motor_position, &Log::joint_position})
      for (int k = 0; k < 3; ++k) (log.*signal)[k].push_back((row.*signal)[k][0]);
  }
  expect_one(log, "time", Severity::suspicious, {"49 rows are missing in 1 gaps"});
  log = right_log();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> late(0, 0.8e-3);
  for (double& t : log.time) t += late(random);
  expect_one(log, "time", Severity::suspicious, {"jitters"});
}

TEST(TimeCheck, ProposesNoUnitInWhichTheLogWouldBeTooShort) {
  Log log(1);
  for (int i = 0; i < 600; ++i) log.time.push_back(0.2 * i);  // 0.12 s if these were milliseconds
  const std::vector<LogFinding> findings = check_times(log, first_joints(1), {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what.find("looks like"), std::string::npos) << findings[0].what;
  EXPECT_EQ(findings[0].remedy, "give the times in s, or a record with at least 10 samples a second");
}

/// The findings about the time of a log of that length and rate.
std::vector<LogFinding> told_of_time(double duration, double rate_hz) {
  Log log(1);
  for (int i = 0; i <= std::lround(duration * rate_hz); ++i) log.time.push_back(i / rate_hz);
  return found_by(check_length, log, first_joints(1));
}

TEST(TimeCheck, ALogThatIsTooShortForItsSamplesMayBeInMinutes) {
  const std::vector<LogFinding> both = told_of_time(0.25, 30e3);
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].severity, Severity::gross);
  EXPECT_EQ(both[0].what,
            "7501 samples in 0.25 s, one after 3.333e-05 s; expected at least 1.5 s, the shortest record from which a "
            "diagnosis learns; it looks like a time in minutes");
  EXPECT_EQ(both[0].remedy, "read it with " + option("time", "scale=60"));
}

TEST(TimeCheck, ALogThatIsOnlyShortOrOnlyFastIsSuspicious) {
  const std::vector<LogFinding> is_short = told_of_time(1.4, 1e3), slow = told_of_time(1.4, 20),
                                is_fast = told_of_time(2, 11e3);
  ASSERT_EQ(is_short.size(), 1u);
  EXPECT_EQ(is_short[0].severity, Severity::suspicious);
  EXPECT_EQ(is_short[0].remedy,
            "give a longer record; if the times are in minutes, read it with " + option("time", "scale=60"));
  ASSERT_EQ(slow.size(), 1u);
  EXPECT_EQ(slow[0].remedy, "give a longer record") << "20 samples a minute are too few";
  ASSERT_EQ(is_fast.size(), 1u);
  EXPECT_EQ(is_fast[0].severity, Severity::suspicious);
  EXPECT_NE(is_fast[0].what.find("expected at most 10000 samples a second"), std::string::npos) << is_fast[0].what;
  EXPECT_TRUE(told_of_time(1.5, 1e3).empty());
  EXPECT_TRUE(told_of_time(2, 9e3).empty());
}

TEST(TimeCheck, EstimatorsRunOverAShortLog) {
  Log log(1);
  for (int i = 0; i < 7500; ++i) log.time.push_back(i / 30e3);
  EXPECT_TRUE(check_times(log, first_joints(1), {}).empty());
}

TEST(TimeCheck, CountsEachMissingRow) {
  const auto told = [](double share) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> at_random(0, 1);
    Log log(1);
    int lost = 0, last = 0;
    for (int i = 0; i < 6000; ++i) {
      if (i > 0 && at_random(random) < share) continue;
      lost += i - last - (i > 0), last = i;
      log.time.push_back(0.002 * i);
    }
    const std::vector<LogFinding> findings = check_times(log, first_joints(1), {});
    const std::string expected = std::to_string(lost) + " rows are missing in ";
    return std::ranges::any_of(findings, [&](const LogFinding& f) { return f.what.starts_with(expected); });
  };
  for (const double share : {0.003, 0.03, 0.25}) EXPECT_TRUE(told(share)) << share;
}

TEST(TimeCheck, TakesARowThatIsWrittenLateForNoMissingOne) {
  Log log(1);
  for (int i = 0; i < 6000; ++i) log.time.push_back(0.002 * i + (i % 100 == 50 ? 0.0014 : 0));
  EXPECT_EQ(lines_of(check_times(log, first_joints(1), {})), "");
}

}  // namespace
}  // namespace halyard
