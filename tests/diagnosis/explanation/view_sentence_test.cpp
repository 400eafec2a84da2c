#include "diagnosis/explanation/view_sentence.h"

#include <gtest/gtest.h>

#include <numbers>

namespace halyard {
namespace {

/// A revolute joint with small motor friction, a prismatic one, and a linear motor: 1 m of its joint per "rad".
ArmParameters<double> three_kinds() {
  ArmParameters<double> arm;
  arm.n = 3;
  for (int k = 0; k < 3; ++k) arm.joint[k].motor_coulomb = 1e-3;
  arm.joint[0].type = JointType::revolute;
  for (int k : {1, 2}) arm.joint[k].type = JointType::prismatic;
  for (int k : {0, 1}) arm.joint[k].gear_ratio = 12, arm.joint[k].capstan_radius = arm.joint[k].pulley_radius = 0.01;
  arm.joint[2].gear_ratio = arm.joint[2].pulley_radius = 1;
  arm.joint[2].capstan_radius = 0.97;  // as refitted
  return arm;
}

/// The phrase for a swing of 0.002 in SI that explains three quarters.
std::string phrase(ResidualKind residual, Abscissa abscissa, int joint = 0, bool loop = false) {
  View view;
  view.residual = residual;
  view.abscissa = abscissa;
  view.loop = loop;
  view.swing = 2e-3;
  view.explained_before = 0.75;
  view.line.frequency = 3;
  return view_phrase(view, three_kinds(), joint);
}

TEST(ViewSentence, NamesWhatTheResidualGoesWith) {
  const ResidualKind position = ResidualKind::joint_position, torque = ResidualKind::motor_torque;
  EXPECT_EQ(phrase(position, Abscissa::joint_position),
            "follows the joint position, 0.115 deg from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(position, Abscissa::rate),
            "follows the joint rate, 0.115 deg from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(torque, Abscissa::rate),
            "follows the motor rate, 2 mN\u00a0m from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(position, Abscissa::other_residual),
            "follows the motor torque residual, 0.115 deg from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(torque, Abscissa::other_residual),
            "follows the position residual, 2 mN\u00a0m from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(position, Abscissa::stretch),
            "follows the stretch, 0.115 deg from end to end: 75 % of its variance goes with it");
  EXPECT_EQ(phrase(position, Abscissa::load, 0, true),
            "runs through a loop over load, 0.115 deg from end to end: 75 % of its variance goes with load and "
            "direction of motion");
  EXPECT_EQ(phrase(position, Abscissa::time),
            "changes in the course of time by 0.115 deg: 75 % of its variance goes with time");
  EXPECT_EQ(phrase(position, Abscissa::constant),
            "is off by 0.115 deg throughout: 75 % of its mean square is a constant");
  EXPECT_EQ(phrase(torque, Abscissa::motor_angle),
            "repeats with each turn of the motor, ±1 mN\u00a0m: 75 % of its variance goes with the motor angle, its "
            "strongest line has order 3");
  EXPECT_EQ(
      phrase(torque, Abscissa::capstan_angle),
      "repeats with each turn of the capstan, ±1 mN\u00a0m: 75 % of its variance goes with the capstan angle, its "
      "strongest line has order 3");
}

TEST(ViewSentence, ShowsAResidualInTheUnitOfItsJoint) {
  const ArmParameters<double> arm = three_kinds();
  const auto unit = [&](int joint, ResidualKind residual) { return residual_unit(arm, joint, residual).name; };
  EXPECT_EQ(unit(0, ResidualKind::joint_position), "deg");
  EXPECT_EQ(unit(1, ResidualKind::joint_position), "mm");
  EXPECT_EQ(unit(0, ResidualKind::joint_torque), "N\u00a0m");
  EXPECT_EQ(unit(1, ResidualKind::joint_torque), "N");
  EXPECT_EQ(unit(1, ResidualKind::motor_torque), "mN\u00a0m");
  EXPECT_EQ(unit(2, ResidualKind::motor_torque), "N");
  ArmParameters<double> strong = arm;
  strong.joint[0].motor_coulomb = 0.6;
  EXPECT_EQ(residual_unit(strong, 0, ResidualKind::motor_torque).name, "N\u00a0m");
}

TEST(ViewSentence, ShowsAnAbscissaInItsOwnUnit) {
  const ArmParameters<double> arm = three_kinds();
  const auto unit = [&](int joint, ResidualKind residual, Abscissa abscissa) {
    return abscissa_unit(arm, joint, residual, abscissa).name;
  };
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::joint_position), "deg");
  EXPECT_EQ(unit(1, ResidualKind::joint_position, Abscissa::rate), "mm/s");
  EXPECT_EQ(unit(1, ResidualKind::motor_torque, Abscissa::rate), "rad/s");
  EXPECT_EQ(unit(2, ResidualKind::motor_torque, Abscissa::rate), "m/s");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::time), "s");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::direction), "");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::load), "N");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::stretch), "mm");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::capstan_angle), "turn");
  EXPECT_EQ(unit(0, ResidualKind::joint_position, Abscissa::other_residual), "mN\u00a0m");
  EXPECT_EQ(unit(0, ResidualKind::motor_torque, Abscissa::other_residual), "deg");
}

TEST(ViewSentence, NamesForcesOfLinearMotorsAndOfPrismaticJoints) {
  const ArmParameters<double> arm = three_kinds();
  EXPECT_EQ(residual_name(arm, 0, ResidualKind::motor_torque), "motor torque residual");
  EXPECT_EQ(residual_name(arm, 2, ResidualKind::motor_torque), "motor force residual");
  EXPECT_EQ(residual_name(arm, 0, ResidualKind::joint_torque), "joint torque residual");
  EXPECT_EQ(residual_name(arm, 1, ResidualKind::joint_torque), "joint force residual");
  EXPECT_EQ(residual_name(arm, 1, ResidualKind::transmission), "transmission residual");
}

TEST(ViewSentence, RoundsSharesToWhatTheyAreWorth) {
  EXPECT_EQ(shown_share(0.0004), "less than 0.1 %");
  EXPECT_EQ(shown_share(0.004), "0.4 %");
  EXPECT_EQ(shown_share(0.094), "9.4 %");
  EXPECT_EQ(shown_share(0.81), "81 %");
  EXPECT_EQ(shown_share(0.996), "over 99 %");
}

TEST(ViewSentence, ShowsSoManyUnitsForOneOfSI) {
  const ArmParameters<double> arm = three_kinds();
  const auto shown_as = [&](int joint, Abscissa abscissa, ResidualKind residual = ResidualKind::joint_position) {
    return abscissa_unit(arm, joint, residual, abscissa).per_si;
  };
  const double degrees = 180 / std::numbers::pi, turns = 1 / (2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(shown_as(0, Abscissa::joint_position), degrees);
  EXPECT_DOUBLE_EQ(shown_as(0, Abscissa::rate), degrees);
  EXPECT_EQ(shown_as(1, Abscissa::joint_position), 1e3);
  EXPECT_EQ(shown_as(1, Abscissa::rate), 1e3);
  EXPECT_EQ(shown_as(1, Abscissa::rate, ResidualKind::motor_torque), 1);
  EXPECT_DOUBLE_EQ(shown_as(0, Abscissa::motor_angle), turns);
  EXPECT_DOUBLE_EQ(shown_as(0, Abscissa::capstan_angle), turns);
  EXPECT_EQ(shown_as(0, Abscissa::stretch), 1e3);
  EXPECT_EQ(shown_as(0, Abscissa::load), 1);
  EXPECT_EQ(shown_as(0, Abscissa::time), 1);
  EXPECT_EQ(shown_as(0, Abscissa::direction), 1);
  EXPECT_EQ(shown_as(0, Abscissa::other_residual), 1e3) << "N m in mN m";
  EXPECT_EQ(residual_unit(arm, 2, ResidualKind::motor_torque).per_si, 1) << "N";
  EXPECT_EQ(residual_unit(arm, 0, ResidualKind::joint_torque).per_si, 1) << "N m";
}

TEST(ViewSentence, OfASlideWithAGearHasAMotorTorqueAndNoForce) {
  // The cable pulls along the slide's axis: a pulley radius of 1.
  ArmParameters<double> arm = three_kinds();
  arm.joint[1].pulley_radius = 1;
  EXPECT_EQ(residual_name(arm, 1, ResidualKind::motor_torque), "motor torque residual");
  EXPECT_EQ(residual_unit(arm, 1, ResidualKind::motor_torque).name, "mN\u00a0m");
}

TEST(ViewSentence, SharesFromATenthOnAreWholePercents) { EXPECT_EQ(shown_share(0.097), "10 %"); }

}  // namespace
}  // namespace halyard
