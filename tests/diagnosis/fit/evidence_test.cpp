/// The rows, blocks, floors and scores of an Evidence.

#include "diagnosis/fit/evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// A log of one joint at 100 Hz, whose sensor reads what its motor says, in steps of `step` if that is not 0.
Log rigid_log(double duration, double step) {
  const JointParameters<double> j = first_joints(1).nominal.joint[0];
  Log log(1);
  for (int i = 0; i <= std::lround(100 * duration); ++i) {
    const double t = 0.01 * i, q = first_joints(1).joints[0].home + 0.3 * std::sin(1.7 * t);
    log.time.push_back(t);
    log.motor_position[0].push_back(q * j.pulley_radius / j.motor_travel());
    log.joint_position[0].push_back(step > 0 ? step * std::round(q / step) : q);
  }
  return log;
}

/// Of one joint, predicted once.
const Evidence& one_moving_joint() {
  static const Evidence evidence = brief_evidence();
  return evidence;
}

Evidence evidence_of_rigid_log(double duration, const ArmModel& model = first_joints(1), double step = 0) {
  return Evidence(make_records(rigid_log(duration, step), model, {}), model);
}

TEST(EvidenceBlocks, AreSixtyButNotShorterThanAQuarterOfASecond) {
  // The deciding ones, every other; the last one may begin with the last row.
  EXPECT_NEAR(static_cast<double>(evidence_of_rigid_log(20).block_count().size()), 30, 1);
  EXPECT_NEAR(static_cast<double>(evidence_of_rigid_log(4).block_count().size()), 8, 1);
}

TEST(EvidenceRows, AreFiftyASecondFromTheStartOfTheRecordOn) {
  const Evidence evidence = evidence_of_rigid_log(4);
  ASSERT_FALSE(evidence.row_time().empty());
  for (const double t : evidence.row_time()) EXPECT_NEAR(std::remainder(t, 0.02), 0, 1e-9);
  // Of 3.5 s one half decides.
  EXPECT_NEAR(evidence.fit_count(1), 3.5 * 50 / 2, 13);
}

TEST(EvidenceRows, OfAQuarterOfASecondAreOneSampleHoweverSlowTheSensorIs) {
  EXPECT_NEAR(evidence_of_rigid_log(20).correlated_rows(1), 12.5, 1e-9) << "50 rows a second";
  Log log = rigid_log(20, 0);
  for (std::size_t i = 0; i < log.size(); ++i)
    if (i % 10 != 0) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();  // 10 Hz
  const ArmModel model = first_joints(1);
  const Evidence slow(make_records(log, model, {}), model);
  const double rows_per_s = slow.fit_count(1) / (0.5 * 20);
  EXPECT_LT(rows_per_s, 25) << "around the readings alone";
  EXPECT_NEAR(slow.correlated_rows(1), 0.25 * rows_per_s, 0.1 * 0.25 * rows_per_s);
}

TEST(EvidenceRows, NoSampleIsWonByAHole) {
  Log log = rigid_log(20, 0);
  for (std::size_t i = 500; i < 1500; ++i) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  const ArmModel model = first_joints(1);
  EXPECT_NEAR(Evidence(make_records(log, model, {}), model).correlated_rows(1), 12.5, 0.1);
}

TEST(EvidenceFloor, OfASensorOfUnknownResolutionFollowsFromItsSmallestStep) {
  constexpr double kStep = 0.01;  // rad; readings may step by several at once
  ArmModel model = first_joints(1);
  model.nominal.joint[0].joint_encoder_resolution = 0;
  EXPECT_NEAR(evidence_of_rigid_log(4, model, kStep).resolved()[1], 0.3 * kStep, 1e-12);
  model.nominal.joint[0].joint_encoder_resolution = 0.05;
  EXPECT_NEAR(evidence_of_rigid_log(4, model, kStep).resolved()[1], 0.3 * 0.05, 1e-12) << "it is told";
}

TEST(EvidenceScore, HasTheMeanSquaresOfTheFittingRowsAndOfTheDecidingOnes) {
  const Evidence& evidence = one_moving_joint();
  const Hypothesis h{first_joints(1).nominal, {}};
  const Score score = evidence.score(h);
  const std::vector<double> rows = evidence.fit_rows({h})[0];
  for (int c = 0; c < evidence.channels(); ++c) {
    double square = 0, deciding = 0, count = 0;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (evidence.row_channel()[r] == c) square += rows[r] * rows[r];
    EXPECT_NEAR(score.fit_mean_square[c] * evidence.fit_count(c), square, 1e-12 * square) << c;
    for (std::size_t b = 0; b < score.block_sum.size(); ++b)
      deciding += score.block_sum[b][c], count += evidence.block_count()[b][c];
    EXPECT_NEAR(score.mean_square[c] * count, deciding, 1e-12 * deciding) << c;
  }
}

TEST(EvidenceFloor, AChangeIsMeasuredInThoseOfItsChannel) {
  const Evidence& evidence = one_moving_joint();
  std::vector<double> change;
  for (const int c : evidence.row_channel()) change.push_back((c == 1 ? -3 : 2) * evidence.floor()[c]);
  EXPECT_NEAR(evidence.over_floor(change), 3, 1e-12);
  EXPECT_TRUE(evidence.exceeds_floor(change, 2.99));
  EXPECT_FALSE(evidence.exceeds_floor(change, 3.01));
}

TEST(EvidenceFloor, OfATorqueIsAHundredthOfItsSizeWhileItsMotorMoves) {
  constexpr double kMoving = 0.05, kResting = 5;  // N m
  const ArmModel model = first_joints(1);
  // The joint stands from 1.5 to 2.5 s.
  Log log = log_along(4, 100, [](double t) { return 0.5 + 0.2 * std::min(t, 1.5) + 0.2 * std::max(0.0, t - 2.5); });
  for (const double t : log.time) log.motor_torque[0].push_back(t > 1.75 && t < 2.25 ? kResting : kMoving);
  EXPECT_NEAR(Evidence(make_records(log, model, {}), model).resolved()[0], 0.01 * kMoving, 1e-12);
}

TEST(EvidenceSpans, OfTheMotionAreFromItsFirstInstantToItsLastOnTheCommonClock) {
  const ArmModel model = first_joints(1);
  // The joint moves from 1 to 2 s.
  const Log log = log_along(3, 100, [](double t) { return 0.5 + 0.2 * std::clamp(t - 1, 0.0, 1.0); });
  std::vector<Record> records = make_records(log, model, {}), again = records;
  again[0].clock_shift = 4;
  records.push_back(again[0]);
  const Evidence evidence(records, model);
  // Its rate is interpolated over samples of 10 ms, and filtered over as much.
  EXPECT_NEAR(evidence.moving_span().first, 1, 0.02);
  EXPECT_NEAR(evidence.moving_span().last, 4 + 2, 0.02);
  EXPECT_NEAR(evidence.time_span().first, 0, 1e-9);
  EXPECT_NEAR(evidence.time_span().last, 4 + 3, 1e-9);
}

TEST(EvidenceSpans, OfTheMotionAreThoseOfTheMotorsThatMove) {
  const ArmModel model = first_joints(2);
  const Log of_one = log_along(3, 100, [](double t) { return 0.5 + 0.2 * std::clamp(t - 1, 0.0, 1.0); });
  Log log(2);
  log.time = of_one.time;
  log.motor_position[0] = of_one.motor_position[0];
  log.joint_position[0] = of_one.joint_position[0];
  log.motor_position[1].assign(log.size(), 204.197239);  // its rate is 0 except for rounding
  const Evidence evidence(make_records(log, model, {}), model);
  EXPECT_NEAR(evidence.moving_span().first, 1, 0.02);
  EXPECT_NEAR(evidence.moving_span().last, 2, 0.02);
}

TEST(EvidenceSpans, OfAJointWithoutSensorAreThoseOfItsMotorLessTheZeroErrorOfItsEncoder) {
  constexpr double kOffset = 3;  // rad of the motor: 0.022 of the joint
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_encoder_offset = kOffset;
  Log log = log_along(4, 100, slow_swing);
  log.joint_position[0].clear();
  for (double& q : log.motor_position[0]) q += kOffset;
  log.motor_torque[0].assign(log.size(), 0.05);
  const Span span = Evidence(make_records(log, model, {}), model).joint_span(0);
  EXPECT_NEAR(span.first, 0.5, 1e-3);
  EXPECT_NEAR(span.last, 1.1, 1e-3);
}

TEST(EvidenceSpans, OfAJointThatIsCoupledToOneWithoutMotorFollowThatOnesSensor) {
  ArmModel model = first_joints(2);
  model.nominal.joint[0].drive = Drive::none;
  model.nominal.joint[1].coupling[0] = 0.5;
  Log log(2);
  const Log of_one = log_along(4, 100, slow_swing);
  log.time = of_one.time;
  log.joint_position[0] = of_one.joint_position[0];
  const JointParameters<double>& second = model.nominal.joint[1];
  for (const double t : log.time)
    log.motor_position[1].push_back(slow_swing(t) * second.pulley_radius / second.motor_travel());
  log.motor_torque[1].assign(log.size(), 0.05);
  const Span span = Evidence(make_records(log, model, {}), model).joint_span(1);
  EXPECT_NEAR(span.last - span.first, (1 - 0.5) * (1.1 - 0.5), 1e-3) << "the motor's motion less half of joint 1's";
}

}  // namespace
}  // namespace halyard
