/// Readings that are outliers, and what resembles them.

#include "diagnosis/log_check/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace halyard {
namespace {

constexpr double kFactor = OutlierRule{}.factor, kStep = 1e-3;

/// A second of a slow motion at 1 kHz with noise of 1e-4.
struct Column {
  std::vector<double> time, x;
  explicit Column(double rate = 1) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise(0, 1e-4);
    for (int i = 0; i < 1000; ++i) {
      time.push_back(kStep * i);
      x.push_back(rate * std::sin(2 * time.back()) + noise(random));
    }
  }
  Outliers outliers() const { return find_outliers(time, x, kFactor); }
  /// Adds to the rows from..to-1.
  void add(std::size_t from, std::size_t to, double change) {
    for (std::size_t i = from; i < to; ++i) x[i] += change;
  }
};

using Rows = std::vector<std::size_t>;

TEST(Outliers, AreNotFoundInNoise) { EXPECT_EQ(Column().outliers().readings, 0u); }

TEST(Outliers, AreFoundSinglyAndUpToThreeInARow) {
  Column c;
  c.add(100, 101, 0.01);
  c.add(300, 302, -0.05);
  c.add(500, 503, 0.02);
  const Outliers found = c.outliers();
  EXPECT_EQ(found.rows, (Rows{100, 300, 301, 500, 501, 502}));
  EXPECT_EQ(found.readings, 6u);
  EXPECT_NEAR(found.largest, -0.05, 1e-3);
  EXPECT_EQ(found.when, 0.3);
  EXPECT_NEAR(found.usual, 1e-4, 5e-5);
}

TEST(Outliers, AreFoundIfOneReadingInThirtyIsWrong) {
  Column c;
  Rows wrong;
  for (std::size_t i = 20; i < 980; i += 30) c.add(i, i + 1, i % 60 == 20 ? 0.3 : -0.3), wrong.push_back(i);
  EXPECT_EQ(c.outliers().rows, wrong);
}

TEST(Outliers, AreFoundInAFastMotion) {
  Column c(100);  // 0.2 from a row to the next
  c.add(100, 101, 2.5);
  EXPECT_EQ(c.outliers().rows, Rows{100});
}

TEST(Outliers, AreFoundInAJointAtRest) {
  Column c;
  std::fill(c.x.begin() + 400, c.x.begin() + 900, c.x[399]);
  c.add(600, 601, 0.01);
  c.add(650, 651, 0.01);
  EXPECT_EQ(c.outliers().rows, (Rows{600, 650}));
}

TEST(Outliers, OfASlowSensorFillAllItsRows) {
  Column c;
  for (std::size_t i = 0; i < c.x.size(); ++i) c.x[i] = c.x[i - i % 10];
  c.add(500, 510, 0.05);
  const Outliers found = c.outliers();
  EXPECT_EQ(found.readings, 1u);
  EXPECT_EQ(found.rows.size(), 10u);
  EXPECT_EQ(found.rows.front(), 500u);
}

TEST(Outliers, AreNotStepsPushesOrVibrations) {
  Column step;
  step.add(500, 1000, 0.05);
  EXPECT_EQ(step.outliers().readings, 0u);
  Column push;  // away and back within 40 ms
  for (std::size_t i = 0; i < 40; ++i)
    push.x[500 + i] += 0.05 * std::sin(std::numbers::pi * static_cast<double>(i) / 40);
  EXPECT_EQ(push.outliers().readings, 0u);
  Column vibration;  // 100 Hz, dies out within 20 ms
  for (std::size_t i = 0; i < 100; ++i)
    vibration.x[500 + i] +=
        0.05 * std::exp(-0.05 * static_cast<double>(i)) * std::sin(0.2 * std::numbers::pi * static_cast<double>(i));
  EXPECT_EQ(vibration.outliers().readings, 0u);
}

TEST(Outliers, AreNotRightReadingsBesideLostRows) {
  const Column all(20);
  Column kept(20);
  kept.time.clear(), kept.x.clear();
  const Rows lost = {201, 202, 204, 205, 206, 209};
  std::size_t beside = 0;
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    if (std::ranges::count(lost, i) > 0) continue;
    if (i == 207) beside = kept.x.size();
    kept.time.push_back(all.time[i]), kept.x.push_back(all.x[i]);
  }
  EXPECT_EQ(kept.outliers().rows, Rows{});
  kept.x[beside] += 1;
  EXPECT_EQ(kept.outliers().rows, Rows{beside}) << "a wrong one is";
}

TEST(Outliers, AreNotReadingsOfASensorWhoseRowsComeLate) {
  Column c(20);  // 700 Hz, whose readings are held until the next and begin with a row of 1 kHz
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    const double t = std::floor(c.time[i] * 700) / 700;
    c.x[i] = 20 * std::sin(2 * t);
  }
  EXPECT_EQ(c.outliers().rows, Rows{});
}

TEST(Outliers, AreNotReadingsWhoseTimesJitter) {
  Column c(20);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> late(0, 0.8 * kStep);
  for (std::size_t i = 0; i < c.x.size(); ++i) c.x[i] = 20 * std::sin(2 * c.time[i]);
  for (double& t : c.time) t += late(random);
  EXPECT_EQ(c.outliers().rows, Rows{});
}

TEST(Outliers, LeaveEmptyCellsAndNothingElse) {
  Log log(1);
  const Column c;
  log.time = c.time;
  log.motor_position[0] = log.joint_position[0] = log.motor_torque[0] = c.x;
  log.joint_position[0][200] += 0.1;
  log.motor_torque[0][300] += 0.1;  // a peak of a drive's current
  log.motor_torque[0][700] += 1;
  const Log kept = without_outliers(log);
  EXPECT_EQ(kept.motor_position, log.motor_position);
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    EXPECT_EQ(std::isnan(kept.joint_position[0][i]), i == 200) << i;
    // The motion's filter reaches four times 1 / (2π 60 Hz) = 10.6 ms.
    EXPECT_EQ(std::isnan(kept.motor_torque[0][i]), i >= 690 && i <= 710) << i;
  }
}

}  // namespace
}  // namespace halyard
