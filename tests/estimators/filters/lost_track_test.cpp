/// A filter on the arm between a gap, or a time of refused readings, and its restart, where motors have no reading or
/// one at times only.

#include <gtest/gtest.h>

#include <algorithm>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

constexpr std::size_t kGapBegins = 400, kGapEnds = 600;  // joint 2 then moves at -1 rad/s

/// Restarts after 0.1 s without samples or with refused readings.
class LostTrack : public testing::Test {
 protected:
  LostTrack() {
    filter_ = make_sr_ukf(raven2(), {{"gate", "0.9999"}, {"restart_gap", "0.1"}});
    filter_->reset(run_.samples[0]);
    for (std::size_t i = 1; i <= kGapBegins; ++i) take(i);
  }
  Innovation take(std::size_t i) { return filter_->update(run_.samples[i]); }
  /// Takes a sample in which only these motors have been read.
  Innovation take_only(std::size_t i, std::initializer_list<int> motors) {
    Sample s = run_.samples[i];
    for (int k = 0; k < 3; ++k)
      if (std::ranges::find(motors, k) == motors.end()) s.motor_position(k) = kNan;
    return filter_->update(s);
  }
  Eigen::Vector3d error(std::size_t i) const { return filter_->estimate().joint_position - run_.joint_position[i]; }
  /// The largest error in standard deviations.
  double relative_error(std::size_t i) const {
    return error(i).cwiseQuotient(filter_->estimate().joint_position_std).cwiseAbs().maxCoeff();
  }
  double speed_error(std::size_t i) const {
    return (filter_->estimate().joint_velocity - run_.joint_velocity[i]).norm();
  }

  static inline const ArmRun run_ = run_arm(raven2(), 0.8);
  std::unique_ptr<Estimator> filter_;
};

TEST_F(LostTrack, ARefusedReadingIsNoStartHoweverLongNoneFollows) {
  Sample outlier = run_.samples[kGapBegins + 1];
  outlier.motor_position(1) += 1;
  EXPECT_FALSE(filter_->update(outlier).accepted);
  for (std::size_t i = kGapBegins + 2; i < kGapEnds; ++i) take_only(i, {});
  EXPECT_LT(relative_error(kGapEnds - 1), 3);
  EXPECT_TRUE(take(kGapEnds).accepted);
  EXPECT_LT(error(kGapEnds).norm(), 1e-3);
  EXPECT_EQ(filter_->report().gated, 1);
}

TEST_F(LostTrack, TimeWithoutReadingsDoesNotCountAsRefused) {
  Sample outlier = run_.samples[kGapBegins + 1];
  outlier.motor_position(1) += 1;
  filter_->update(outlier);
  for (std::size_t i = kGapBegins + 2; i < kGapEnds; ++i) take_only(i, {});
  outlier = run_.samples[kGapEnds];
  outlier.motor_position(1) += 3;
  EXPECT_FALSE(filter_->update(outlier).accepted) << "the second refusal is no restart";
  EXPECT_TRUE(take(kGapEnds + 1).accepted);
}

TEST_F(LostTrack, WaitsForAllMotorsAndSaysHowLittleItKnowsUntilThen) {
  const Eigen::VectorXd before = filter_->estimate().joint_position;
  for (std::size_t i = kGapEnds; i < kGapEnds + 5; ++i) {
    EXPECT_EQ(take_only(i, {0, 2}).nu.size(), 0);
    EXPECT_EQ(filter_->estimate().joint_position, before);
    EXPECT_EQ(filter_->estimate().joint_velocity, Eigen::Vector3d::Zero());
    for (int k = 0; k < 3; ++k) {
      const double range = raven2().joints[k].upper - raven2().joints[k].lower;
      EXPECT_NEAR(filter_->estimate().joint_position_std(k), range, 1e-3 * range) << k;
    }
  }
  for (const std::size_t i : {kGapEnds + 5, kGapEnds + 6, kGapEnds + 7}) {
    take(i);
    EXPECT_LT(relative_error(i), 3) << i;
    EXPECT_LT(error(i).norm(), 2e-3) << i;  // of the stretch; joint 2 has moved by 0.2 within the gap
  }
}

TEST_F(LostTrack, ASpeedComesFromTwoSamplesThatHaveAllMotors) {
  take(kGapEnds);
  EXPECT_EQ(take_only(kGapEnds + 1, {0, 2}).nu.size(), 0) << "it waits for the third";
  EXPECT_LT(relative_error(kGapEnds + 1), 3);
  take(kGapEnds + 2);
  // Encoder steps of 0.013 mrad of joint 1 or 2, and accelerations over 2 ms.
  EXPECT_LT(speed_error(kGapEnds + 2), 0.03);
  EXPECT_LT(relative_error(kGapEnds + 2), 3);
}

TEST_F(LostTrack, FiltersWithTheOtherMotorsIfTheSecondSampleNeverComes) {
  take(kGapEnds);
  for (std::size_t i = kGapEnds + 1; i < kGapEnds + 10; ++i) EXPECT_EQ(take_only(i, {0, 2}).nu.size(), 0) << i;
  EXPECT_EQ(take_only(kGapEnds + 11, {0, 2}).nu.size(), 2);
}

TEST_F(LostTrack, SlowSamplesGiveTheSpeedToo) {
  constexpr std::size_t kApart = 20;  // ms: longer than a step
  take(kGapEnds);
  take(kGapEnds + kApart);
  // The mean speed of 20 ms, at 5 rad/s².
  EXPECT_LT(speed_error(kGapEnds + kApart), 0.15);
  take(kGapEnds + 2 * kApart);
  EXPECT_LT(relative_error(kGapEnds + 2 * kApart), 3);
}

TEST_F(LostTrack, StartsFromMotorsThatAreReadByTurns) {
  for (const std::size_t i : {0, 1}) take_only(kGapEnds + i, {static_cast<int>(i)});
  EXPECT_GT(filter_->estimate().joint_position_std(0), 1);
  take_only(kGapEnds + 2, {2});
  // The oldest reading is 2 ms old: uncertain by 0.2 % of the range.
  EXPECT_LT(relative_error(kGapEnds + 2), 3);
  EXPECT_LT(error(kGapEnds + 2).norm(), 5e-3);
  for (const std::size_t i : {3, 4, 5})
    EXPECT_EQ(take_only(kGapEnds + i, {int(i) - 3}).nu.size(), 0) << "for the speed";
  EXPECT_EQ(take_only(kGapEnds + 6, {0}).nu.size(), 1);
  EXPECT_LT(relative_error(kGapEnds + 6), 3);
}

}  // namespace
}  // namespace halyard
