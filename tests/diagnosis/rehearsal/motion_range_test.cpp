#include "diagnosis/rehearsal/motion_range.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/holdout/holdout.h"
#include "tests/diagnosis/fit/made_log.h"

namespace halyard {
namespace {

TEST(MotionRange, OfASwingIsItsReachItsSpeedAndItsTime) {
  constexpr double kOffset = 2;  // rad, of the motor's encoder
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_encoder_offset = kOffset;
  Log log = log_along(4, 100, slow_swing);
  for (double& reading : log.motor_position[0]) reading += kOffset;
  const MotionRange range = motion_range(make_records(log, model, kFitBand), model.nominal);
  EXPECT_NEAR(range.record.from, 0, 1e-9);
  EXPECT_NEAR(range.record.to, 4, 0.011);
  // 0.8 - 0.3 cos(1.7 t): the low-pass filter of 60 Hz takes 1e-5 of its amplitude.
  EXPECT_NEAR(range.joint[0].from, 0.5, 1e-4);
  EXPECT_NEAR(range.joint[0].to, 1.1, 1e-4);
  EXPECT_NEAR(range.fastest[0], 0.3 * 1.7, 1e-3);
}

}  // namespace
}  // namespace halyard
