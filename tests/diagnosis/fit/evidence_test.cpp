/// The rows, blocks, floors and scores of an Evidence.

#include "diagnosis/fit/evidence.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace halyard
