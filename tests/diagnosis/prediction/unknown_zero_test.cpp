/// Residuals of a joint whose encoder has an unknown zero.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/prediction/prediction.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

double mean_of_known(const std::vector<double>& x) {
  double sum = 0, count = 0;
  for (const double v : x)
    if (!std::isnan(v)) sum += v, count += 1;
  return sum / count;
}

TEST(UnknownZero, OfEitherEncoderTakesOffTheMeanOfItsJointsResidualAlone) {
  constexpr double kOff = 0.2;  // rad
  const ArmModel model = first_joints(2);
  Log log = simulate(motion(model, 2)).measured;
  for (std::vector<double>& column : log.joint_position)
    for (double& q : column) q += kOff;
  const Record record = make_records(log, model, {})[0];
  const Hypothesis known{model.nominal, {}};
  Hypothesis motor = known, joint = known;
  motor.nominal.joint[0].motor_zero_known = joint.nominal.joint[0].joint_zero_known = false;
  const std::vector<Residuals> all = predict(record, {known, motor, joint}, 10);
  // Of the right arm little is left beside the offset.
  EXPECT_NEAR(mean_of_known(all[0].channel[2]), kOff, 0.01 * kOff);
  for (const std::size_t unknown : {1, 2}) {
    EXPECT_NEAR(mean_of_known(all[unknown].channel[2]), 0, 1e-12);
    EXPECT_NEAR(mean_of_known(all[unknown].channel[3]), kOff, 0.01 * kOff) << "the other joint's is known";
    EXPECT_NEAR(all[unknown].channel[2][80], all[0].channel[2][80] - mean_of_known(all[0].channel[2]), 1e-12);
  }
}

}  // namespace
}  // namespace halyard
