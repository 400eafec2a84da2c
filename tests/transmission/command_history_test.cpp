#include "transmission/command_history.h"
#include "tests/support/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

TEST(CommandHistory, IsLinearBetweenTheMiddlesOfHoldsAndHeldOutside) {
  CommandHistory history(2, 10);
  EXPECT_EQ(history.at(0, 1.0), 0);  // nothing was ever commanded
  const double first[] = {1, -1}, second[] = {3, -2};
  history.push(0.5, first);
  EXPECT_EQ(history.at(1, 7.0), -1);
  history.push(1.0, second);
  EXPECT_EQ(history.at(0, 0.0), 1);
  EXPECT_EQ(history.at(0, 0.75), 1);  // held from 0.5 to 1
  EXPECT_EQ(history.at(0, 1.0), 2);
  EXPECT_EQ(history.at(1, 1.0), -1.5);
  EXPECT_EQ(history.at(0, 1.25), 3);  // the second hold is taken to be as long
  EXPECT_EQ(history.at(0, 9.0), 3);
}

TEST(CommandHistory, IsNeitherEarlyNorLateOnAverage) {
  CommandHistory history(1, 100);
  for (int i = 0; i <= 20; ++i) {
    const double value = 3.0 * i;  // a ramp, in steps
    history.push(i, &value);
  }
  double difference = 0;
  for (double t = 5 + 1.0 / 32; t < 9; t += 1.0 / 16) difference += history.at(0, t) - 3 * std::floor(t);
  EXPECT_NEAR(difference, 0, 64 * 27 * kEps);
}

TEST(CommandHistory, GivesTheSlopeToDualAndEachTimeToItsLane) {
  CommandHistory history(1, 10);
  const double values[] = {0, 2, 1};
  for (int i = 0; i < 3; ++i) history.push(i * 0.5, values + i);
  const Dual d = history.at(0, Dual::seed(0.7, 1) * 2.0);  // at 1.4: after the last
  EXPECT_EQ(d.a, 1);
  EXPECT_EQ(d.d[1], 0);
  const Dual before = history.at(0, Dual::seed(-1.0, 2));
  EXPECT_EQ(before.a, 0);
  EXPECT_EQ(before.d[2], 0);
  const Dual inside = history.at(0, Dual(1.0) - Dual::seed(0.125, 3));  // at 0.875, a delay's derivative
  EXPECT_EQ(inside.a, 1.75);
  EXPECT_EQ(inside.d[3], 2);  // slope -2 N m/s, by minus the delay
  Lanes times;
  for (int l = 0; l < kLaneWidth; ++l) times.set(l, 0.15 * l);
  const Lanes at = history.at(0, times);
  for (int l = 0; l < kLaneWidth; ++l) EXPECT_EQ(at[l], history.at(0, times[l]));
}

TEST(CommandHistory, RemembersItsSpanAndForgetsWhatIsOlder) {
  const double span = 0.1, dt = 1e-3;
  CommandHistory history(1, span);
  for (int i = 0; i < 5000; ++i) {  // far beyond where memory is given back
    const double time = i * dt, command = time;
    history.push(time, &command);
    // Half a hold after a command was given it is in force on average.
    const double asked = std::max(0.5 * dt, time - span);
    ASSERT_NEAR(history.at(0, asked), asked - 0.5 * dt, 8 * kEps * time + 1e-300);
  }
  // What is older than the span is answered by the oldest that is left, at most two samples older.
  EXPECT_NEAR(history.at(0, 0.0), 4.999 - span, 2.01 * dt);
}

TEST(CommandHistory, ForgetsAllWhenItIsCleared) {
  CommandHistory history(1, 0.01);
  const double old = 5, first = 1, second = 3;
  for (int i = 0; i < 100; ++i) history.push(i * 1e-3, &old);
  history.clear();
  const Dual nothing = history.at(0, Dual::seed(0.05, 2));
  EXPECT_EQ(nothing.a, 0);
  EXPECT_EQ(nothing.d[2], 0);
  history.push(0, &first);  // earlier than what was forgotten
  EXPECT_EQ(history.at(0, 7.0), 1);
  history.push(1, &second);
  EXPECT_EQ(history.at(0, 1.0), 2);  // half way between the middles of both holds
}

}  // namespace
}  // namespace halyard
