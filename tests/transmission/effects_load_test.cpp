#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_runs.h"

namespace halyard {
namespace {

TEST(Payload, IsTheDirectSumOfTwoBodies) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::linear);
  for (const double mass : {0.3, -0.2}) {
    const Transmission<double> with(arm, {placed("payload", arm, kWholeArm, {mass})});
    const JointParameters<double>&before = arm.joint[2], &after = with.arm().joint[2];
    const double* r = arm.payload_point;
    EXPECT_NEAR(after.mass, before.mass + mass, 2 * kEps * before.mass);
    // The static moment, and the inertia about the frame's origin: sums over both bodies. A few roundings of numbers
    // below 2.
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(after.mass * after.com[i], before.mass * before.com[i] + mass * r[i], 8 * kEps);
    const int row[] = {0, 1, 2, 0, 0, 1}, column[] = {0, 1, 2, 1, 2, 2};
    const auto about_origin = [&](double m, const double* c, int i) {
      const double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
      return m * ((row[i] == column[i] ? square : 0) - c[row[i]] * c[column[i]]);
    };
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(after.inertia[i] + about_origin(after.mass, after.com, i),
                  before.inertia[i] + about_origin(before.mass, before.com, i) + about_origin(mass, r, i), 20 * kEps)
          << i;
    EXPECT_EQ(with.arm().joint[1].mass, arm.joint[1].mass);
  }
}

TEST(Payload, OfNothingLeavesALinkWithoutMassAsItIs) {
  ArmParameters<double> arm = random_arm(4, CableLaw::linear);
  arm.joint[2].mass = 0;
  const Transmission<double> with(arm, {placed("payload", arm, kWholeArm, {0})});
  EXPECT_EQ(with.arm().joint[2].mass, 0);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(with.arm().joint[2].com[i], arm.joint[2].com[i]);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(with.arm().joint[2].inertia[i], arm.joint[2].inertia[i]);
}

TEST(GravityTilt, TurnsGravityAndLeavesItsSize) {
  ArmParameters<double> arm = random_arm(30, CableLaw::linear);
  const double g = 9.81, alpha = 0.2, beta = -0.1;
  // Nominal gravity along an axis: the names of the two angles, and where gravity then points.
  const auto tilted = [&](int axis, const char* first, const char* second) {
    for (int i = 0; i < 3; ++i) arm.gravity[i] = i == axis ? -g : 0;
    const auto parameters = find_effect("gravity_tilt")->parameters(arm, kWholeArm);
    EXPECT_EQ(parameters[0].name, first);
    EXPECT_EQ(parameters[1].name, second);
    const Transmission<double> with(arm, {placed("gravity_tilt", arm, kWholeArm, {alpha, beta})});
    const double* turned = with.arm().gravity;
    EXPECT_NEAR(std::hypot(turned[0], turned[1], turned[2]), g, g * 4 * kEps);
    return std::vector<double>(turned, turned + 3);
  };
  // R_a(α) R_b(β) by hand, of (-g, 0, 0), (0, -g, 0), (0, 0, -g).
  const double ca = std::cos(alpha), sa = std::sin(alpha), cb = std::cos(beta), sb = std::sin(beta);
  const std::vector<double> expected[3] = {
      {-g * ca * cb, -g * sb, g * sa * cb}, {g * sb, -g * ca * cb, -g * sa * cb}, {-g * sb, g * sa * cb, -g * ca * cb}};
  const char* names[3][2] = {{"about_y", "about_z"}, {"about_x", "about_z"}, {"about_x", "about_y"}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> got = tilted(axis, names[axis][0], names[axis][1]);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[axis][i], g * 4 * kEps) << axis << i;
  }
}

TEST(GravityTilt, OfEquallyStrongAxesLeavesOutTheFirst) {
  ArmParameters<double> arm = random_arm(30, CableLaw::linear);
  arm.gravity[0] = 1;
  arm.gravity[1] = -7;
  arm.gravity[2] = 7;
  const auto parameters = find_effect("gravity_tilt")->parameters(arm, kWholeArm);
  EXPECT_EQ(parameters[0].name, "about_x");
  EXPECT_EQ(parameters[1].name, "about_z");
}

/// What external_force with parameters p adds to joint 1's force at a position and a time.
double added_force(const std::vector<double>& p, double position, double time) {
  const ArmParameters<double> arm = random_arm(31, CableLaw::linear);
  Motion m;
  m.joint_position[0] = position;
  const Evaluated with = evaluate(Transmission<double>(arm, {placed("external_force", arm, 0, p)}), m, nullptr, time);
  return with.s[0].joint_force - evaluate(Transmission<double>(arm, {}), m, nullptr, time).s[0].joint_force;
}

TEST(GravityTilt, OfATiltedArmTurnsAboutTheSameAxes) {
  ArmParameters<double> arm = random_arm(30, CableLaw::linear);
  const double alpha = 0.05, gamma = 0.3, y = -6.94, z = -6.9;
  arm.gravity[0] = 0, arm.gravity[1] = y, arm.gravity[2] = z;
  const auto tilt = [&](double about_x, double about_z) {
    return placed("gravity_tilt", arm, kWholeArm, {about_x, about_z});
  };
  // After the first, gravity is strongest along another axis.
  const Transmission<double> both(arm, {tilt(alpha, 0), tilt(0, gamma)});
  const double along_y = std::cos(alpha) * y - std::sin(alpha) * z, along_z = std::sin(alpha) * y + std::cos(alpha) * z;
  ASSERT_GT(std::abs(along_z), std::abs(along_y));
  EXPECT_NEAR(both.arm().gravity[0], -std::sin(gamma) * along_y, 10 * 4 * kEps);
  EXPECT_NEAR(both.arm().gravity[1], std::cos(gamma) * along_y, 10 * 4 * kEps);
  EXPECT_NEAR(both.arm().gravity[2], along_z, 10 * 4 * kEps);
}

TEST(Payload, MayBeAsHeavyAsTheArm) {
  ArmParameters<double> arm = random_arm(30, CableLaw::linear);
  arm.joint[2].mass = 0;
  EXPECT_EQ(find_effect("payload")->parameters(arm, kWholeArm)[0].upper, arm.joint[0].mass + arm.joint[1].mass);
}

TEST(ExternalForce, ActsFromItsStartToItsStop) {
  const std::vector<double> p = {0.7, 2, 5, 0, 0, 0};
  for (const double time : {0.0, 1.99, 5.01, 100.0}) EXPECT_EQ(added_force(p, 0.1, time), 0) << time;
  for (const double time : {2.01, 3.0, 4.99}) EXPECT_NEAR(added_force(p, 0.1, time), 0.7, 50 * 4 * kEps) << time;
  EXPECT_NEAR(added_force(p, 0.1, 2), 0.35, 50 * 4 * kEps) << "half of the step";
}

TEST(ExternalForce, RisesAndFallsInAShareOfItsDuration) {
  const std::vector<double> p = {0.7, 2, 5, 0.5, 0, 0};  // in 1.51 s
  const auto step = [](double u) { return u * u * (3 - 2 * u); };
  for (const double time : {1.244, 5.756}) EXPECT_EQ(added_force(p, 0.1, time), 0) << time;
  for (const double time : {1.5, 2.5})
    EXPECT_NEAR(added_force(p, 0.1, time), 0.7 * step((time - 2) / 1.51 + 0.5), 50 * 4 * kEps) << time;
  EXPECT_NEAR(added_force(p, 0.1, 3.5), 0.7, 50 * 4 * kEps);
  EXPECT_NEAR(added_force(p, 0.1, 4.5), added_force(p, 0.1, 2.5), 50 * 4 * kEps) << "it falls as it rose";
}

TEST(ExternalForce, AContactPushesBackFromItsSideAlone) {
  const double stiffness = 30, wall = 0.2;
  for (const double depth : {0.0, 0.01, 0.1}) {
    // Cables pull with up to 50 N m.
    EXPECT_NEAR(added_force({0, 1, 2, 0, stiffness, wall}, wall + depth, 0), -stiffness * depth, 50 * 8 * kEps);
    EXPECT_NEAR(added_force({0, 1, 2, 0, -stiffness, wall}, wall - depth, 0), stiffness * depth, 50 * 8 * kEps);
    EXPECT_EQ(added_force({0, 1, 2, 0, stiffness, wall}, wall - 1e-9 - depth, 0), 0) << "no wall pulls";
    EXPECT_EQ(added_force({0, 1, 2, 0, -stiffness, wall}, wall + 1e-9 + depth, 0), 0) << "no wall pulls";
  }
}

TEST(GravityTilt, OfAnArmThatHangsAlongXTurnsAboutTheSameAxesAgain) {
  ArmParameters<double> arm = random_arm(30, CableLaw::linear);
  const double alpha = 0.05, gamma = 0.3, x = -6.94, y = -6.9;
  arm.gravity[0] = x, arm.gravity[1] = y, arm.gravity[2] = 0;
  const auto tilt = [&](double about_y, double about_z) {
    return placed("gravity_tilt", arm, kWholeArm, {about_y, about_z});
  };
  // After the first, gravity is strongest along another axis.
  const Transmission<double> both(arm, {tilt(0, alpha), tilt(gamma, 0)});
  const double along_x = std::cos(alpha) * x - std::sin(alpha) * y, along_y = std::sin(alpha) * x + std::cos(alpha) * y;
  ASSERT_GT(std::abs(along_y), std::abs(along_x));
  EXPECT_NEAR(both.arm().gravity[0], std::cos(gamma) * along_x, 10 * 4 * kEps);
  EXPECT_NEAR(both.arm().gravity[1], along_y, 10 * 4 * kEps);
  EXPECT_NEAR(both.arm().gravity[2], -std::sin(gamma) * along_x, 10 * 4 * kEps);
}

TEST(ExternalForce, MayStopWhenItStartsButNotBefore) {
  const Effect& effect = *find_effect("external_force");
  const double at_once[kMaxEffectParameters] = {1, 2, 2}, before[kMaxEffectParameters] = {1, 2.5, 2};
  EXPECT_EQ(effect.fault_of(at_once), "");
  EXPECT_EQ(effect.fault_of(before), "stop is before start; exchange them");
}

}  // namespace
}  // namespace halyard
