/// What is compared of logs that lost rows, or whose rows come in bursts.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "diagnosis/record/record.h"
#include "tests/diagnosis/fit/made_log.h"

namespace halyard {
namespace {

constexpr double kSettle = RecordOptions{}.settle_s;

/// Ten seconds of the first joint at 500 Hz from 0.1 s on, of which the rows i are kept that keeps(i).
Log swing_with(const std::function<bool(int)>& keeps) {
  const Log whole = log_along(10, 500, slow_swing);
  Log log(1);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!keeps(static_cast<int>(i))) continue;
    log.time.push_back(0.1 + whole.time[i]);
    log.motor_position[0].push_back(whole.motor_position[0][i]);
    log.joint_position[0].push_back(whole.joint_position[0][i]);
    log.motor_torque[0].push_back(0.05);
  }
  return log;
}

/// A log that lost this share of its rows at random.
Log that_lost(double share) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at_random(0, 1);
  return swing_with([&](int) { return at_random(random) >= share; });
}

/// Shares of the settled time.
struct Shares {
  double measured = 0, compared = 0;
};

Shares shares_of(const Log& log) {
  Shares shares;
  for (const Record& r : make_records(log, first_joints(1), {})) {
    const double settled = (log.duration() - kSettle) / r.dt;
    for (std::size_t i = 0; i < r.size; ++i) {
      shares.measured += r.joint_measured[0][i] / settled;
      shares.compared += r.joint_valid[0][i] / settled;
    }
  }
  return shares;
}

TEST(LostRows, LeaveTheReadingsBesideThem) {
  // The grid's times differ from the log's by rounding.
  for (const double share : {0.05, 0.15}) EXPECT_NEAR(shares_of(that_lost(share)).measured, 1 - share, 0.02) << share;
}

TEST(LostRows, DoNotKeepTheOthersFromBeingCompared) {
  // The comparing kernel sees some 14 rows: by chance it sees less than 70 % of the usual number now and then.
  for (const double share : {0.15, 0.25, 0.35, 0.45, 0.55})
    EXPECT_GT(shares_of(that_lost(share)).compared, 0.85) << share;
}

TEST(LostRows, OfWhichManyFollowEachOtherAreAHole) {
  const Shares shares = shares_of(swing_with([](int i) { return i < 2500 || i >= 2520; }));
  // Of the hole of 40 ms, the comparing kernel of 8 ms sees too little in all but its edges.
  EXPECT_LT(shares.compared, 1 - 0.02 / 10);
}

TEST(Bursts, AreCompared) {
  // Five rows every 10 ms, written 0.1 ms after each other. The first burst may lack rows.
  for (const int first : {0, 3}) {
    Log log(1);
    for (int i = first; i < 5000; ++i) {
      const double t = 0.01 * (i / 5) + 1e-4 * (i % 5);
      log.time.push_back(t);
      const double q = slow_swing(t);
      const JointParameters<double> j = first_joints(1).nominal.joint[0];
      log.motor_position[0].push_back(q * j.pulley_radius / j.motor_travel());
      log.joint_position[0].push_back(q);
    }
    EXPECT_GT(shares_of(log).compared, 0.9) << first;
  }
}

}  // namespace
}  // namespace halyard
