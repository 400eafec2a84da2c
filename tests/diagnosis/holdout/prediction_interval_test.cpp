#include "diagnosis/holdout/prediction_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/judgement/final_fit.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr double kNoise = 1e-3;  // rad, 14 times what is left without it

const Log& log_of_one_joint() {
  static const Log log = simulate(motion(first_joints(1), 6)).measured;
  return log;
}

Log noisy_log(unsigned seed) {
  Log log = log_of_one_joint();
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, kNoise);
  for (double& q : log.joint_position[0]) q += normal(random);
  return log;
}

Evidence evidence_of(const Log& log) {
  const ArmModel model = first_joints(1);
  return Evidence(make_records(log, model, kFitBand), model);
}

std::vector<double> quantiles_of(const Log& log) {
  const ArmModel model = first_joints(1);
  const DiagnosisData data = diagnosis_data(model, {log}, log, model);
  return residual_quantiles(Evidence(data.training, model), data.training_joints, {model.nominal, {}});
}

/// A fit of no parameter.
Fit no_parameters() {
  Fit fit;
  fit.hypothesis = {first_joints(1).nominal, {}};
  fit.blocks = 10;
  fit.usable = true;
  return fit;
}

HoldOut holdout_of(const Log& log, const Fit& fit, const std::vector<double>& quantile) {
  HoldOut view;
  view.records = make_records(log, first_joints(1), kJointErrorBand);
  view.after = predict_all(view.records, fit.hypothesis);
  view.half_width = half_widths(view.records, fit, quantile);
  return view;
}

TEST(PredictionInterval, OfWhiteNoiseContains95PercentOfTheSamples) {
  const Fit fit = no_parameters();
  const std::vector<double> quantile = quantiles_of(noisy_log(1));
  // A quantile of m = 2750 independent samples (half of 5.5 s at 1 kHz): its coverage deviates by sqrt(0.95 * 0.05 / m)
  // = 0.42 %, and the density at 1.96 deviations, 2 * 0.0584, makes 0.036 deviations of it. Three times that.
  EXPECT_NEAR(quantile[0] / kNoise, 1.96, 3 * 0.036);

  const PredictionInterval interval = prediction_interval(holdout_of(noisy_log(2), fit, quantile), 1);
  EXPECT_EQ(interval.half_width[0], quantile[0]);
  // The binomial deviation of 5500 new samples, 0.29 %, beside that of the quantile: three times 0.51 %.
  EXPECT_NEAR(interval.coverage[0], 0.95, 3 * 0.0051);

  const std::vector<double> half = {0.5 * quantile[0]};
  EXPECT_LT(prediction_interval(holdout_of(noisy_log(2), fit, half), 1).coverage[0], 0.75) << "67 % within 0.98";
}

TEST(PredictionInterval, TakesTheResidualFromTheDecidingBlocks) {
  constexpr double kBlock = 0.25, kOffset = 0.05;  // s: the shortest block; rad
  for (const int shifted : {0, 1}) {
    Log log = log_of_one_joint();
    for (std::size_t i = 0; i < log.size(); ++i)
      if (static_cast<int>((log.time[i] - log.time[0]) / kBlock) % 2 == shifted) log.joint_position[0][i] += kOffset;
    const double q = quantiles_of(log)[0];
    // Of the exact arm only the encoders' steps are left.
    EXPECT_NEAR(q, shifted == 1 ? kOffset : 0, 1e-3) << (shifted == 1 ? "deciding" : "fitting");
  }
}

TEST(PredictionInterval, AddsTheLargerDeviationOfAParameterByItsSensitivity) {
  constexpr double kSmaller = 1e-3, kDeviation = 2e-3, kQuantile = 1e-3;  // rad
  const ArmModel model = first_joints(1);
  Fit fit = no_parameters();
  fit.hypothesis.effects = {place_effect(*find_effect("encoder_offset"), model.nominal, 0)};
  fit.hypothesis.effects[0].p[0] = 0;
  fit.parameters = effect_parameters(evidence_of(log_of_one_joint()), fit.hypothesis, model.nominal, 0);
  ASSERT_EQ(fit.parameters.size(), 1u);
  const double half = std::hypot(interval_factor(fit) * kDeviation, kQuantile);
  for (const auto& [curvature, blocks] : {std::pair(kSmaller, kDeviation), std::pair(kDeviation, kSmaller)}) {
    fit.covariance = Eigen::MatrixXd::Constant(1, 1, curvature * curvature);
    fit.block_covariance = Eigen::MatrixXd::Constant(1, 1, blocks * blocks);
    const PredictionInterval interval = prediction_interval(holdout_of(log_of_one_joint(), fit, {kQuantile}), 1);
    // A zero error moves the predicted joint by itself, but for the cable's stretch under the changed gravity.
    EXPECT_NEAR(interval.half_width[0], half, 0.01 * half);
    EXPECT_EQ(interval.coverage[0], 1);
  }
}

TEST(PredictionInterval, KeepsParametersThatCancelEachOther) {
  // Two zero errors whose sum alone the data determine.
  const ArmModel model = first_joints(1);
  Fit fit = no_parameters();
  for (int e = 0; e < 2; ++e) {
    fit.hypothesis.effects.push_back(place_effect(*find_effect("encoder_offset"), model.nominal, 0));
    fit.hypothesis.effects[e].p[0] = 0;
  }
  const Evidence evidence = evidence_of(log_of_one_joint());
  for (int e = 0; e < 2; ++e)
    fit.parameters.push_back(effect_parameters(evidence, fit.hypothesis, model.nominal, e).at(0));
  constexpr double kVariance = 1, kOfSum = 1e-6;  // rad²
  fit.covariance =
      (Eigen::Matrix2d() << kVariance, kOfSum / 2 - kVariance, kOfSum / 2 - kVariance, kVariance).finished();
  fit.block_covariance = fit.covariance;
  const PredictionInterval interval = prediction_interval(holdout_of(log_of_one_joint(), fit, {0}), 1);
  const double half = interval_factor(fit) * std::sqrt(kOfSum);
  EXPECT_NEAR(interval.half_width[0], half, 0.01 * half);
}

TEST(PredictionInterval, CountsANumberThatTheFinalFitHasReset) {
  const ArmModel model = first_joints(1);
  const Evidence whole(make_records(log_of_one_joint(), model, kFitBand), model, Split::none);
  const std::vector<FitParameter> numbers = baseline_parameters(model);
  const Fit all = with_all_numbers(whole, no_parameters(), numbers);
  ASSERT_TRUE(all.usable);
  ASSERT_EQ(all.parameters.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    EXPECT_EQ(parameter_value(all.hypothesis, numbers[i]), numbers[i].nominal) << numbers[i].name;
    // At most the prior's deviation, half the tolerance; 1e-6 for the rounding of an inverse.
    EXPECT_LE(std::sqrt(all.covariance(at, at)), numbers[i].scale * (1 + 1e-6)) << numbers[i].name;
  }
  const HoldOut with = holdout_of(log_of_one_joint(), all, {0}),
                without = holdout_of(log_of_one_joint(), no_parameters(), {0});
  EXPECT_GT(prediction_interval(with, 1).half_width[0], 0);
  EXPECT_EQ(prediction_interval(without, 1).half_width[0], 0);
}

TEST(PredictionInterval, IsUnknownIfASensitivityCannotBeIntegrated) {
  Fit fit = no_parameters();
  fit.hypothesis.nominal.joint[0].mass = std::nan("");
  const HoldOut view = holdout_of(log_of_one_joint(), fit, {1e-3});
  const PredictionInterval interval = prediction_interval(view, 1);
  EXPECT_TRUE(std::isnan(interval.half_width[0]));
  EXPECT_TRUE(std::isnan(interval.coverage[0]));
}

TEST(PredictionInterval, OfALogWithoutAnEventCountsTheOtherParameters) {
  const ArmModel model = first_joints(1);
  Fit fit = no_parameters();
  for (const char* name : {"cable_slip", "encoder_offset"})
    fit.hypothesis.effects.push_back(place_effect(*find_effect(name), model.nominal, 0));
  fit.parameters.resize(3);
  fit.parameters[0].effect = 0, fit.parameters[2].effect = 1;  // the second is a number of the model
  fit.value = {1, 2, 3}, fit.std_deviation = {4, 5, 6};
  fit.covariance = Eigen::Matrix3d{{11, 12, 13}, {12, 22, 23}, {13, 23, 33}};
  fit.block_covariance = 2 * fit.covariance;
  const Fit left = without_event(fit, 0);
  ASSERT_EQ(left.hypothesis.effects.size(), 1u);
  EXPECT_EQ(left.hypothesis.effects[0].effect->name(), "encoder_offset");
  ASSERT_EQ(left.parameters.size(), 2u);
  EXPECT_FALSE(left.parameters[0].effect);
  EXPECT_EQ(left.parameters[1].effect, 0u);
  EXPECT_EQ(left.value, (std::vector<double>{2, 3}));
  EXPECT_EQ(left.std_deviation, (std::vector<double>{5, 6}));
  EXPECT_EQ(left.covariance, (Eigen::Matrix2d{{22, 23}, {23, 33}}));
  EXPECT_EQ(left.block_covariance, (Eigen::Matrix2d{{44, 46}, {46, 66}}));
}

}  // namespace
}  // namespace halyard
