#include "evaluation/sweep/sweep_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// One estimator at one joint, shown in the unit that it is measured in.
SweepGrid grid_over(const std::vector<SweepAxis>& axes) {
  SweepGrid grid;
  grid.axes = axes;
  grid.estimators = {"kinematics"};
  grid.units = {{"rad", "rad", 1}};
  return grid;
}

/// All its measured columns are `error`.
SweepCell cell_of(const SweepGrid& grid, std::size_t point, double error, const std::string& failure = "") {
  return {point, {{failure, {std::vector<double>(grid.n_columns(), error)}}}};
}

SweepAxis axis_of(const std::vector<double>& values) {
  return {.parameters = {"joint1.cable.stiffness"}, .unit = "N/m", .values = values};
}

TEST(SweepSummary, ACurveAveragesOverTheOtherAxes) {
  const SweepGrid grid = grid_over({axis_of({3, 1}), axis_of({10, 20})});
  SweepSummary summary(grid);
  for (std::size_t p = 0; p < grid.size(); ++p) summary.add(cell_of(grid, p, static_cast<double>(p)));
  const SweepSummary::Curve& first = summary.curve(0, 0, 0, 0);
  EXPECT_EQ(first.x, (std::vector<double>{1, 3})) << "in increasing order";
  EXPECT_EQ(first.means[0].mean(), 2.5) << "of points 2 and 3";
  EXPECT_EQ(first.means[1].mean(), 0.5) << "of points 0 and 1";
  EXPECT_EQ(first.means[0].least(), 2);
  EXPECT_EQ(first.means[0].greatest(), 3);
  const SweepSummary::Curve& second = summary.curve(0, 1, 0, 0);
  EXPECT_EQ(second.means[0].mean(), 1);
  EXPECT_EQ(second.means[1].mean(), 2);
  EXPECT_EQ(summary.spans[0][0][0].least, 0);
  EXPECT_EQ(summary.spans[0][0][0].greatest, 3);
}

TEST(SweepSummary, OfAGridHasAPlaceForEachValue) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i);
  const SweepGrid grid = grid_over({axis_of(values)});
  SweepSummary summary(grid);
  for (std::size_t p = 0; p < grid.size(); ++p) summary.add(cell_of(grid, p, 2 * values[p]));
  const SweepSummary::Curve& curve = summary.curve(0, 0, 0, 0);
  ASSERT_EQ(curve.x, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(curve.means[i].mean(), 2 * values[i]);
    EXPECT_TRUE(std::isnan(curve.means[i].half_width())) << "no interval of a single run";
  }
}

TEST(SweepSummary, RepeatsOfASampleCountAsOneNumber) {
  SweepGrid grid = grid_over({axis_of({5, 5, 5}), axis_of({1, 2, 3})});  // all samples at one place of the first axis
  grid.is_sampled = true;
  grid.seeds = {7, 8};
  SweepSummary summary(grid);
  for (std::size_t p = 0; p < grid.size(); ++p)
    summary.add(cell_of(grid, p, 10 * static_cast<double>(p / 2) + static_cast<double>(p % 2)));
  const MeanWithInterval& mean = summary.curve(0, 0, 0, 0).means[0];
  EXPECT_EQ(mean.count(), 3u);
  EXPECT_EQ(mean.mean(), 10.5);
  EXPECT_EQ(mean.least(), 0.5);
  EXPECT_EQ(summary.spans[0][0][0].least, 0);
}

TEST(SweepSummary, ManyValuesOfALogarithmicAxisShareBinsOfEqualRatio) {
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) values.push_back(std::pow(10, 0.04 * i));  // 1 to 1e4
  SweepAxis axis = axis_of(values);
  axis.is_logarithmic = true;
  SweepGrid grid = grid_over({axis});
  grid.is_sampled = true;
  SweepSummary summary(grid);
  for (std::size_t p = 0; p < grid.size(); ++p) summary.add(cell_of(grid, p, std::log10(values[p])));
  const SweepSummary::Curve& curve = summary.curve(0, 0, 0, 0);
  ASSERT_EQ(curve.x.size(), 20u);
  std::size_t counted = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    EXPECT_NEAR(std::log10(curve.x[i]), 0.2 * (static_cast<double>(i) + 0.5), 1e-9);
    EXPECT_NEAR(curve.means[i].mean(), std::log10(curve.x[i]), 0.03);
    counted += curve.means[i].count();
  }
  EXPECT_EQ(counted, values.size()) << "the ends belong to bins, too";
}

TEST(SweepSummary, CountsFailuresAndLeavesThemOutOfCurves) {
  const SweepGrid grid = grid_over({axis_of({1, 2})});
  SweepSummary summary(grid);
  summary.add(cell_of(grid, 0, 4));
  summary.add(cell_of(grid, 1, kNone, "crashed"));
  EXPECT_EQ(summary.failures, 1u);
  const SweepSummary::Curve& curve = summary.curve(0, 0, 0, 0);
  EXPECT_EQ(curve.means[0].mean(), 4);
  EXPECT_EQ(curve.means[1].count(), 0u);
}

}  // namespace
}  // namespace halyard
