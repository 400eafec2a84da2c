#include "diagnosis/record/coarse_record.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

/// Seven samples of one joint; its sensor was read at the second and the last but one.
Record seven_samples() {
  Record r;
  r.n = 1, r.dt = 1e-3, r.start = 2, r.size = 7;
  r.motor_angle = r.joint = {{10, 11, 12, 13, 14, 15, 16}};
  r.torque_valid = {{0, 0, 0, 1, 1, 1, 1}};
  r.joint_measured = {{0, 1, 0, 0, 0, 1, 0}};
  r.compare = {1, 2, 3, 4, 5};
  return r;
}

using Samples = std::vector<double>;

TEST(CoarseRecord, HasEveryNthSampleFromTheFirstOn) {
  const Record half = coarse_record(seven_samples(), 2), third = coarse_record(seven_samples(), 3);
  EXPECT_DOUBLE_EQ(half.dt, 2e-3);
  EXPECT_DOUBLE_EQ(third.dt, 3e-3);
  EXPECT_EQ(half.start, 2);
  EXPECT_EQ(half.size, 4u);
  EXPECT_EQ(third.size, 3u);
  EXPECT_EQ(half.motor_angle[0], (Samples{10, 12, 14, 16}));
  EXPECT_EQ(third.joint[0], (Samples{10, 13, 16}));
  EXPECT_EQ(half.torque_valid[0], (Samples{0, 0, 1, 1}));
}

TEST(CoarseRecord, CountsASampleAsMeasuredIfOneOfTheNearestToItIs) {
  EXPECT_EQ(coarse_record(seven_samples(), 2).joint_measured[0], (Samples{0, 1, 0, 1}));
  EXPECT_EQ(coarse_record(seven_samples(), 3).joint_measured[0], (Samples{1, 0, 1}));
}

TEST(CoarseRecord, KeepsTheMiddleOfTheComparingKernel) {
  EXPECT_EQ(coarse_record(seven_samples(), 2).compare, (Samples{1, 3, 5}));
  EXPECT_EQ(coarse_record(seven_samples(), 3).compare, Samples{3});
}

}  // namespace
}  // namespace halyard
