/// The readings from which a filter starts, and the speed between two of them.

#include "estimators/filters/start_readings.h"

#include <gtest/gtest.h>

#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

Sample reading(double time_s, double a, double b, double c) {
  return {time_s, Eigen::Vector3d::Zero(), Eigen::Vector3d(a, b, c), Eigen::VectorXd()};
}

/// Started at 1 s from the motors' angles at home; then motor 3 was read at 1.1 s, motors 1 and 2 at 1.2 s.
struct RestartedMotors {
  ArmModel model = raven2();
  Eigen::VectorXd home = unstretched_motors(model.nominal, model.home());
  StartReadings readings{{0, 1, 2}, 3};

  explicit RestartedMotors(double motor_rate) {
    readings.take(reading(1, home(0), home(1), home(2)));
    readings.start();
    readings.take(reading(1.1, kNan, kNan, home(2) + 0.1 * motor_rate));
    readings.take(reading(1.2, home(0), home(1) + 0.2 * motor_rate, kNan));
  }
};

TEST(StartReadings, AreCompleteOnceEveryMotorHasBeenRead) {
  StartReadings readings({0, 2}, 3);
  readings.take(reading(1, 0.5, 7, kNan));
  EXPECT_FALSE(readings.are_complete());
  readings.take(reading(1.25, kNan, kNan, -0.5));
  EXPECT_TRUE(readings.are_complete());
  EXPECT_EQ(readings.angles(), Eigen::Vector3d(0.5, 0, -0.5)) << "joint 2 has no motor";
  EXPECT_EQ(readings.age(2), 1) << "of the oldest";
  readings.forget();
  EXPECT_FALSE(readings.are_complete());
}

TEST(StartReadings, AreNewOnceEveryMotorHasBeenReadAgain) {
  StartReadings readings({0, 1}, 2);
  const auto both = [](double time_s, double a, double b) {
    return Sample{time_s, Eigen::Vector2d::Zero(), Eigen::Vector2d(a, b), Eigen::VectorXd()};
  };
  readings.take(both(1, 0, 0));
  readings.start();
  EXPECT_FALSE(readings.are_new(both(1.1, 0, kNan)));
  readings.take(both(1.1, 0, kNan));
  EXPECT_TRUE(readings.are_new(both(1.2, kNan, 0)));
}

TEST(StartReadings, GiveTheSpeedAlthoughMotorsAreReadByTurns) {
  const RestartedMotors r(2);
  const auto rates = r.readings.rates(r.model.nominal, r.model, r.readings.angles());
  ASSERT_TRUE(rates);
  EXPECT_NEAR(rates->shortest_s, 0.1, 1e-12);
  EXPECT_NEAR(rates->longest_s, 0.2, 1e-12);
  EXPECT_NEAR((rates->motor - Eigen::Vector3d(0, 2, 2)).norm(), 0, 1e-9);
  const Eigen::VectorXd expected = unstretched_joints(r.model.nominal, Eigen::Vector3d(0, 2, 2), r.model.home()) -
                                   unstretched_joints(r.model.nominal, Eigen::Vector3d::Zero(), r.model.home());
  EXPECT_NEAR((rates->joint - expected).norm(), 0, 1e-9);
}

TEST(StartReadings, GiveNoSpeedThatNoJointHas) {
  const RestartedMotors r(1e4);
  EXPECT_FALSE(r.readings.rates(r.model.nominal, r.model, r.readings.angles()));
}

}  // namespace
}  // namespace halyard
