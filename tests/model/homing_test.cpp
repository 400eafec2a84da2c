#include "model/homing.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/model_file.h"
#include "tests/support/message_of.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kZero = 20;  // rad, of the motor's encoder

/// Two seconds of a moving joint whose sensor is silent at first.
Log log_with_late_sensor(const ArmModel& model, double silent_s) {
  Log log(1);
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.01 * i, q = 0.3 + 0.2 * t;
    log.time.push_back(t);
    log.motor_position[0].push_back(kZero + unstretched_motors(model.nominal, Eigen::VectorXd::Constant(1, q))(0));
    log.joint_position[0].push_back(t < silent_s ? std::numeric_limits<double>::quiet_NaN() : q);
  }
  return log;
}

ArmModel arm_with_unknown_zero() {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  model.nominal.n = 1;
  model.joints.resize(1);
  model.nominal.joint[0].motor_zero_known = false;
  return model;
}

TEST(Homing, WaitsForTheFirstReadingOfTheJointsSensor) {
  const ArmModel model = arm_with_unknown_zero();
  for (const double silent_s : {0.0, 0.6, 1.5}) {
    const Log read = log_with_late_sensor(model, silent_s);
    Log homed = read;
    home_encoders(homed, model);
    EXPECT_NEAR(read.motor_position[0][0] - homed.motor_position[0][0], kZero, 1e-9) << silent_s;
  }
}

TEST(Homing, TakesNoReadingThatIsOlderThanTheMotors) {
  const ArmModel model = arm_with_unknown_zero();
  const Log read = log_with_late_sensor(model, 0);
  Log homed = read;
  for (std::size_t i = 0; i < read.size(); ++i)
    if (i % 10 != 0) homed.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  home_encoders(homed, model);
  EXPECT_NEAR(read.motor_position[0][0] - homed.motor_position[0][0], kZero, 1e-9);
}

// The sensor of the joint knows nothing of the ratio, so that the motor's zero depends on the ratio that is assumed.
TEST(Homing, KnowsTheChangesThatEffectsMake) {
  ArmModel model = arm_with_unknown_zero();
  model.effects = {place_effect(*find_effect("capstan_ratio"), model.nominal, 0)};
  model.effects[0].p[0] = 1.05;
  ArmModel changed = arm_with_unknown_zero();
  changed.nominal.joint[0].capstan_radius *= 1.05;
  const Log read = log_with_late_sensor(changed, 0);
  Log homed = read;
  home_encoders(homed, model);
  EXPECT_NEAR(read.motor_position[0][0] - homed.motor_position[0][0], kZero, 1e-9);

  // The other side: the joint's zero by the motor.
  model.nominal.joint[0].motor_zero_known = true;
  model.nominal.joint[0].motor_encoder_offset = kZero;
  model.nominal.joint[0].joint_zero_known = false;
  homed = read;
  home_encoders(homed, model);
  EXPECT_NEAR(read.joint_position[0][0] - homed.joint_position[0][0], 0, 1e-9);
}

TEST(Homing, RefusesASensorThatNeverReads) {
  const ArmModel model = arm_with_unknown_zero();
  Log log = log_with_late_sensor(model, 9);
  log.source = "rig.csv";
  EXPECT_EQ(
      message_of([&] { home_encoders(log, model); }),
      "rig.csv: the readings of motors and joint 1 that tell the zero of its encoder are missing; give a log with "
      "them, or the offset in the model");
}

}  // namespace
}  // namespace halyard
