#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_runs.h"

namespace halyard {
namespace {

TEST(MotorFriction, NeverGivesPowerWithinItsBounds) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  arm.joint[1].torque_bias = 0;
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<double> p = within_bounds(find_effect("motor_friction")->parameters(arm, 1), random);
    const Transmission<double> t(arm, {placed("motor_friction", arm, 1, p)});
    const Motion m = random_motion(random);
    // The level can be zero, or its asymmetry one: what is left is the rounding of two equal terms of 10 N m at most.
    EXPECT_LE(evaluate(t, m).s[1].motor_torque * m.motor_rate[1], 10 * 2 * kEps);
  }
}

TEST(JointFriction, NeverGivesPowerWithinItsBounds) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  ArmParameters<double> frictionless = arm;
  frictionless.joint[1].joint_coulomb = frictionless.joint[1].joint_viscous = 0;
  const Transmission<double> none(frictionless, {});
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<double> p = within_bounds(find_effect("joint_friction")->parameters(arm, 1), random);
    const Transmission<double> t(arm, {placed("joint_friction", arm, 1, p)});
    const Motion m = random_motion(random);
    const double friction = evaluate(t, m).s[1].joint_force - evaluate(none, m).s[1].joint_force;
    // The reaction of cables, up to 50 N m, is subtracted again.
    EXPECT_LE(friction * m.joint_rate[1], 50 * 4 * kEps);
  }
}

TEST(Friction, AsymmetryPartsTheLevelsOfBothWaysByItsShare) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.motor_viscous = j.joint_viscous = j.torque_bias = 0;
  const double change = 0.1, alpha = 0.2;
  const Transmission<double> motor(arm, {placed("motor_friction", arm, 0, {change, 0, alpha})});
  const Transmission<double> joint(arm, {placed("joint_friction", arm, 0, {change, 0, alpha})});
  const Transmission<double> none(arm, {});
  for (const double way : {1.0, -1.0}) {
    Motion m;
    m.motor_rate[0] = way * 40 * j.motor_smoothing;  // tanh(40) is 1
    EXPECT_NEAR(-way * evaluate(motor, m).s[0].motor_torque, (j.motor_coulomb + change) * (1 + way * alpha), 4 * kEps);
    m = Motion{};
    m.joint_rate[0] = way * 40 * j.joint_smoothing;
    const double more = evaluate(none, m).s[0].joint_force - evaluate(joint, m).s[0].joint_force;
    // Damping forces reach 100 N m.
    EXPECT_NEAR(way * more, change + (j.joint_coulomb + change) * way * alpha, 100 * 4 * kEps);
  }
}

TEST(Presliding, TurnsRoundOverItsDeflectionHoweverSlowTheMotion) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  const double deflection = 0.2, share = 0.7;
  const Transmission<double> motor(arm, {placed("motor_presliding", arm, 1, {share, deflection})});
  const Transmission<double> joint(arm, {placed("joint_presliding", arm, 1, {share, deflection})});
  for (const double speed : {1e-3, 1.0}) {
    double of_motor = 0, of_joint = 0;
    Motion m;
    const auto slide = [&](double way, double path) {
      constexpr int kSteps = 20000;
      m.motor_rate[1] = m.joint_rate[1] = way * speed;
      for (int i = 0; i < kSteps; ++i) {
        of_motor += path / speed / kSteps * evaluate(motor, m, &of_motor).z_dot[0];
        of_joint += path / speed / kSteps * evaluate(joint, m, &of_joint).z_dot[0];
      }
    };
    slide(1, 20 * deflection);
    slide(-1, deflection);
    // From z_y: z = -z_y + 2 z_y exp(-x / z_y). Euler's steps of 5e-5 z_y are off by half of that.
    const double z = deflection * (-1 + 2 * std::exp(-1));
    EXPECT_NEAR(of_motor, z, 5e-5 * deflection);
    EXPECT_NEAR(of_joint, z, 5e-5 * deflection);
    const JointParameters<double>& j = arm.joint[1];
    const auto held = [&](double z_y, double v_s) { return share * (z / z_y - std::tanh(-speed / v_s)); };
    const Transmission<double> none(arm, {});
    const Evaluated bare = evaluate(none, m);
    EXPECT_NEAR(bare.s[1].motor_torque - evaluate(motor, m, &z).s[1].motor_torque,
                j.motor_coulomb * held(deflection, j.motor_smoothing), 1e-12);
    EXPECT_NEAR(bare.s[1].joint_force - evaluate(joint, m, &z).s[1].joint_force,
                j.joint_coulomb * held(deflection, j.joint_smoothing), 1e-12);
  }
}

TEST(Presliding, GivesBackNoMoreThanItStored) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  ArmParameters<double> frictionless = arm;
  frictionless.joint[1].joint_coulomb = frictionless.joint[1].joint_viscous = 0;
  arm.joint[1].torque_bias = frictionless.joint[1].torque_bias = 0;
  const Transmission<double> none(frictionless, {});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const Motion m = random_motion(random);
    const auto p = within_bounds(find_effect("motor_presliding")->parameters(arm, 1), random);
    const auto q = within_bounds(find_effect("joint_presliding")->parameters(arm, 1), random);
    const double y = p[1] * unit(random), z = q[1] * unit(random);
    const Evaluated motor = evaluate(Transmission<double>(arm, {placed("motor_presliding", arm, 1, p)}), m, &y);
    const Evaluated joint = evaluate(Transmission<double>(arm, {placed("joint_presliding", arm, 1, q)}), m, &z);
    // The energy stored is ρ F_c z² / (2 z_y).
    const double stored_at_motor = p[0] * arm.joint[1].motor_coulomb * y / p[1] * motor.z_dot[0];
    const double stored_at_joint = q[0] * arm.joint[1].joint_coulomb * z / q[1] * joint.z_dot[0];
    const double force = joint.s[1].joint_force - evaluate(none, m).s[1].joint_force;
    // Terms of 10 N m, and of 50 N m for the reaction of cables, round when they are subtracted.
    EXPECT_LE(motor.s[1].motor_torque * m.motor_rate[1] + stored_at_motor, 10 * 4 * kEps);
    EXPECT_LE(force * m.joint_rate[1] + stored_at_joint, 50 * 4 * kEps);
  }
}

TEST(PulleyFriction, GrowsWithTensionAndLoadAndNotWithSpeed) {
  ArmParameters<double> arm = random_arm(6, CableLaw::linear);
  arm.joint[0].damping = 0;
  const double mu = 0.05, share = 0.3;
  const auto forces = [&](double tension, double stretch, double speed) {
    arm.joint[0].tension = tension;
    const Transmission<double> bare(arm, {}), with(arm, {placed("pulley_friction", arm, 0, {mu, share})});
    Motion m = stretched(arm, 0, stretch, 0);
    m.motor_rate[0] = speed * arm.joint[0].motor_smoothing;
    m.joint_rate[0] = speed * arm.joint[0].joint_smoothing;
    const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
    return std::pair(a.s[0].cable_force_motor - b.s[0].cable_force_motor,
                     a.s[0].cable_force_joint - b.s[0].cable_force_joint);
  };
  // Speeds of 40 v_s and above slide fully.
  for (const double tension : {20.0, 40.0})
    for (const double stretch : {0.0, 0.1, -0.1}) {
      const double level = mu * (2 * tension + 2 * arm.joint[0].stiffness * std::abs(stretch));
      for (const double speed : {40.0, 80.0, -40.0}) {
        const auto [motor, joint] = forces(tension, stretch, speed);
        const double sign = speed > 0 ? 1 : -1;
        EXPECT_NEAR(motor, sign * share * level, 100 * 4 * kEps);
        EXPECT_NEAR(joint, -sign * (1 - share) * level, 100 * 4 * kEps);
      }
    }
}

TEST(PulleyFriction, TakesPowerFromEveryMotion) {
  std::mt19937_64 random(1);
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(6, law);
    for (const double share : {0.0, 0.4, 1.0}) {
      const Transmission<double> bare(arm, {}), with(arm, {placed("pulley_friction", arm, 1, {0.3, share})});
      for (int trial = 0; trial < 50; ++trial) {
        const Motion m = random_motion(random);
        const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
        double power = 0;  // that the friction gives to motors and joints
        for (int k = 0; k < 3; ++k) {
          const double taken = a.s[k].cable_force_motor - b.s[k].cable_force_motor;
          power -= arm.joint[k].motor_travel() * taken * m.motor_rate[k];
          power += (a.s[k].joint_force - b.s[k].joint_force) * m.joint_rate[k];
        }
        EXPECT_LT(power, 0);
      }
    }
  }
}

TEST(Friction, ViscousAsymmetryPartsTheCoefficientsOfBothWaysByItsShare) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.motor_coulomb = j.joint_coulomb = j.torque_bias = 0;
  const double change = 0.1, alpha = 0.3;
  const Transmission<double> motor(arm, {placed("motor_friction", arm, 0, {0, change, 0, alpha})});
  const Transmission<double> joint(arm, {placed("joint_friction", arm, 0, {0, change, 0, alpha})});
  const Transmission<double> none(arm, {});
  for (const double way : {1.0, -1.0}) {
    Motion m;
    const double v = m.motor_rate[0] = way * 40 * j.motor_smoothing;  // tanh(40) is 1
    EXPECT_NEAR(-evaluate(motor, m).s[0].motor_torque, (j.motor_viscous + change) * (1 + way * alpha) * v,
                20 * 8 * kEps);
    m = Motion{};
    const double q_dot = m.joint_rate[0] = way * 40 * j.joint_smoothing;
    const double more = evaluate(none, m).s[0].joint_force - evaluate(joint, m).s[0].joint_force;
    // Damping forces reach 100 N m.
    EXPECT_NEAR(more, (change + (j.joint_viscous + change) * way * alpha) * q_dot, 100 * 4 * kEps);
  }
}

/// What an effect at a joint adds to the friction there and at its motor.
struct AddedFriction {
  double motor, joint;
};
AddedFriction added_friction(const ArmParameters<double>& arm, const PlacedEffect& effect, const Motion& m,
                             double time = 0) {
  const int k = *effect.joint;
  const Evaluated without = evaluate(Transmission<double>(arm, {}), m, nullptr, time);
  const Evaluated with = evaluate(Transmission<double>(arm, {effect}), m, nullptr, time);
  return {without.s[k].motor_torque - with.s[k].motor_torque, without.s[k].joint_force - with.s[k].joint_force};
}

TEST(Stribeck, FallsFromItsRiseAtStandstillAsAGaussOfSpeed) {
  ArmParameters<double> arm = random_arm(20, CableLaw::linear);
  arm.joint[1].motor_smoothing = arm.joint[1].joint_smoothing = 1e-4;
  arm.joint[1].damping = 0;
  const double at_joint = 0.3, at_motor = 0.2, joint_speed = 0.05, motor_speed = 0.5;
  const PlacedEffect e = placed("stribeck", arm, 1, {at_joint, joint_speed, at_motor, motor_speed});
  for (const double way : {1.0, -1.0})
    for (const double u : {0.1, 1.0, 2.0, 10.0}) {  // above 40 smoothing speeds tanh is 1
      Motion m;
      m.joint_rate[1] = way * u * joint_speed;
      m.motor_rate[1] = way * u * motor_speed;
      const AddedFriction f = added_friction(arm, e, m);
      // Subtracted from torques and forces of the order of 1.
      EXPECT_NEAR(f.joint, way * at_joint * std::exp(-u * u), 8 * kEps) << u;
      EXPECT_NEAR(f.motor, way * at_motor * std::exp(-u * u), 8 * kEps) << u;
    }
}

TEST(Stribeck, NeverGivesPowerWithinItsBounds) {
  const ArmParameters<double> arm = random_arm(20, CableLaw::linear);
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const auto p = within_bounds(find_effect("stribeck")->parameters(arm, 2), random);
    const Motion m = random_motion(random);
    const AddedFriction f = added_friction(arm, placed("stribeck", arm, 2, p), m);
    EXPECT_GE(f.joint * m.joint_rate[2], -100 * 4 * kEps);  // rounding of forces up to 100 N
    EXPECT_GE(f.motor * m.motor_rate[2], -10 * 4 * kEps);
  }
}

TEST(Stribeck, HasOnlyTheJointsPartWhereThereIsNoMotor) {
  ArmParameters<double> arm = random_arm(20, CableLaw::linear);
  arm.joint[0].drive = Drive::none;
  EXPECT_EQ(find_effect("stribeck")->parameters(arm, 0).size(), 2u);
  Motion m;
  m.joint_rate[0] = m.motor_rate[0] = 0.5;
  const AddedFriction f = added_friction(arm, placed("stribeck", arm, 0, {0.3, 1}), m);
  EXPECT_GT(f.joint, 0.1);
  EXPECT_EQ(f.motor, 0);
}

TEST(FrictionDrift, ScalesAllFrictionOfMotorAndJointFromItsStartToItsEnd) {
  ArmParameters<double> arm = random_arm(21, CableLaw::linear);
  ArmParameters<double> twice = arm;  // the model's friction twice: the difference is the friction itself
  JointParameters<double>& j = twice.joint[0];
  j.motor_coulomb *= 2, j.motor_viscous *= 2, j.joint_coulomb *= 2, j.joint_viscous *= 2;
  std::mt19937_64 random(5);
  const double tau = 20;
  struct Course {
    double start, drift, joint_share;
  };
  for (const auto& [start, drift, joint_share] : {Course{0, -0.4, 1}, {0, 1.5, 1}, {1.4, -1.4, 0}}) {
    const Motion m = random_motion(random);
    const Evaluated one = evaluate(Transmission<double>(arm, {}), m),
                    two = evaluate(Transmission<double>(twice, {}), m);
    const double motor = one.s[0].motor_torque - two.s[0].motor_torque,
                 joint = one.s[0].joint_force - two.s[0].joint_force;
    ASSERT_GT(std::abs(motor), 0.01);
    ASSERT_GT(std::abs(joint), 0.01);
    for (const double time : {-5.0, 0.0, 20.0, 60.0, 2000.0}) {
      const double change = start + drift * (time <= 0 ? 0 : 1 - std::exp(-time / tau));
      const AddedFriction f =
          added_friction(arm, placed("friction_drift", arm, 0, {drift / tau, start, 1 / tau, joint_share}), m, time);
      EXPECT_NEAR(f.motor, change * motor, 10 * 4 * kEps) << time;
      EXPECT_NEAR(f.joint, joint_share * change * joint, 100 * 4 * kEps) << time;  // cables pull with up to 100 N
    }
  }
}

TEST(FrictionDrift, TakesNoMoreThanAllFrictionAway) {
  const ArmParameters<double> arm = random_arm(21, CableLaw::linear);
  ArmParameters<double> smooth = arm;
  JointParameters<double>& j = smooth.joint[0];
  j.motor_coulomb = j.motor_viscous = j.joint_coulomb = j.joint_viscous = 0;
  std::mt19937_64 random(5);
  const Motion m = random_motion(random);
  // Half of it a second, over ten seconds.
  const Transmission<double> drifting(arm, {placed("friction_drift", arm, 0, {-0.5, 0, 0, 1})});
  const Evaluated a = evaluate(drifting, m, nullptr, 10),
                  b = evaluate(Transmission<double>(smooth, {}), m, nullptr, 10);
  EXPECT_NEAR(a.s[0].motor_torque, b.s[0].motor_torque, 10 * 4 * kEps);
  EXPECT_NEAR(a.s[0].joint_force, b.s[0].joint_force, 100 * 4 * kEps);  // cables pull with up to 100 N
}

TEST(FrictionDrift, LeavesPreslidingFrictionPassive) {
  ArmParameters<double> arm = random_arm(21, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.motor_viscous = j.joint_viscous = j.torque_bias = 0;
  const PlacedEffect drift = placed("friction_drift", arm, 0, {0, -0.5, 0, 1});
  const Transmission<double> motor(arm, {placed("motor_presliding", arm, 0, {0.8, 0.2}), drift});
  const Transmission<double> joint(arm, {placed("joint_presliding", arm, 0, {0.8, 0.2}), drift}), none(arm, {});
  const double at_reversal = 0;  // the contacts are not deflected; what is left is half of a fifth
  Motion m;
  m.motor_rate[0] = 40 * j.motor_smoothing;  // tanh(40) is 1
  EXPECT_NEAR(-evaluate(motor, m, &at_reversal).s[0].motor_torque, 0.1 * j.motor_coulomb, 4 * kEps);
  m = Motion{};
  m.joint_rate[0] = 40 * j.joint_smoothing;
  const double less = evaluate(joint, m, &at_reversal).s[0].joint_force - evaluate(none, m).s[0].joint_force;
  EXPECT_NEAR(less, 0.9 * j.joint_coulomb, 100 * 4 * kEps);  // cables pull with up to 100 N
}

}  // namespace
}  // namespace halyard
