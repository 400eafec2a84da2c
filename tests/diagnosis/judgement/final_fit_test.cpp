#include "diagnosis/judgement/final_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "diagnosis/round/refit.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr double kJump = 2e-4, kTime = 2.613;  // m, s

PlacedEffect slip(const ArmModel& model, double jump, double time) {
  PlacedEffect e = place_effect(*find_effect("cable_slip"), model.nominal, 0);
  e.p[0] = jump, e.p[1] = time;
  return e;
}

/// An arm with one effect, by default a cable that slipped once, and the final fit of other effects.
struct Fitted {
  ArmModel model = first_joints(1);
  Fit fit;

  explicit Fitted(const std::vector<PlacedEffect>& named,
                  const PlacedEffect& truth = slip(first_joints(1), kJump, kTime)) {
    ArmModel robot = model;
    robot.effects = {truth};
    const std::vector<Record> records = make_records(simulate(motion(robot, 5)).measured, model, {});
    const Evidence evidence(records, model), whole(records, model, Split::none);
    const Refitter refitter(evidence, model, 0);
    const Hypothesis h{model.nominal, named};
    fit = final_fit(whole, model, refitter.refit(h, evidence.score(h)), 0);
  }
  /// Changes of the sizes that are left over half of their interval.
  std::vector<double> certainties() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < fit.parameters.size(); ++i)
      if (fit.parameters[i].effect && !fit.parameters[i].shape)
        all.push_back(std::abs(fit.value[i] - fit.parameters[i].nominal) /
                      (interval_factor(fit) * fit.std_deviation[i]));
    return all;
  }
};

TEST(FinalFit, KeepsASlipThatTheDataDetermine) {
  const Fitted one({slip(first_joints(1), 0.9 * kJump, kTime)});
  ASSERT_EQ(one.certainties().size(), 1u);
  EXPECT_TRUE(idle_effects(one.fit, 0).empty());
  EXPECT_NEAR(one.fit.hypothesis.effects[0].p[0], kJump, 0.01 * kJump);
}

TEST(FinalFit, WeighsByWhatItLeavesWhereverItStarts) {
  ArmModel model = first_joints(1), robot = model;
  robot.effects = {slip(model, kJump, kTime)};
  const Evidence whole(make_records(simulate(motion(robot, 5)).measured, model, {}), model, Split::none);
  const auto deviation_from = [&](double jump) {
    Fit start;
    start.hypothesis = {model.nominal, {slip(model, jump, kTime)}};
    start.parameters = {effect_parameters(whole, start.hypothesis, model.nominal, 0)[0]};
    return with_given_numbers(whole, model, start).std_deviation.at(0);
  };
  EXPECT_NEAR(deviation_from(0.5 * kJump), deviation_from(kJump), 0.2 * deviation_from(kJump))
      << "the next would differ less";
}

TEST(FinalFit, FindsAnInstantWithinABlockThatTheFitBeforeDidNotSee) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.effects = {slip(model, kJump, kTime)};
  const std::vector<Record> records = make_records(simulate(motion(robot, 5)).measured, model, {});
  const Evidence evidence(records, model), whole(records, model, Split::none);
  constexpr double kBefore = kTime - 0.34;
  const Hypothesis h{model.nominal, {slip(model, kJump, kBefore)}};
  Fit seen;  // as after a fit to the other blocks
  seen.hypothesis = h;
  seen.parameters = Refitter(evidence, model, 0).parameters(h);
  const Fit fit = final_fit(whole, model, seen, 0);
  ASSERT_TRUE(fit.usable);
  EXPECT_NEAR(fit.hypothesis.effects[0].p[1], kTime, 0.03);  // this arm's vibration hides the rest
}

TEST(FinalFit, KeepsADriftThatIsLinearInTime) {
  PlacedEffect truth = place_neutral_effect(*find_effect("friction_drift"), first_joints(1).nominal, 0), start = truth;
  truth.p[0] = -0.12, truth.p[1] = 0.05;  // 1/s, -; its settling rate is 0
  start.p[0] = -0.14, start.p[1] = 0.03, start.p[2] = 2e-3;
  const Fitted linear({start}, truth);
  ASSERT_TRUE(linear.fit.usable);
  EXPECT_TRUE(idle_effects(linear.fit, 0).empty());
  EXPECT_NEAR(linear.fit.hypothesis.effects[0].p[0], truth.p[0], 0.1 * std::abs(truth.p[0]));
}

TEST(FinalFit, KeepsNoSizeWhoseIntervalContainsItsNeutralValue) {
  constexpr double kOffset = 0.02;  // rad
  PlacedEffect truth = place_effect(*find_effect("encoder_offset"), first_joints(1).nominal, 0), more = truth,
               less = truth;
  truth.p[0] = kOffset, more.p[0] = 3 * kOffset, less.p[0] = -2 * kOffset;
  const Fitted two({more, less}, truth);
  ASSERT_TRUE(two.fit.usable);
  for (const double certainty : two.certainties()) EXPECT_GT(certainty, 1);
  ASSERT_EQ(idle_effects(two.fit, 0).size(), 1u) << "of two offsets the data determine the sum";
  EXPECT_TRUE(two.fit.reset.empty()) << "the other effect goes";
  double sum = 0;
  for (const PlacedEffect& e : two.fit.hypothesis.effects) sum += e.p[0];
  EXPECT_NEAR(sum, kOffset, 0.02 * kOffset);
}

TEST(FinalFit, TellsWhatTheSizesMayBeThatItHasReset) {
  PlacedEffect truth = place_neutral_effect(*find_effect("motor_friction"), first_joints(1).nominal, 0);
  truth.p[0] = 4e-3;
  const Fitted friction({truth}, truth);
  ASSERT_TRUE(friction.fit.usable);
  ASSERT_FALSE(friction.fit.reset.empty());
  for (const ResetParameter& r : friction.fit.reset)
    EXPECT_LT(std::abs(r.value - truth.p[r.parameter.index]), r.half_width) << r.parameter.name;
}

/// A pulley that rubs, on an arm whose mass, rotor, frictions and stiffness are off within their tolerances; and its
/// final fit.
struct Rubbing {
  ArmModel model = first_joints(1);
  PlacedEffect truth = rubbing(0.05);
  std::vector<Record> records;
  Fit fit;

  Rubbing() {
    ArmModel robot = model;
    JointParameters<double>& j = robot.nominal.joint[0];
    j.mass *= 0.97, j.motor_coulomb *= 1.1, j.joint_coulomb *= 0.9, j.stiffness *= 1.04;
    j.rotor_inertia *= 1.03;  // the only one of these that eight seconds determine beside the pulley
    robot.effects = {truth};
    records = make_records(simulate(motion(robot, 8)).measured, model, {});
    const Evidence evidence(records, model), whole(records, model, Split::none);
    const Refitter refitter(evidence, model, 0);
    const Hypothesis h{model.nominal, {rubbing(0.025)}};
    fit = final_fit(whole, model, refitter.refit(h, evidence.score(h)), 0);
  }
  PlacedEffect rubbing(double coefficient) const {
    PlacedEffect e = place_effect(*find_effect("pulley_friction"), model.nominal, 0);
    e.p[0] = coefficient, e.p[1] = 0.5;
    return e;
  }
};

TEST(FinalFit, IntervalsCountWhatTheNumbersOfTheModelMayBeOff) {
  // With the uncertain numbers set back to the model's, the coefficient was 0.0553 ± 0.0017.
  const Rubbing arm;
  ASSERT_TRUE(arm.fit.usable);
  EXPECT_TRUE(idle_effects(arm.fit, 0).empty());
  std::ptrdiff_t numbers = 0;
  for (std::size_t i = 0; i < arm.fit.parameters.size(); ++i) {
    const FitParameter& p = arm.fit.parameters[i];
    if (!p.effect) {
      ++numbers;
      continue;
    }
    EXPECT_LT(std::abs(arm.fit.value[i] - arm.truth.p[p.index]), interval_factor(arm.fit) * arm.fit.std_deviation[i])
        << p.name << " " << arm.fit.value[i];
  }
  const Evidence whole(arm.records, arm.model, Split::none);
  const auto changed = std::ssize(changed_numbers(whole, arm.model, arm.fit));
  EXPECT_GT(changed, 0);
  EXPECT_LT(changed, numbers) << "a number that did not change significantly stays in the fit, too";
}

/// An arm that is right but for one effect, and the fit of that effect before the final one.
struct Refitted {
  ArmModel model = first_joints(1);
  std::vector<Record> records;
  Evidence evidence, whole;
  Fit fit;

  explicit Refitted(const PlacedEffect& truth)
      : records(make_records(simulate(motion(with(truth), 8)).measured, model, {})),
        evidence(records, model),
        whole(records, model, Split::none) {
    const Hypothesis h{model.nominal, {truth}};
    fit = Refitter(evidence, model, 0).refit(h, evidence.score(h));
  }

 private:
  static ArmModel with(const PlacedEffect& truth) {
    ArmModel robot = first_joints(1);
    robot.effects = {truth};
    return robot;
  }
};

/// The motor's side and the joint's side share the friction of a cable. The motor's own friction is uncertain as well,
/// so that only what acts at the joint is certain: the size times a share.
TEST(FinalFit, KeepsASizeThatIsUncertainOnlyTogetherWithItsShape) {
  PlacedEffect truth = place_neutral_effect(*find_effect("pulley_friction"), first_joints(1).nominal, 0);
  truth.p[0] = 0.03, truth.p[1] = 0.8;
  const Refitted arm(truth);
  EXPECT_TRUE(idle_effects(final_fit(arm.whole, arm.model, arm.fit, 0), 0).empty());
}

TEST(FinalFit, IntervalsCountTheSizesOfTheSameEffectThatAreReset) {
  // More Coulomb friction of the motor; more viscous friction is nearly the same (effects/motor/motor_friction.cpp).
  constexpr std::size_t kCoulomb = 0, kViscous = 1;
  PlacedEffect truth = place_neutral_effect(*find_effect("motor_friction"), first_joints(1).nominal, 0);
  truth.p[kCoulomb] = 0.01;
  const Refitted arm(truth);
  Fit one = arm.fit;  // as if the viscous friction were known to be the model's
  std::erase_if(one.parameters, [](const FitParameter& p) { return p.effect == 0 && p.index == kViscous; });
  const auto deviation = [&](const Fit& chosen) {
    const Fit fit = final_fit(arm.whole, arm.model, chosen, 0);
    const auto is = [](std::size_t index) {
      return [index](const FitParameter& p) { return p.effect == 0 && p.index == index; };
    };
    EXPECT_TRUE(std::ranges::none_of(fit.parameters, is(kViscous))) << "it is not reset";
    const auto rise = std::ranges::find_if(fit.parameters, is(kCoulomb)) - fit.parameters.begin();
    return rise < std::ssize(fit.parameters) ? fit.std_deviation[rise] : 0;
  };
  EXPECT_GT(deviation(arm.fit), 1.05 * deviation(one));
}

TEST(FinalFit, DeviationsCountWhatAFitBeforeHadReset) {
  const auto of = [](std::optional<std::size_t> effect, std::size_t index) {
    FitParameter p;
    p.effect = effect, p.index = index;
    return p;
  };
  const FitParameter kept = of(0, 0), reset = of(0, 1), other = of(1, 0), number = of({}, 5);
  Fit before;
  before.parameters = {kept, reset, other, number};
  before.value = {1, 2, 3, 4};
  before.std_deviation = {0.4, 0.4, 0.4, 0.4};
  Fit after;
  after.parameters = {kept, other, number};
  after.value = {1.3, 3.3, 4.3};
  after.std_deviation = {0.1, 0.1, 0.1};
  count_resets(before, after);
  EXPECT_EQ(after.std_deviation[0], 0.1) << "nothing was reset";
  after.reset = {{reset, 2, 1}};
  count_resets(before, after);
  EXPECT_NEAR(after.std_deviation[0], 0.5, 1e-12) << "three beside four tenths";
  EXPECT_EQ(after.std_deviation[1], 0.1) << "its effect has kept all";
  EXPECT_EQ(after.std_deviation[2], 0.1) << "a number of the model";
  after.std_deviation[0] = 2;
  count_resets(before, after);
  EXPECT_EQ(after.std_deviation[0], 2) << "it never shrinks";
}

TEST(FinalFit, IsNotUsableIfItsStartCannotBeIntegrated) {
  const ArmModel model = first_joints(1);
  const Evidence whole(make_records(simulate(motion(model, 2)).measured, model, {}), model, Split::none);
  Fit start;
  start.hypothesis = {model.nominal, {slip(model, kJump, kTime)}};
  start.parameters = effect_parameters(whole, start.hypothesis, model.nominal, 0);
  EXPECT_TRUE(final_fit(whole, model, start, 0).usable);
  start.hypothesis.nominal.joint[0].mass = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(final_fit(whole, model, start, 0).usable);
}

TEST(FinalFit, GivesTheModelsNumbersBack) {
  const Rubbing arm;
  const Evidence whole(arm.records, arm.model, Split::none);
  const Fit as_given = with_given_numbers(whole, arm.model, arm.fit);
  ASSERT_TRUE(as_given.usable);
  for (const FitParameter& p : arm.fit.parameters) {
    if (p.effect) continue;
    EXPECT_EQ(parameter_value(as_given.hypothesis, p), p.nominal) << p.name;
  }
  for (const FitParameter& p : as_given.parameters) EXPECT_TRUE(p.effect) << p.name;
}

TEST(FinalFit, KeepsItsEffectsAndGivesTheModelsMotionBack) {
  const ArmModel model = first_joints(1);
  const Evidence whole(make_records(simulate(motion(model, 2)).measured, model, {}), model, Split::none);
  Fit found;
  // More friction of the motor, which the log does not have, and which leaves the motion as it is.
  found.hypothesis = {model.nominal, {place_effect(*find_effect("motor_friction"), model.nominal, 0)}};
  found.hypothesis.nominal.joint[0].mass *= 1.02;
  found.parameters = baseline_parameters(model);
  found.parameters.push_back(effect_parameters(whole, found.hypothesis, model.nominal, 0).at(0));
  const Fit given = with_given_motion(whole, model, found);
  ASSERT_TRUE(given.usable);
  EXPECT_EQ(given.hypothesis.effects[0].p[0], found.hypothesis.effects[0].p[0]);
  EXPECT_EQ(given.hypothesis.nominal.joint[0].mass, model.nominal.joint[0].mass);
  for (const FitParameter& p : given.parameters) EXPECT_FALSE(p.effect) << p.name;
}

TEST(FinalFit, AValueMayBeNeutralWithinStudentsIntervalOfItsBlocks) {
  // The quantiles of one and two degrees of freedom in closed form. There is at least one.
  const double of_one = std::tan(0.475 * std::numbers::pi), of_two = 0.95 / std::sqrt(2 * 0.975 * 0.025);
  for (const auto& [blocks, quantile] : {std::pair(0, of_one), std::pair(2, of_one), std::pair(3, of_two)}) {
    constexpr double kNeutral = 1, kDeviation = 0.5;
    Fit fit;
    fit.blocks = blocks;
    fit.parameters.resize(1);
    fit.parameters[0].nominal = kNeutral;
    fit.parameters[0].effect = 0;
    fit.std_deviation = {kDeviation};
    for (const double sign : {-1, 1}) {
      fit.value = {kNeutral + sign * quantile * kDeviation * (1 - 1e-6)};
      EXPECT_TRUE(may_be_neutral(fit, 0)) << blocks;
      fit.value = {kNeutral + sign * quantile * kDeviation * (1 + 1e-6)};
      EXPECT_FALSE(may_be_neutral(fit, 0)) << blocks;
    }
  }
}

TEST(FinalFit, AValueMayBeNeutralIfANumberOfTheModelAnywhereWithinItsToleranceMakesItSo) {
  constexpr double kDeviation = 0.5, kOfNumber = 2, kShared = 1.5;
  Fit fit;
  fit.blocks = 2;
  fit.parameters.resize(2);
  fit.parameters[0].effect = 0;
  fit.parameters[1].scale = kOfNumber;
  fit.std_deviation = {kDeviation, kOfNumber};
  fit.covariance = (Eigen::Matrix2d() << kDeviation * kDeviation, kShared, kShared, kOfNumber * kOfNumber).finished();
  // A uniform distribution over the tolerance adds a third of (covariance / deviation of the number)² to the variance.
  const double deviation = std::sqrt(kDeviation * kDeviation + std::pow(kShared / kOfNumber, 2) / 3);
  const double half = std::tan(0.475 * std::numbers::pi) * deviation;
  fit.value = {half * (1 - 1e-6), 0};
  EXPECT_TRUE(may_be_neutral(fit, 0));
  fit.value = {half * (1 + 1e-6), 0};
  EXPECT_FALSE(may_be_neutral(fit, 0));
}

/// A fit of one effect that has kept the parameters of these indices.
Fit fit_that_keeps(const char* name, const std::vector<std::size_t>& kept) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  Fit fit;
  fit.hypothesis = {arm, {place_effect(*find_effect(name), arm, 0)}};
  const std::vector<EffectParameter> parameters = find_effect(name)->parameters(arm, 0);
  for (const std::size_t i : kept) {
    FitParameter p;
    p.effect = 0, p.index = i, p.shape = parameters[i].is_shape();
    fit.parameters.push_back(p);
  }
  return fit;
}

TEST(FinalFit, AnEffectIsIdleWithoutASizeOrWithoutAnEssentialParameter) {
  const auto is_idle = [](const Fit& fit) { return idle_effects(fit, 0) == std::vector<std::size_t>{0}; };
  EXPECT_FALSE(is_idle(fit_that_keeps("backlash", {0})));
  EXPECT_TRUE(is_idle(fit_that_keeps("backlash", {1}))) << "the rounding of no gap";
  EXPECT_FALSE(is_idle(fit_that_keeps("friction_drift", {0})));
  EXPECT_TRUE(is_idle(fit_that_keeps("friction_drift", {1}))) << "it does not drift";
  Fit loop = fit_that_keeps("hysteresis", {0, 1});
  EXPECT_FALSE(is_idle(loop));
  loop.parameters[1].is_past = true;
  EXPECT_TRUE(is_idle(loop)) << "a state of its past is not its yield stretch";
  EXPECT_TRUE(idle_effects(fit_that_keeps("backlash", {}), 1).empty()) << "the model came with it";
}

/// changed_numbers() of a fit in which the friction of the motor (0) and the ratio of the drive (1) are so many
/// deviations off. in_scales: how far both are off, in half tolerances.
std::vector<std::size_t> changed_by(double friction, double ratio, double correlation, double in_scales = 10) {
  const ArmModel model = first_joints(1);
  static const Evidence whole = [&] {
    Log log = log_along(4, 100, slow_swing);
    for (const double t : log.time) log.motor_torque[0].push_back(0.05 * std::cos(1.7 * t));  // N m
    return Evidence(make_records(log, model, {}), model, Split::none);
  }();
  Fit fit;
  fit.hypothesis = {model.nominal, {}};
  for (const FitParameter& p : baseline_parameters(model))
    if (p.name == "joint 1 motor Coulomb friction" || p.name.ends_with("capstan radius")) fit.parameters.push_back(p);
  EXPECT_EQ(fit.parameters.size(), 2u);
  fit.covariance.resize(2, 2);
  for (const std::size_t i : {0, 1}) {
    const FitParameter& p = fit.parameters[i];
    fit.value.push_back(p.nominal + in_scales * p.scale);
    fit.std_deviation.push_back(in_scales * p.scale / (i == 0 ? friction : ratio));
  }
  for (const int i : {0, 1})
    for (const int j : {0, 1})
      fit.covariance(i, j) = fit.std_deviation[i] * fit.std_deviation[j] * (i == j ? 1 : correlation);
  return changed_numbers(whole, model, fit);
}

TEST(FinalFit, ANumberHasChangedIfItIsFourDeviationsOffBesideTheOthersThatHave) {
  using Changed = std::vector<std::size_t>;
  EXPECT_EQ(changed_by(3.9, 3.9, 0), Changed{});
  EXPECT_EQ(changed_by(3.9, 4.3, 0), Changed{1});
  EXPECT_EQ(changed_by(4.1, 5, 0), (Changed{0, 1}));
  // With the friction set back, 5 - 0.99 * 3.9 = 1.14 deviations of the ratio are left, of which one is 0.14 then.
  EXPECT_EQ(changed_by(3.9, 5, 0.99), Changed{1});
  EXPECT_EQ(changed_by(3.9, 4.3, 0.99), Changed{}) << "0.44 are left";
}

TEST(FinalFit, ANumberHasNotChangedIfNoSensorResolvesIt) {
  // Half a tolerance of the ratio moves the joint by 6 mrad, 260 times what its sensor resolves.
  EXPECT_EQ(changed_by(3.9, 100, 0, 0.1), std::vector<std::size_t>{1});
  EXPECT_EQ(changed_by(3.9, 100, 0, 1e-3), std::vector<std::size_t>{});
}

}  // namespace
}  // namespace halyard
