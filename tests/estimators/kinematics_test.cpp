#include "estimators/filters/kinematics.h"

#include <gtest/gtest.h>

#include "estimators/built_in.h"
#include "model/input_error.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

Sample at_angles(double time_s, const Eigen::VectorXd& q_m) {
  Sample s;
  s.time_s = time_s;
  s.motor_position = q_m;
  s.motor_torque = Eigen::VectorXd::Zero(q_m.size());
  return s;
}

TEST(Kinematics, InvertsThePathEquation) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::Vector3d q(0.3, 1.7, 0.33);
  kinematics.reset(at_angles(0, unstretched_motors(model.nominal, q)));
  // Cable paths of 0.3 m over pulleys of 0.06 m, 10 roundings.
  EXPECT_LT((kinematics.estimate().joint_position - q).cwiseAbs().maxCoeff(), 10 * 5 * kEps);
  EXPECT_EQ(kinematics.estimate().joint_velocity.norm(), 0);
}

TEST(Kinematics, VelocityIsTheDifferenceOfSamples) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::Vector3d q(0.3, 1.7, 0.33), v(0.5, -0.2, 0.04);
  kinematics.reset(at_angles(0, unstretched_motors(model.nominal, q)));
  const Innovation innovation =
      kinematics.update(at_angles(0.002, unstretched_motors(model.nominal, Eigen::Vector3d(q + 0.002 * v))));
  EXPECT_EQ(innovation.nu.size(), 0);
  EXPECT_EQ(innovation.time_s, 0.002);
  // Two positions to 50 eps each, over 2 ms.
  EXPECT_LT((kinematics.estimate().joint_velocity - v).cwiseAbs().maxCoeff(), 100 * kEps / 0.002);
}

TEST(Kinematics, AMissingMotorSampleHoldsItsLastAngle) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::VectorXd q_m = unstretched_motors(model.nominal, Eigen::Vector3d(0.3, 1.7, 0.33));
  kinematics.reset(at_angles(0, q_m));
  const Eigen::VectorXd before = kinematics.estimate().joint_position;
  Eigen::VectorXd gone = q_m;
  gone(1) = kNan;
  kinematics.update(at_angles(0.001, gone));
  EXPECT_EQ(kinematics.estimate().joint_position, before);
}

TEST(Kinematics, CountsItsStepsSinceTheStart) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::VectorXd q_m = unstretched_motors(model.nominal, model.home());
  for (const int steps : {3, 2}) {
    kinematics.reset(at_angles(0, q_m));
    EXPECT_EQ(kinematics.report().steps, 0);
    for (int i = 1; i <= steps; ++i) kinematics.update(at_angles(1e-3 * i, q_m));
    EXPECT_EQ(kinematics.report().steps, steps);
  }
}

TEST(Kinematics, TakesParametersThatEffectsChange) {
  ArmModel model = raven2();
  add_effect(model, "capstan_ratio", 0, {1.05});
  add_effect(model, "encoder_offset", 2, {0.004});
  KinematicsEstimator kinematics(model);
  const ProcessModel process(model);
  const Eigen::Vector3d q(0.3, 1.7, 0.33);
  const Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), q), q);
  kinematics.reset(at_angles(0, process.motor_readings(0, x)));
  EXPECT_LT((kinematics.estimate().joint_position - q).cwiseAbs().maxCoeff(), 20 * 5 * kEps);
}

TEST(Kinematics, RefusesTimeThatDoesNotIncrease) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::VectorXd q_m = unstretched_motors(model.nominal, model.home());
  kinematics.reset(at_angles(1, q_m));
  EXPECT_THROW(kinematics.update(at_angles(1, q_m)), std::invalid_argument);
}

TEST(Kinematics, HasNoOptions) {
  try {
    make_kinematics(raven2(), {{"alpha", "1"}});
    FAIL() << "accepted an option";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "estimator kinematics: unknown option 'alpha'; it has no options");
  }
}

TEST(Kinematics, VelocityIsThatSinceTheSampleBefore) {
  constexpr double kTick = 1.0 / 512;  // s; sums of it are exact
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  const Eigen::Vector3d q(0.3, 1.7, 0.33), first(0.5, -0.2, 0.04), second(-0.3, 0.4, 0.02);
  const Eigen::Vector3d q_1 = q + kTick * first, q_2 = q_1 + 3 * kTick * second;
  kinematics.reset(at_angles(2, unstretched_motors(model.nominal, q)));
  kinematics.update(at_angles(2 + kTick, unstretched_motors(model.nominal, q_1)));
  kinematics.update(at_angles(2 + 4 * kTick, unstretched_motors(model.nominal, q_2)));
  // Two positions to 50 eps each, over three ticks.
  EXPECT_LT((kinematics.estimate().joint_velocity - second).cwiseAbs().maxCoeff(), 100 * kEps / (3 * kTick));
}

TEST(Kinematics, AMotorThatHasNotBeenReadInARecordIsAtHome) {
  const ArmModel model = raven2();
  KinematicsEstimator kinematics(model);
  kinematics.reset(at_angles(0, unstretched_motors(model.nominal, Eigen::Vector3d(0.3, 1.7, 0.33))));
  kinematics.reset(at_angles(0, Eigen::Vector3d::Constant(kNan)));
  // As of the path equation.
  EXPECT_LT((kinematics.estimate().joint_position - model.home()).cwiseAbs().maxCoeff(), 10 * 5 * kEps);
}

}  // namespace
}  // namespace halyard
