#include "diagnosis/record/sampled_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Readings of a parabola at uneven times, with holes.
struct Uneven {
  std::vector<double> time, x;

  static double parabola(double t) { return 3 - 2 * t + 0.5 * t * t; }
  Uneven() {
    for (int i = 0; i < 200; ++i) {
      if (i > 60 && i < 110) continue;
      time.push_back(0.01 * i + 0.004 * std::sin(0.9 * i));
      x.push_back(i % 7 == 0 ? kNone : parabola(time.back()));
    }
  }
};

TEST(SampledColumn, IsAParabolaBetweenUnevenReadingsOfAParabola) {
  const Uneven u;
  const SampledColumn column(u.time, u.x);
  // From the second reading to the last but one: at the ends the slope is that of a chord.
  for (double t = 0.04; t < 1.9; t += 0.0007) EXPECT_NEAR(column.at(t), Uneven::parabola(t), 1e-12) << t;
}

TEST(SampledColumn, HasItsReadingsAndKeepsTheFirstAndTheLastBeyondThem) {
  const Uneven u;
  const SampledColumn column(u.time, u.x);
  const std::vector<SensorSample> samples = column.samples();
  ASSERT_GT(samples.size(), 100U);
  for (const SensorSample& s : samples) EXPECT_NEAR(column.at(s.time), s.value, 1e-12);
  EXPECT_NEAR(column.at(-1), samples.front().value, 1e-12);
  EXPECT_NEAR(column.at(5), samples.back().value, 1e-12);
}

TEST(SampledColumn, TellsTheHoleAroundATimeAndTheNearestReading) {
  const std::vector<double> time = {0, 1, 2, 3, 4, 5, 6}, x = {0, 1, kNone, kNone, 4, 5, 6};
  const SampledColumn column(time, x);
  EXPECT_EQ(column.hole_at(0), 0) << "a reading";
  EXPECT_EQ(column.hole_at(4), 0) << "a reading";
  EXPECT_EQ(column.hole_at(0.5), 1);
  EXPECT_EQ(column.hole_at(2), 3);
  EXPECT_EQ(column.hole_at(5.9), 1);
  EXPECT_TRUE(std::isinf(column.hole_at(-0.1)));
  EXPECT_TRUE(std::isinf(column.hole_at(6.1)));
  EXPECT_EQ(column.hole_at(6), 0);
  EXPECT_EQ(column.distance(2), 1);
  EXPECT_EQ(column.distance(3.5), 0.5);
  EXPECT_EQ(column.distance(5), 0);
  EXPECT_EQ(column.distance(-2), 2);
  EXPECT_EQ(column.distance(7.5), 1.5);
}

TEST(SampledColumn, ATimeThatIsAReadingsButForRoundingIsInNoHole) {
  const SampledColumn column({0, 1, 2, 5, 6, 7}, {0, 1, 2, 5, 6, 7});
  for (const double near : {2 - 1e-9, 2 + 1e-9, 5 - 1e-9, 5 + 1e-9}) EXPECT_EQ(column.hole_at(near), 0) << near;
  for (const double apart : {2.05, 4.95}) EXPECT_EQ(column.hole_at(apart), 3) << apart;
}

TEST(SampledColumn, ItsIntervalIsTheUsualOne) {
  EXPECT_EQ(SampledColumn({0, 1, 2, 3, 13, 14}, {0, 0, 0, 0, 0, 0}).interval(), 1);
  EXPECT_EQ(SampledColumn({0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, kNone, 0, kNone, 0, kNone, 0, kNone, 0}).interval(), 2);
}

TEST(SampledColumn, NeedsFourReadingsToInterpolate) {
  const std::vector<double> time = {0, 1, 2, 3};
  EXPECT_TRUE(SampledColumn(time, {1, 2, 3, 4}).is_there());
  EXPECT_EQ(SampledColumn(time, {1, 2, 3, 4}).at(0.5), 1.5);
  const SampledColumn few(time, {kNone, 2, 3, 4}), none(time, {kNone, kNone, kNone, kNone});
  EXPECT_FALSE(few.is_there());
  EXPECT_EQ(few.at(2.5), 2) << "the first";
  EXPECT_EQ(few.interval(), 0);
  EXPECT_EQ(none.at(1), 0);
}

TEST(SampledColumn, EndsAreStraightAndTheRestIsSmooth) {
  // At the ends the slope is that of the chord; at each reading the slopes of both sides agree.
  const std::vector<double> time = {0, 0.7, 1.1, 2.3, 3, 4.2}, x = {1, 3, -2, 0.5, 0.4, 2};
  const SampledColumn column(time, x);
  constexpr double kSmall = 1e-6;
  EXPECT_NEAR((column.at(kSmall) - column.at(0)) / kSmall, (3 - 1) / 0.7, 1e-4);
  EXPECT_NEAR((column.at(4.2) - column.at(4.2 - kSmall)) / kSmall, (2 - 0.4) / 1.2, 1e-4);
  for (std::size_t i = 1; i + 1 < time.size(); ++i)
    EXPECT_NEAR((column.at(time[i] + kSmall) - column.at(time[i])) / kSmall,
                (column.at(time[i]) - column.at(time[i] - kSmall)) / kSmall, 1e-3)
        << i;
}

TEST(SampledColumn, FindsItsPlaceHoweverUnevenTheReadings) {
  // A thousand readings within a second, then one each second: a place that is guessed is far off.
  std::vector<double> time, x;
  for (int i = 0; i < 1000; ++i) time.push_back(1e-3 * i);
  for (int i = 1; i < 1000; ++i) time.push_back(i);
  for (const double t : time) x.push_back(2 - 3 * t);
  const SampledColumn column(time, x);
  for (double t = 0.0004; t < 999; t *= 1.01) EXPECT_NEAR(column.at(t), 2 - 3 * t, 1e-11 * (1 + 3 * t)) << t;
}

}  // namespace
}  // namespace halyard
