/// The rules of the dual filter: what it forgets, when it starts, which readings it takes, and how far it steps.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/estimators/identification/linear_slide.h"

namespace halyard {
namespace {

DualUkf filter_with(double scale, const DualUkfOptions& options) {
  return DualUkf(slide(), {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = scale}}, options);
}

TEST(DualUkfRules, AWeightThatNothingTellsOfIsForgottenAtARateThatFalls) {
  constexpr double kMemory = 0.5, kGrowth = 0.4, kSettle = 0.1;  // s
  constexpr double kNothing = 1e-15;                             // N m
  DualUkf filter = filter_with(kNothing, {.memory = kMemory, .memory_growth = kGrowth, .settle = kSettle});
  const std::vector<EncoderSample> record = record_of_slide(slide(), 501, 1);
  for (const EncoderSample& sample : record) {
    filter.update(sample);
    const double learnt = std::max(0.0, sample.time_s - kSettle);
    // P = exp(∫ dt / T) with T = T_0 exp(t / τ); the integral is a sum over the steps, of rates of up to 1 / T_0.
    const double exponent = kGrowth / kMemory * (1 - std::exp(-learnt / kGrowth));
    EXPECT_NEAR(2 * std::log(filter.S_w()(0, 0)), exponent, 2 * kSlideStep / kMemory) << sample.time_s;
  }
}

TEST(DualUkfRules, StepsAreToldAfterItHasSettledAndOfTheEncodersThatWereRead) {
  DualUkf filter = filter_with(0.01, {.settle = 0.1});
  std::vector<EncoderSample> record = record_of_slide(slide(), 101, 1);
  for (std::size_t i = 0; i < record.size(); ++i) {
    if (i % 4 == 1) record[i].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
    if (i % 4 >= 2) record[i].joint_position(0) = std::numeric_limits<double>::quiet_NaN();
    if (i % 4 == 3) record[i].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
    const DualStep step = filter.update(record[i]);
    const Eigen::Index readings[] = {2, 1, 1, 0};
    EXPECT_EQ(step.nu.size(), record[i].time_s > 0.1 + 1e-9 ? readings[i % 4] : 0) << i;
    EXPECT_EQ(step.Y.rows(), step.nu.size()) << i;
    EXPECT_EQ(step.S_root.rows(), step.nu.size()) << i;
  }
}

TEST(DualUkfRules, StartsAnewAfterAGapAndKeepsTheWeights) {
  const std::vector<EncoderSample> record = record_of_slide(slide(), 201, 1);
  for (const double gap : {0.25, 0.35}) {
    DualUkf filter = filter_with(0.01, {.settle = 0.05, .restart_gap = 0.3});
    for (const EncoderSample& sample : record) filter.update(sample);
    const Eigen::VectorXd learnt = filter.w();
    EncoderSample later = record.back();
    later.time_s += gap;
    const bool starts = gap > 0.3;
    EXPECT_EQ(filter.update(later).nu.size(), starts ? 0 : 2) << gap;
    if (starts) {
      EXPECT_EQ(filter.w(), learnt);
    }
    later.time_s += 0.01;
    EXPECT_EQ(filter.update(later).nu.size(), starts ? 0 : 2) << "it settles";
  }
}

TEST(DualUkfRules, NoSampleMovesAWeightByMoreThanAFiftiethOfItsPrior) {
  ArmModel robot = slide();
  robot.nominal.joint[0].torque_bias = 0.2;  // 20 deviations
  DualUkf filter = filter_with(0.01, {.settle = 0.05});
  double before = 0, most = 0;
  for (const EncoderSample& sample : record_of_slide(robot, 1001, 1)) {
    filter.update(sample);
    most = std::max(most, std::abs(filter.w()(0) - before));
    before = filter.w()(0);
  }
  EXPECT_LE(most, 0.02);
  EXPECT_GT(most, 0.01);  // a step that is halved once too often would be shorter
  EXPECT_GT(before, 5);   // it goes there nevertheless
}

TEST(DualUkfRules, ALongStepGoesThroughTheSameInstantsAsSamplesWithoutReadings) {
  constexpr int kPieces = 4;
  DualUkf pieces = filter_with(0.01, {.learn = false, .settle = 0, .max_step = kSlideStep}),
          walked = filter_with(0.01, {.learn = false, .settle = 0, .max_step = 1});
  const std::vector<EncoderSample> record = record_of_slide(slide(), 201, 1);
  for (std::size_t i = 0; i < record.size(); i += kPieces) {
    const DualStep step = pieces.update(record[i]), same = walked.update(record[i]);
    for (int k = 1; k < kPieces; ++k) {
      EncoderSample blind = record[i];
      blind.time_s += k * kSlideStep;
      blind.motor_position(0) = blind.joint_position(0) = std::numeric_limits<double>::quiet_NaN();
      EXPECT_EQ(walked.update(blind).nu.size(), 0);
    }
    ASSERT_EQ(step.nu.size(), same.nu.size());
    if (step.nu.size() == 0) continue;
    // Readings of up to 1e3 rad, of which Y is a difference over 1e-3. An innovation has a deviation of 5e-4 rad.
    EXPECT_LT((step.nu - same.nu).norm(), 1e-5 * step.S_root.norm()) << record[i].time_s;
    EXPECT_LT((step.S_root - same.S_root).norm(), 1e-9 * step.S_root.norm()) << record[i].time_s;
    EXPECT_LT((step.Y - same.Y).norm(), 1e-6 * (step.Y.norm() + 1e-3)) << record[i].time_s;
  }
}

TEST(DualUkfRules, TimeThatDoesNotIncreaseIsRefusedButInANewRecord) {
  const std::vector<EncoderSample> record = record_of_slide(slide(), 3, 1);
  DualUkf filter = filter_with(0.01, {});
  filter.update(record[0]);
  filter.update(record[1]);
  EXPECT_THROW(filter.update(record[1]), std::invalid_argument);
  EXPECT_THROW(filter.update(record[0]), std::invalid_argument);
  filter.start_record();
  EXPECT_NO_THROW(filter.update(record[0]));
}

TEST(DualUkfRules, ALogarithmicWeightKeepsItsSign) {
  const Weight w{.key = "", .nominal = -3, .scale = 0.5, .logarithmic = true}, linear{"", -3, 0.5, false};
  EXPECT_EQ(w.value(0), -3);
  EXPECT_NEAR(w.value(2) / w.value(1), std::exp(0.5), 1e-15);
  EXPECT_NEAR(w.slope(1), (w.value(1 + 1e-6) - w.value(1 - 1e-6)) / 2e-6, 1e-8);
  EXPECT_EQ(linear.value(2), -2);
  EXPECT_EQ(linear.slope(2), 0.5);
}

}  // namespace
}  // namespace halyard
