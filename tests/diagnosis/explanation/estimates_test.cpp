/// Intervals of a final fit, as a diagnosis tells them: Student's, and within what a number can be.

#include "diagnosis/explanation/estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/statistics/distributions.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// A fit of one number with the deviation 1 by 9 blocks: its interval is ± t of 8 degrees of freedom.
struct OneNumber {
  Fit fit;
  const double half = t_quantile(8, 0.025);

  OneNumber(double value, double nominal, double lower, double upper, std::optional<std::size_t> effect, bool shape) {
    FitParameter p;
    p.name = "half_gap", p.unit = "m";
    p.effect = effect, p.nominal = nominal, p.lower = lower, p.upper = upper, p.shape = shape;
    fit.parameters = {p};
    fit.value = {value};
    fit.std_deviation = {1};
    fit.blocks = 9;
    fit.covariance = Eigen::MatrixXd::Zero(1, 1);
  }
  Estimated told(std::size_t given) const { return estimate_of(fit, 0, given); }
};

TEST(Estimates, AreStudentsIntervalsAboutTheValue) {
  const OneNumber n(10, 0, -100, 100, 0, false);
  const Estimated e = n.told(0);
  EXPECT_EQ(e.name, "half_gap");
  EXPECT_EQ(e.unit, "m");
  EXPECT_EQ(e.value, 10);
  EXPECT_DOUBLE_EQ(e.lower, 10 - n.half);
  EXPECT_DOUBLE_EQ(e.upper, 10 + n.half);
}

/// x + b is measured exactly. The fit takes b as normal with half its tolerance; b lies anywhere within it.
TEST(Estimates, CountThatANumberOfTheModelLiesAnywhereWithinItsTolerance) {
  constexpr double kTolerance = 0.6, kPrior = kTolerance / 2;
  OneNumber n(10, 0, -100, 100, 0, false);
  FitParameter number;
  number.scale = kPrior;
  n.fit.parameters.push_back(number);
  n.fit.value = {10, 0};
  n.fit.std_deviation = {kPrior, kPrior};
  n.fit.covariance = kPrior * kPrior * Eigen::Matrix2d{{1, -1}, {-1, 1}};
  EXPECT_DOUBLE_EQ(n.told(0).upper, 10 + n.half * kTolerance / std::sqrt(3));
}

TEST(Estimates, EndWhereTheNumberCannotGo) {
  const Estimated e = OneNumber(10, 0, 9.5, 10.25, 0, false).told(0);
  EXPECT_EQ(e.lower, 9.5);
  EXPECT_EQ(e.upper, 10.25);
}

TEST(Estimates, OfASizeThatWasFoundDoNotReachBeyondItsNeutralValue) {
  EXPECT_EQ(OneNumber(1, 0, -100, 100, 0, false).told(0).lower, 0);
  EXPECT_EQ(OneNumber(-1, 0, -100, 100, 0, false).told(0).upper, 0);
  // On its own side the interval is whole.
  const OneNumber above(1, 0, -100, 100, 0, false), below(-1, 0, -100, 100, 0, false);
  EXPECT_DOUBLE_EQ(above.told(0).upper, 1 + above.half);
  EXPECT_DOUBLE_EQ(below.told(0).lower, -1 - below.half);
}

TEST(Estimates, OfShapesGivenEffectsAndNumbersOfTheModelReachBeyondIt) {
  const OneNumber shape(1, 0, -100, 100, 0, true), given(1, 0, -100, 100, 0, false),
      number(1, 0, -100, 100, std::nullopt, false);
  EXPECT_DOUBLE_EQ(shape.told(0).lower, 1 - shape.half);
  EXPECT_DOUBLE_EQ(given.told(1).lower, 1 - given.half);
  EXPECT_DOUBLE_EQ(number.told(0).lower, 1 - number.half);
}

/// What is told of an effect of one joint. The fit has determined all of its parameters but whole numbers.
std::vector<Estimated> told_of(
    const PlacedEffect& effect, const PlacedEffect& told, const std::function<void(Fit&)>& change = [](Fit&) {}) {
  static const Evidence evidence = brief_evidence();
  const ArmParameters<double> arm = first_joints(1).nominal;
  Fit fit;
  fit.hypothesis = {arm, {effect}};
  fit.parameters = effect_parameters(evidence, fit.hypothesis, arm, 0);
  std::erase_if(fit.parameters, [](const FitParameter& p) { return p.is_whole; });
  for (const FitParameter& p : fit.parameters) fit.value.push_back(parameter_value(fit.hypothesis, p));
  fit.std_deviation.assign(fit.parameters.size(), 1e-6);
  fit.blocks = 9;
  fit.covariance = Eigen::MatrixXd::Zero(std::ssize(fit.parameters), std::ssize(fit.parameters));
  change(fit);
  return estimated_parameters(evidence, arm, fit, 0, 0, told);
}

PlacedEffect of_one_joint(const char* name) { return place_effect(*find_effect(name), first_joints(1).nominal, 0); }

TEST(Estimates, AreOfTheEffectAndNotOfItsPast) {
  const PlacedEffect loop = of_one_joint("hysteresis");
  const std::vector<Estimated> told = told_of(loop, loop);
  ASSERT_EQ(told.size(), 2u) << "it has a state, too";
  EXPECT_EQ(told[0].name, "share");
  EXPECT_EQ(told[1].name, "yield_stretch");
}

TEST(Estimates, OfAWholeNumberHaveNoInterval) {
  PlacedEffect ripple = of_one_joint("torque_ripple");
  ripple.p[2] = 6;
  const std::vector<Estimated> told = told_of(ripple, ripple);
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[2].name, "order");
  EXPECT_TRUE(told[2].is_whole);
  EXPECT_FALSE(told[0].is_whole);
  EXPECT_EQ(told[2].value, 6);
  EXPECT_EQ(told[2].lower, 6);
  EXPECT_EQ(told[2].upper, 6);
  EXPECT_LT(told[0].lower, told[0].upper);
}

TEST(Estimates, OfAParameterThatWasResetAreNeutralWithTheIntervalBefore) {
  const PlacedEffect friction = place_neutral_effect(*find_effect("motor_friction"), first_joints(1).nominal, 0);
  const auto told = [&](double value) {
    return told_of(friction, friction, [&](Fit& fit) {
      fit.reset = {{fit.parameters[0], value, 3e-3}};
      fit.parameters.erase(fit.parameters.begin());
    })[0];
  };
  const Estimated around = told(1e-3), above = told(4e-3);
  EXPECT_TRUE(around.is_reset);
  EXPECT_EQ(around.value, 0);
  EXPECT_DOUBLE_EQ(around.lower, -2e-3);
  EXPECT_DOUBLE_EQ(around.upper, 4e-3);
  EXPECT_EQ(above.lower, 0) << "it contains what is told";
  EXPECT_DOUBLE_EQ(above.upper, 7e-3);
}

TEST(Estimates, OfAnInstantAreOnTheClockOnWhichItIsTold) {
  PlacedEffect slip = of_one_joint("cable_slip"), told_slip = slip;
  slip.p[1] = 1.5, told_slip.p[1] = 0.25;
  const std::vector<Estimated> told = told_of(slip, told_slip);
  ASSERT_GE(told.size(), 2u);
  EXPECT_EQ(told[0].value, slip.p[0]);
  const double half = t_quantile(8, 0.025) * 1e-6;
  EXPECT_DOUBLE_EQ(told[1].value, 0.25);
  EXPECT_NEAR(told[1].lower, 0.25 - half, 1e-12);
  EXPECT_NEAR(told[1].upper, 0.25 + half, 1e-12);
}

TEST(Estimates, TellWhetherTheFitHasTakenANumberToABoundOfItsRange) {
  const auto number = [](double value) { return OneNumber(value, 10, 8, 12, std::nullopt, false).told(0); };
  EXPECT_TRUE(number(12).at_bound);
  EXPECT_FALSE(number(12).at_limit);
  EXPECT_FALSE(number(11).at_bound);
  EXPECT_EQ(number(11).least, 8);
  EXPECT_EQ(number(11).most, 12);
  const auto size = [](double value, bool natural) {
    OneNumber n(value, 0, 0, 2, 0, false);
    n.fit.parameters[0].natural_bounds = natural;
    return n.told(0);
  };
  EXPECT_TRUE(size(2, false).at_bound);
  EXPECT_FALSE(size(2, false).at_limit);
  EXPECT_TRUE(size(2, true).at_limit);
  EXPECT_FALSE(size(0, true).at_bound) << "it does nothing";
}

TEST(Estimates, OfAParameterThatWasResetTellThatItEndedAtTheEndOfWhatIsPlausible) {
  const PlacedEffect friction = place_neutral_effect(*find_effect("motor_friction"), first_joints(1).nominal, 0);
  const auto told = [&](double share_of_most) {
    return told_of(friction, friction, [&](Fit& fit) {
      const FitParameter p = fit.parameters[0];
      fit.reset = {{p, share_of_most * p.upper, 3e-3}};
      fit.parameters.erase(fit.parameters.begin());
    })[0];
  };
  EXPECT_TRUE(told(1).at_bound);
  EXPECT_EQ(told(1).value, 0);
  EXPECT_GT(told(1).most, 0);
  EXPECT_FALSE(told(0.5).at_bound) << "it is not significant";
}

TEST(Estimates, AtTheirBoundsAreToldInASentenceEach) {
  const auto at = [](const char* name, const char* unit, double least, double most, bool at_bound) {
    Estimated e{name, unit, most, least, most, 0};
    e.least = least, e.most = most, e.at_bound = at_bound;
    return e;
  };
  Diagnosis d;
  d.refitted = {at("joint 2 link mass", "kg", 0.57, 0.63, true), at("joint 1 viscous friction", "N m s", 0, 1, false)};
  EXPECT_EQ(bound_lines(d), (std::vector<std::string>{
                                "joint 2 link mass: at the end of its tolerance (0.57 to 0.63 kg): the true value may "
                                "lie beyond; check the number, or widen its tolerance in the model file"}));
  d.tolerance_factor = 2;
  EXPECT_TRUE(bound_lines(d).at(0).starts_with("joint 2 link mass: at the end of 2 times its tolerance (")) << "both";
  d.refitted[0].at_limit = true;
  EXPECT_EQ(bound_lines(d).at(0),
            "joint 2 link mass: at a physical limit (0.57 to 0.63 kg): the data ask for still less, so an effect may "
            "be missing");
  d.refitted.clear();
  NamedEffect named{of_one_joint("capstan_ratio"), 0.9, {at("ratio", "1", 0.5, 2, true)}, {}};
  d.effects = {named};
  const std::string reset = ", and so reset to 1",
                    plausible =
                        "capstan_ratio of joint 1 ratio: at the end of what is "
                        "plausible (0.5 to 2)",
                    end = ": the true value may lie beyond, or be another effect's";
  EXPECT_EQ(bound_lines(d).at(0), plausible + end);
  d.effects[0].parameters[0].is_reset = true;
  d.effects[0].parameters[0].value = 1;
  EXPECT_EQ(bound_lines(d).at(0), plausible + reset + end);
  d.effects[0].parameters[0].at_limit = true;
  EXPECT_EQ(bound_lines(d).at(0),
            "capstan_ratio of joint 1 ratio: at a physical limit (0.5 to 2), beyond which the true value cannot lie");
}

}  // namespace
}  // namespace halyard
