#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_runs.h"

namespace halyard {
namespace {

/// What an effect at a joint adds to its motor's torque.
double added_torque(const ArmParameters<double>& arm, const PlacedEffect& effect, const Motion& m) {
  const int k = effect.joint.value_or(0);
  return evaluate(Transmission<double>(arm, {effect}), m).s[k].motor_torque -
         evaluate(Transmission<double>(arm, {}), m).s[k].motor_torque;
}

TEST(TorqueRipple, IsPeriodicInTheShaftsAngleAndDoesNoWorkOverATurn) {
  const ArmParameters<double> arm = random_arm(24, CableLaw::linear);
  const double cosine = 0.03, sine = 0.04;
  const int order = 7;
  const PlacedEffect e = placed("torque_ripple", arm, 1, {cosine, sine, order});
  const auto torque = [&](double angle) {
    Motion m;
    m.motor_angle[1] = angle;
    return added_torque(arm, e, m);
  };
  double work = 0, most = 0;
  constexpr int kSteps = 7 * 40;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * M_PI * i / kSteps;
    work += torque(angle) * 2 * M_PI / kSteps;
    most = std::max(most, std::abs(torque(angle)));
    EXPECT_NEAR(torque(angle), torque(angle + 2 * M_PI / order), 8 * kEps);  // beside a bias of 0.1 N m
  }
  EXPECT_NEAR(work, 0, 2 * M_PI * 4 * kEps);  // the rectangle rule is exact for a sine
  EXPECT_NEAR(torque(0), cosine, 4 * kEps);
  // 3-4-5; the peak lies within half a step of 2π / 40 of a sample.
  EXPECT_LE(most, 0.05 + 4 * kEps);
  EXPECT_GE(most, 0.05 * std::cos(M_PI / 40));
}

TEST(TorqueScale, TurnsTheCommandIntoTorqueByItsConstantAndBias) {
  const ArmParameters<double> arm = random_arm(25, CableLaw::linear);
  const JointParameters<double>& j = arm.joint[0];
  const Transmission<double> with(arm, {placed("torque_scale", arm, 0, {1.2, -0.3})});
  for (const double command : {-2.0, 0.0, 5.0}) {
    Motion m;  // at rest: no friction
    m.command[0] = command;
    EXPECT_NEAR(evaluate(with, m).s[0].motor_torque, 1.2 * j.torque_scale * command + j.torque_bias - 0.3,
                6 * 8 * kEps);
  }
}

TEST(Delay, OfNoTimeChangesNothingExactly) {
  const ArmParameters<double> arm = random_arm(26, CableLaw::linear);
  CommandHistory history(3, 1);
  for (int i = 0; i <= 40; ++i) {
    const double command[3] = {0.1 * i, 0.3 * i, std::sin(0.7 * i)};
    history.push(0.002 * i - 0.001, command);
  }
  const Transmission<double> with(arm, {placed("delay", arm, kWholeArm, {0, 0.003})}), without(arm, {});
  for (int i = 0; i <= 40; ++i) {
    Motion m;
    m.command[0] = 0.1 * i, m.command[1] = 0.3 * i, m.command[2] = std::sin(0.7 * i);
    const Evaluated late = evaluate(with, m, nullptr, 0.002 * i, &history), plain = evaluate(without, m, nullptr);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(late.s[k].motor_torque, plain.s[k].motor_torque) << i << ", " << k;
  }
}

TEST(Delay, LetsTheTorqueActLateAtItsJointOrAtAll) {
  const ArmParameters<double> arm = random_arm(26, CableLaw::linear);
  CommandHistory history(3, 1);
  const auto ramp = [](int joint, double time) { return (joint + 1) * 10 * time; };
  for (int i = 0; i <= 100; ++i) {
    const double command[3] = {ramp(0, i * 1e-3), ramp(1, i * 1e-3), ramp(2, i * 1e-3)};
    history.push(i * 1e-3, command);
  }
  const double now = 0.1, delay = 0.025;
  Motion m;
  for (int k = 0; k < 3; ++k) m.command[k] = ramp(k, now);
  for (const EffectPlace place : {EffectPlace(kWholeArm), EffectPlace(1)}) {
    const Transmission<double> with(arm, {placed("delay", arm, place, {delay, 0})});
    const Evaluated late = evaluate(with, m, nullptr, now, &history), blind = evaluate(with, m, nullptr, now);
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = arm.joint[k];
      const bool delayed = place < 0 || place == k;
      // Half of its 1 ms after a command was given it is in force on average. Commands of 3 N m, interpolated over
      // differences of 1e-3 s whose times have rounded at 0.1 s.
      const double then = now - (delayed ? delay + 0.5e-3 : 0);
      EXPECT_NEAR(late.s[k].motor_torque, j.torque_scale * ramp(k, then) + j.torque_bias, 3 * 100 * 4 * kEps);
      EXPECT_NEAR(blind.s[k].motor_torque, j.torque_scale * ramp(k, now) + j.torque_bias, 3 * 4 * kEps) << "no history";
    }
  }
}

TEST(Delay, OfTheArmAndOfAJointAddUp) {
  const ArmParameters<double> arm = random_arm(26, CableLaw::linear);
  CommandHistory history(3, 1);
  for (int i = 0; i <= 100; ++i) {
    const double command[3] = {std::sin(0.5 * i), std::sin(0.5 * i), std::sin(0.5 * i)};
    history.push(i * 1e-3, command);
  }
  const Transmission<double> two(
      arm, {placed("delay", arm, kWholeArm, {6e-3, 2e-3}), placed("delay", arm, 1, {6e-3, 1e-3})}),
      one(arm, {placed("delay", arm, 1, {12e-3, 3e-3})});
  Motion m;
  for (double& command : m.command) command = std::sin(50);
  EXPECT_NEAR(evaluate(two, m, nullptr, 0.1, &history).s[1].motor_torque,
              evaluate(one, m, nullptr, 0.1, &history).s[1].motor_torque, 4 * kEps);
  const auto reading = [](const Transmission<double>& t) {
    JointSignals<double> s[kMaxJoints];
    s[1].joint_rate = 2, s[1].joint_acceleration = 30;
    t.sensor_errors(0, nullptr, s);
    return s[1].joint_error;
  };
  EXPECT_NEAR(reading(two), reading(one), 4 * kEps);
}

TEST(ActuatorSaturation, EndsAtALimitThatFallsWithSpeedWhereTorqueDrives) {
  ArmParameters<double> arm = random_arm(27, CableLaw::linear);
  JointParameters<double>& j = arm.joint[2];
  j.torque_scale = 1;
  j.torque_bias = j.motor_coulomb = j.motor_viscous = 0;
  const double limit = 2, no_load = 50;
  const auto torque = [&](double command, double speed, double share) {
    Motion m;
    m.command[2] = command;
    m.motor_rate[2] = speed;
    return evaluate(Transmission<double>(arm, {placed("actuator_saturation", arm, 2, {share, limit, no_load})}), m)
        .s[2]
        .motor_torque;
  };
  for (const double way : {1.0, -1.0}) {
    for (const double command : {0.0, 0.5, 1.0}) EXPECT_EQ(torque(way * command, way * 25, 1), way * command);
    EXPECT_EQ(torque(way * 7, 0, 1), way * limit);
    EXPECT_NEAR(torque(way * 7, way * 10, 1), way * limit * 0.8, 8 * kEps);
    EXPECT_EQ(torque(way * 7, way * 50, 1), 0) << "nothing is left at the no-load speed";
    EXPECT_EQ(torque(way * 7, way * 80, 1), 0);
    EXPECT_EQ(torque(way * 7, -way * 80, 1), way * limit) << "braking";
    EXPECT_EQ(torque(way * 7, 0, 0.5), way * (7 + limit) / 2) << "half of what is beyond is lost";
  }
}

}  // namespace
}  // namespace halyard
