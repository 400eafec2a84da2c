#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_runs.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

TEST(EncoderOffset, ShiftsWhereKinematicsPutsTheJointByTheOffset) {
  const double offset = -0.07;
  for (int k = 0; k < 3; ++k) {
    ArmParameters<double> arm = random_arm(12, CableLaw::linear);
    for (int j = 0; j < 3; ++j) arm.joint[j].motor_encoder_offset = 0;
    const Transmission<double> with(arm, {placed("encoder_offset", arm, k, {offset})});
    JointSignals<double> s[kMaxJoints];
    with.sensor_errors(0, nullptr, s);
    // With all else at zero the reading is that of a joint at `offset`, whose coupling moves other cables that do not
    // move: so the cable's own path counts.
    Eigen::Vector3d q_m = Eigen::Vector3d::Zero();
    for (int j = 0; j < 3; ++j) q_m(j) = s[j].motor_error;
    const Eigen::VectorXd path = path_matrix(arm) * unstretched_joints(arm, q_m, Eigen::Vector3d::Zero());
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(path(j) / arm.joint[j].pulley_radius, j == k ? offset : 0, 8 * kEps);
  }
}

TEST(EncoderOffset, OfTheJointsSensorLooksFromThisJointLikeThatOfItsMotor) {
  const double offset = -0.07;
  ArmParameters<double> arm = random_arm(12, CableLaw::linear);
  for (int j = 0; j < 3; ++j) arm.joint[j].motor_encoder_offset = arm.joint[j].joint_encoder_offset = 0;
  const Transmission<double> with(arm, {placed("encoder_offset", arm, 0, {offset, 1})});
  JointSignals<double> s[kMaxJoints];
  with.sensor_errors(0, nullptr, s);
  EXPECT_EQ(s[0].motor_error, 0);
  EXPECT_EQ(s[0].joint_error, -offset) << "the motor's encoder tells more than the joint's sensor by the offset";
  EXPECT_EQ(find_effect("encoder_offset")->parameters(arm, 0).size(), 2u);
  for (int j = 0; j + 1 < arm.n; ++j) arm.joint[j].coupling[arm.n - 1] = 0;
  EXPECT_EQ(find_effect("encoder_offset")->parameters(arm, arm.n - 1).size(), 1u)
      << "the last joint moves no other cable";
}

TEST(EncoderEccentricity, IsPeriodicInTheJointAndOfZeroMean) {
  ArmParameters<double> arm = random_arm(22, CableLaw::linear);
  const double cosine = 0.02, sine = -0.01;
  for (const int k : {0, 2}) {  // an angle, a length
    const double order = k == 0 ? 3 : 200, period = 2 * M_PI / order;
    const Transmission<double> bare(arm, {}),
        with(arm, {placed("encoder_eccentricity", arm, k, {cosine, sine, order})});
    const auto error = [&](double q) {
      Motion m;
      m.joint_position[k] = q;
      const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
      EXPECT_EQ(a.s[k].motor_error, b.s[k].motor_error);
      EXPECT_EQ(a.s[k].joint_force, b.s[k].joint_force) << "a sensor moves nothing";
      return a.s[k].joint_error - b.s[k].joint_error;
    };
    double mean = 0, square = 0;
    for (int i = 0; i < 12; ++i) {
      const double q = 0.1 * period + i * period / 12;
      // Phases of up to 10 rad.
      EXPECT_NEAR(error(q), error(q + period), 0.02 * 100 * kEps);
      mean += error(q) / 12, square += error(q) * error(q) / 12;
    }
    EXPECT_NEAR(mean, 0, 0.1 * 4 * kEps);  // the sensor's own offset, 0.1, is subtracted
    EXPECT_NEAR(square, (cosine * cosine + sine * sine) / 2, 0.01 * 4 * kEps);
    EXPECT_NEAR(error(0), cosine, 0.1 * 4 * kEps);
    EXPECT_NEAR(error(period / 4), sine, 0.1 * 4 * kEps);
  }
}

TEST(Delay, LetsTheJointsSensorReadWhatWasAMomentAgo) {
  const ArmParameters<double> arm = random_arm(23, CableLaw::linear);
  const double w = 5, amplitude = 0.3;
  for (const double delay : {0.01, -0.01}) {
    const Transmission<double> with(arm, {placed("delay", arm, 1, {0, delay})});
    for (double t = 0; t < 1; t += 0.05) {
      JointSignals<double> s[kMaxJoints];
      for (int k = 0; k < 3; ++k) {
        s[k].joint_position = amplitude * std::sin(w * t);
        s[k].joint_rate = amplitude * w * std::cos(w * t);
        s[k].joint_acceleration = -amplitude * w * w * std::sin(w * t);
      }
      with.sensor_errors(0, nullptr, s);
      const double reading = s[1].joint_position + s[1].joint_error - arm.joint[1].joint_encoder_offset;
      // The remainder of the second order.
      EXPECT_NEAR(reading, amplitude * std::sin(w * (t - delay)), amplitude * std::pow(w * std::abs(delay), 3) / 6);
      for (const int other : {0, 2}) EXPECT_EQ(s[other].joint_error, arm.joint[other].joint_encoder_offset);
    }
  }
}

}  // namespace
}  // namespace halyard
