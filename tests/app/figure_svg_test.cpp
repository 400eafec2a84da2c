/// Static pictures: places of points, gaps, scales, colours.

#include "app/report/figure_svg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/report/svg_axis.h"
#include "app/report/svg_text.h"

namespace halyard::report {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Chart line_of(std::vector<double> x, std::vector<double> y) {
  Chart chart{.title = "a < b & c", .x_label = "x [m]", .y_label = "y [s]"};
  chart.series = {{.name = "curve", .x = std::move(x), .y = std::move(y)}};
  return chart;
}

TEST(SvgAxis, GivesRoundTicks) {
  const std::vector<double> even = {0.03, 0.97};
  EXPECT_EQ(SvgAxis(even, false, true).ticks(), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
  EXPECT_FALSE(std::signbit(SvgAxis(even, false, true).ticks().front())) << "written as -0";
  const std::vector<double> decade = {1, 10}, decades = {1e-3, 1e2};
  EXPECT_EQ(SvgAxis(decade, true, false).ticks(), (std::vector<double>{1, 2, 5, 10}));
  const std::vector<double> powers = SvgAxis(decades, true, false).ticks();
  ASSERT_EQ(powers.size(), 6u);
  EXPECT_DOUBLE_EQ(powers.front(), 1e-3);
  EXPECT_DOUBLE_EQ(powers.back(), 1e2);
}

TEST(SvgAxis, HasTicksAlsoWithinLessThanADecade) {
  const std::vector<double> narrow = {2.1, 4.5}, zero = {0, 0};
  EXPECT_EQ(SvgAxis(narrow, true, false).ticks(), (std::vector<double>{2.5, 3, 3.5, 4, 4.5}));
  EXPECT_EQ(SvgAxis(zero, false, false).ticks().front(), 0) << "a count is not negative";
}

TEST(SvgNumbers, DifferWhereTheNumbersDo) {
  const std::vector<double> close = {1000, 1000.5, 1001}, plain = {0, 0.02, 30000, 2.5e6, 3.16e-4};
  EXPECT_EQ(svg_numbers(close), (std::vector<std::string>{"1000", "1000.5", "1001"}));
  EXPECT_EQ(svg_numbers(plain), (std::vector<std::string>{"0", "0.02", "30000", "2.5e6", "3.16e-4"}));
}

TEST(SvgAxis, TakesNumbersThatDifferByARoundingForOne) {
  const std::vector<double> numbers = {3.1e-4, 3.1000000000000005e-4};
  ASSERT_NE(numbers[0], numbers[1]);
  const SvgAxis axis(numbers, false, false);
  EXPECT_NEAR(axis.place(numbers[0]), 0.5, 1e-9);
  EXPECT_LT(axis.ticks().size(), 20u);
}

TEST(SvgAxis, PlacesNumbersEvenlyOrByTheirLogarithm) {
  const std::vector<double> numbers = {1, 100};
  EXPECT_DOUBLE_EQ(SvgAxis(numbers, false, false).place(50.5), 0.5);
  EXPECT_DOUBLE_EQ(SvgAxis(numbers, true, false).place(10), 0.5);
  EXPECT_TRUE(std::isnan(SvgAxis(numbers, true, false).place(0)));
  const std::vector<double> one = {5};
  EXPECT_DOUBLE_EQ(SvgAxis(one, false, false).place(5), 0.5) << "a single number has room around it";
}

TEST(FigureSvg, DrawsALineForEachPieceBetweenGaps) {
  const std::string whole = figure_svg({{line_of({0, 1, 2, 3, 4}, {0, 1, 2, 1, 0})}});
  EXPECT_EQ(count(whole, "<polyline"), 1u);
  const std::string broken = figure_svg({{line_of({0, 1, 2, 3, 4}, {0, 1, kGap, 1, 0})}});
  EXPECT_EQ(count(broken, "<polyline"), 2u);
  EXPECT_EQ(count(broken, "nan"), 0u);
}

TEST(FigureSvg, ShowsAPointBetweenGaps) {
  const std::string svg = figure_svg({{line_of({0, 1, 2, 3, 4}, {0, 1, kGap, 1, kGap})}});
  EXPECT_EQ(count(svg, "<polyline"), 1u);
  EXPECT_EQ(count(svg, "<circle"), 1u);
  // Three quarters of the panel's width from its left side, at its top.
  EXPECT_EQ(count(svg, "<circle cx=\"243.0\" cy=\"56.0\" r=\"1.8\" fill=\"#0072B2\"/>"), 1u) << svg;
}

TEST(FigureSvg, NamesUnitsAndEachSeriesOnceAndEscapesText) {
  const std::string svg = figure_svg({{line_of({0, 1}, {0, 1}), line_of({0, 1}, {1, 0})}});
  EXPECT_EQ(count(svg, ">curve</text>"), 1u);
  EXPECT_EQ(count(svg, ">x [m]</text>"), 2u);
  EXPECT_EQ(count(svg, ">y [s]</text>"), 2u);
  EXPECT_EQ(count(svg, "a &lt; b &amp; c"), 2u);
  EXPECT_TRUE(svg.starts_with("<svg xmlns="));
}

TEST(FigureSvg, DrawsTheBandOfASeries) {
  Chart chart = line_of({0, 1}, {1, 2});
  EXPECT_EQ(count(figure_svg({{chart}}), "<polygon"), 0u);
  chart.series[0].band = Band{{0.5, 1.5}, {1.5, 2.5}};
  EXPECT_EQ(count(figure_svg({{chart}}), "<polygon"), 1u);
  chart.series[0].band->upper.pop_back();
  EXPECT_THROW(figure_svg({{chart}}), std::invalid_argument);
}

TEST(HeatMapSvg, GivesTheEndsOfItsScaleToTheLeastAndTheGreatestValue) {
  HeatMap map{.title = "map", .x_label = "x", .y_label = "y", .value_label = "v [deg]"};
  map.x = {1, 2}, map.y = {3};
  map.value = {10, 30};
  const std::string both = heat_map_svg({{map}});
  EXPECT_EQ(count(both, "#440154"), 1u);
  EXPECT_EQ(count(both, "#fde725"), 1u);
  EXPECT_EQ(count(both, ">v [deg]</text>"), 1u);
  map.value[1] = kGap;
  EXPECT_EQ(count(heat_map_svg({{map}}), "#fde725"), 0u) << "an empty cell";
  map.value.pop_back();
  EXPECT_THROW(heat_map_svg({{map}}), std::invalid_argument);
}

}  // namespace
}  // namespace halyard::report
