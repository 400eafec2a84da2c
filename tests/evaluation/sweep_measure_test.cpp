/// What a sweep measures.

#include "evaluation/sweep/measures/sweep_measure.h"

#include <gtest/gtest.h>

#include "evaluation/comparison/compare.h"
#include "evaluation/sweep/sweep_grid.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

/// A run whose numbers all differ.
Comparison comparison_of_one_joint() {
  Comparison c;
  c.errors = {{{.samples = 1, .mean_absolute = 2, .rms = 3, .peak = 4, .bias = 5, .within_two_std = 6}}};
  c.judgements.resize(1);
  c.judgements[0].nees = {{.mean = 7, .lower = 8, .upper = 9, .samples = 10}};
  c.runs.resize(1);
  c.runs[0].report = {.steps = 11, .repaired_factors = 13, .gated = 12};
  c.runs[0].microseconds_per_step = 14;
  return c;
}

TEST(SweepMeasure, TakesEachColumnFromTheComparison) {
  const Comparison comparison = comparison_of_one_joint();
  std::vector<double> values;
  std::vector<std::string> names;
  for (const SweepMeasure& measure : sweep_measures())
    for (const MeasuredColumn& column : measure.columns) {
      values.push_back(column.value(comparison, 0));
      names.push_back(column.name);
    }
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}));
  EXPECT_EQ(names, (std::vector<std::string>{"samples", "mean_absolute_error", "rms_error", "peak_error", "bias",
                                             "within_two_std", "mean_nees", "nees_band_lower", "nees_band_upper",
                                             "nees_independent_samples", "steps", "gated_measurements",
                                             "repaired_factors", "microseconds_per_step"}));
}

TEST(SweepMeasure, IsShownInItsUnit) {
  SweepGrid grid;
  grid.units = {{"rad", "deg", 57}};
  grid.estimators = {"kinematics"};
  grid.measures = parse_measures("errors,nees,counts,time");
  std::vector<std::string> units;
  for (std::size_t m = 0; m < 4; ++m) units.push_back(grid.shown_unit(m, 0, 0).shown);
  EXPECT_EQ(units, (std::vector<std::string>{"deg", "", "", "us"}));
  grid.effects = {{"backlash", "half_gap", {"m"}}, {"hysteresis", "share", {"1"}}};
  grid.measures = {&limits_measure()};
  EXPECT_EQ(grid.shown_unit(0, 0, 0).shown, "m");
  EXPECT_EQ(grid.shown_unit(0, 1, 0).shown, "") << "a pure number";
}

TEST(SweepMeasure, IsFoundByItsName) {
  const auto measures = parse_measures("nees, errors");
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0]->name, "nees");
  EXPECT_EQ(measures[1], &sweep_measures().front());
  EXPECT_EQ(message_of([] { parse_measures("errors,ness"); }),
            "'ness' is no measure; expected one or more of errors, nees, counts, time, with one comma between them");
  EXPECT_EQ(message_of([] { parse_measures("nees,nees"); }), "'nees' is listed twice; list it once");
  EXPECT_NE(message_of([] { parse_measures("time"); }).find("add errors, nees or counts"), std::string::npos);
}

}  // namespace
}  // namespace halyard
