#include "diagnosis/record/sampled_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace halyard {
namespace {

/// Readings of a parabola at uneven times, with holes.
struct Uneven {
  std::vector<double> time, x;

  static double parabola(double t) { return 3 - 2 * t + 0.5 * t * t; }
  Uneven() {
    for (int i = 0; i < 200; ++i) {
      if (i > 60 && i < 110) continue;
      time.push_back(0.01 * i + 0.004 * std::sin(0.9 * i));
      x.push_back(i % 7 == 0 ? std::numeric_limits<double>::quiet_NaN() : parabola(time.back()));
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

}  // namespace
}  // namespace halyard
