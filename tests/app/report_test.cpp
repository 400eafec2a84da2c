#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>

#include "app/report/chart.h"
#include "app/report/escaped.h"
#include "app/report/page.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using report::Chart;
using report::ChartKind;
using report::Page;
using report::Series;

Chart line_chart(std::vector<double> x, std::vector<double> y) {
  Chart chart{.title = "residual", .x_label = "time [s]", .y_label = "position [m]"};
  chart.series.push_back(Series{.name = "ekf", .x = std::move(x), .y = std::move(y)});
  return chart;
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "(no exception)";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

bool contains(const std::string& text, const std::string& part) { return count(text, part) > 0; }

TEST(ReportPage, EscapesTextEverywhere) {
  const std::string nasty = "<b>&\"'";
  const std::string safe = "&lt;b&gt;&amp;&quot;&#39;";
  Page page(nasty, nasty);
  page.heading(nasty);
  page.paragraph(nasty);
  page.verdict(report::VerdictKind::good, nasty);
  page.table({.caption = nasty, .header = {nasty}, .rows = {{nasty}}});
  Chart chart = line_chart({0, 1}, {0, 1});
  chart.title = nasty;
  page.chart(chart);
  const std::string html = page.html();
  EXPECT_FALSE(contains(html, "<b>"));
  // title, h1, subtitle, h2, p, verdict, caption, th, td, figure caption, canvas label
  EXPECT_EQ(count(html, safe), 11u);
}

TEST(ReportPage, ItemsOfAVerdictAreAListBelowItsHeadline) {
  Page page("t", "");
  page.verdict(report::VerdictKind::good, "The model lacks:", {"a & b", "c"});
  EXPECT_TRUE(contains(page.html(), "<p>The model lacks:</p>\n<ul><li>a &amp; b</li>\n<li>c</li>\n</ul></div>"));
}

TEST(ReportPage, AChangeByMoreThanATenthIsMarkedForBetterOrForWorse) {
  const auto change = [](double after) { return report::Cell::of_change("x", 10, after); };
  EXPECT_TRUE(change(8.9).best);
  EXPECT_TRUE(change(11.1).worse);
  for (const double same : {9.1, 10.9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(change(same).best) << same;
    EXPECT_FALSE(change(same).worse) << same;
  }
  Page page("t", "");
  page.table({.caption = "c", .header = {"h"}, .rows = {{change(11.1)}}});
  EXPECT_TRUE(contains(page.html(), "<td class=\"left worse\">x</td>"));
}

TEST(ReportPage, LinksLeadFromParagraphsAndCellsAndAreEscaped) {
  Page page("t", "");
  page.link("a & b", "x/\"y\".html");
  page.table({.caption = "c", .header = {"h"}, .rows = {{report::Cell::link("rig", "rig/report.html")}, {"plain"}}});
  const std::string html = page.html();
  EXPECT_TRUE(contains(html, "<p><a href=\"x/&quot;y&quot;.html\">a &amp; b</a></p>"));
  EXPECT_TRUE(contains(html, "<td class=\"left\"><a href=\"rig/report.html\">rig</a></td>"));
  EXPECT_EQ(count(html, "<a href="), 2u);
}

TEST(ReportPage, DataCannotCloseTheirScriptElement) {
  Chart chart = line_chart({0, 1}, {0, 1});
  const std::string nasty = "</script><!-- <script>";
  chart.x_label = nasty;
  chart.series[0].name = nasty;
  EXPECT_FALSE(contains(to_json(chart), "<"));
  EXPECT_EQ(nlohmann::json::parse(to_json(chart))["series"][0]["name"], nasty);
}

TEST(ReportPage, InvalidUtf8DoesNotThrow) {
  Chart chart = line_chart({0}, {0});
  chart.series[0].name = "log\xff.csv";
  EXPECT_EQ(nlohmann::json::parse(to_json(chart))["series"][0]["name"], "log\uFFFD.csv");
}

TEST(ReportPage, TextThatIsNoUtf8IsMarked) {
  EXPECT_EQ(report::escaped("caf\xe9 <\x1b[31m> \u00e9"), "caf\uFFFD &lt;\uFFFD[31m&gt; \u00e9");
}

TEST(ReportPage, SameCallsGiveSameBytes) {
  const auto make = [] {
    Page page("report", "twice");
    page.chart(line_chart({0, 0.1, 0.3}, {1.0 / 3, kNan, 2e-300}));
    page.figure_row({report::histogram("h", "e [m]", {{"a", {1, 2, 2, 3}}}, 3)});
    return page.html();
  };
  EXPECT_EQ(make(), make());
}

TEST(ReportPage, LoadsNothingFromElsewhere) {
  Page page("report", "");
  page.chart(line_chart({0, 1}, {0, 1}));
  const std::string html = page.html();
  // Addresses stand in Chart.js's licence comment; none may be in a place that makes a browser load it.
  for (const char* loading : {"src=", "url(", "@import", "fetch(", "XMLHttpRequest", "<iframe", "import("}) {
    EXPECT_FALSE(contains(html, loading)) << loading;
  }
  EXPECT_EQ(count(html, "href="), 1u);
  EXPECT_TRUE(contains(html, "href=\"data:,\""));
  EXPECT_TRUE(contains(html, "default-src 'none'"));
}

TEST(ReportPage, EmbedsChartJsOnce) {
  Page page("report", "");
  for (int i = 0; i < 3; ++i) page.chart(line_chart({0, 1}, {0, 1}));
  EXPECT_EQ(count(page.html(), "Chart.js v"), 1u);
  EXPECT_EQ(count(page.html(), "</script>"), 3u + 2u);  // data of each, Chart.js, page.js
}

TEST(ReportPage, TableOfUnevenRowsIsRefused) {
  Page page("report", "");
  EXPECT_EQ(message_of([&] {
              page.table({.caption = "RMS", .header = {"a", "b"}, .rows = {{"1", "2"}, {"3"}}});
            }),
            "table \"RMS\": row 2 has 1 columns, expected 2 as in the header");
}

TEST(ReportPage, BestCellIsMarked) {
  Page page("report", "");
  page.table({.caption = "RMS", .header = {"name", "mm"}, .rows = {{"ekf", {"0.4", true}}, {"ukf", "0.5"}}});
  EXPECT_TRUE(contains(page.html(), "<td class=\"right best\">0.4</td>"));
  EXPECT_TRUE(contains(page.html(), "<td class=\"right\">0.5</td>"));
}

TEST(ReportChart, GapsAreNullAndNumbersShort) {
  const auto series = nlohmann::json::parse(
      to_json(line_chart({0, 1, 2}, {kNan, std::numeric_limits<double>::infinity(), 1.0 / 3})))["series"][0];
  EXPECT_EQ(series["y"].dump(), "[null,null,0.333333333333]");
}

TEST(ReportChart, ABandThatReachesZeroIsDrawnOnALogarithmicAxis) {
  Chart chart = line_chart({1, 2}, {1, 2});
  chart.series[0].band = report::Band{{-1, 1.5}, {2, 3}};
  const auto lower = [&] { return nlohmann::json::parse(to_json(chart))["series"][0]["lower"]["y"]; };
  EXPECT_EQ(lower(), (std::vector<double>{-1, 1.5}));
  chart.log_y = true;
  EXPECT_EQ(lower(), (std::vector<double>{0.1, 1.5}));
}

TEST(ReportChart, LengthsThatDoNotMatchNameTheSeries) {
  EXPECT_EQ(message_of([] {
              to_json(line_chart({0, 1}, {0}));
            }),
            "chart \"residual\", series \"ekf\": 1 values of y, expected 2, one per x");

  Chart banded = line_chart({0, 1}, {0, 1});
  banded.series[0].band = report::Band{.lower = {0, 0}, .upper = {1}};
  EXPECT_EQ(message_of([&] { to_json(banded); }),
            "chart \"residual\", series \"ekf\": 1 values of band.upper, expected 2, one per x");

  Chart bars{.title = "RMS", .kind = ChartKind::bar, .categories = {"1", "2"}};
  bars.series.push_back({.name = "ekf", .y = {1}});
  EXPECT_EQ(message_of([&] { to_json(bars); }),
            "chart \"RMS\", series \"ekf\": 1 values of y, expected 2, one per category");
}

TEST(Decimation, KeepsEveryPeakOfAnyStretch) {
  const std::size_t n = 100'000;
  std::vector<double> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = 1e-3 * static_cast<double>(i);
    y[i] = std::sin(x[i]);
  }
  y[1'234] = 50;  // one sample wide
  y[77'777] = -60;
  const auto drawn = report::decimate(x, y);
  EXPECT_LE(drawn.y.size(), report::kDrawnPoints);
  EXPECT_EQ(*std::max_element(drawn.y.begin(), drawn.y.end()), 50);
  EXPECT_EQ(*std::min_element(drawn.y.begin(), drawn.y.end()), -60);
  EXPECT_TRUE(std::is_sorted(drawn.x.begin(), drawn.x.end()));
  EXPECT_EQ(drawn.x.front(), x.front());
  EXPECT_EQ(drawn.x.back(), x.back());
}

TEST(Decimation, KeepsTheEndsOfALoopInX) {
  const std::size_t n = 10'000;
  std::vector<double> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = std::sin(0.01 * static_cast<double>(i));
    y[i] = std::cos(0.01 * static_cast<double>(i));
  }
  const auto drawn = report::decimate(x, y);
  EXPECT_EQ(*std::max_element(drawn.x.begin(), drawn.x.end()), *std::max_element(x.begin(), x.end()));
  EXPECT_EQ(*std::min_element(drawn.x.begin(), drawn.x.end()), *std::min_element(x.begin(), x.end()));
}

TEST(Decimation, KeepsAGapOfOneSample) {
  std::vector<double> x(10'000), y(10'000, 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  y[5'000] = kNan;
  const auto drawn = report::decimate(x, y);
  ASSERT_EQ(std::count_if(drawn.y.begin(), drawn.y.end(), [](double v) { return std::isnan(v); }), 1);
  const auto gap = std::find_if(drawn.y.begin(), drawn.y.end(), [](double v) { return std::isnan(v); });
  EXPECT_EQ(drawn.x[static_cast<std::size_t>(gap - drawn.y.begin())], 5'000);
}

TEST(Decimation, LeavesAShortSeriesAlone) {
  const std::vector<double> x = {0, 1, 2, 3}, y = {5, kNan, 7, 8};
  EXPECT_EQ(report::decimate(x, y, 4).x, x);
  EXPECT_EQ(report::decimate(x, y, 4).y.size(), 4u);
}

TEST(Thinning, KeepsDensityAndOutliers) {
  // Half of the samples at 0, the others evenly over 0..1.
  const std::size_t n = 50'000;
  std::vector<double> x(n), y(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) x[i] = i % 2 == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(n);
  x[31'001] = -7;
  y[31'003] = 9;
  const auto drawn = report::thin(x, y, 1'000);
  EXPECT_LE(drawn.x.size(), 1'000u);
  EXPECT_EQ(std::count(drawn.x.begin(), drawn.x.end(), -7), 1);
  EXPECT_EQ(std::count(drawn.y.begin(), drawn.y.end(), 9), 1);
  // 875 are evenly spaced, 57.14 apart, so odd and even alternate but for a few; at most 125 more are extremes.
  EXPECT_NEAR(static_cast<double>(std::count(drawn.x.begin(), drawn.x.end(), 0.0)), 0.5 * 875, 125);
}

TEST(Histogram, SharesOfEachSampleAddUpToHundred) {
  const Chart chart = report::histogram("h", "e [m]", {{"a", {0, 1, 2, 3, 4, kNan}}, {"b", {4, 4}}}, 4);
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  EXPECT_EQ(chart.series[0].y, (std::vector<double>{20, 20, 20, 40}));
  EXPECT_EQ(chart.series[1].y, (std::vector<double>{0, 0, 0, 100}));
}

TEST(Histogram, OneValueOrNoneIsDrawnToo) {
  const Chart one = report::histogram("h", "e [m]", {{"a", {2, 2}}}, 2);
  EXPECT_EQ(one.series[0].x, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(one.series[0].y, (std::vector<double>{0, 100}));
  EXPECT_TRUE(report::histogram("h", "e [m]", {{"a", {}}}, 2).series[0].x.empty());
  EXPECT_THROW(report::histogram("h", "e [m]", {}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace halyard
