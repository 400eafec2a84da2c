#include "transmission/arm_fields.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace halyard {
namespace {

/// Where the list finds the fields of a joint, or of an arm.
template <class Visit>
std::vector<const void*> listed(Visit for_each) {
  std::vector<const void*> all;
  for_each([&](const ArmField&, const auto& value) { all.push_back(&value); });
  return all;
}

TEST(ArmFields, ListEveryMemberOfAJointOnce) {
  const JointParameters<double> joint;
  // A member that is added to JointParameters stops this from compiling: name it here, and give it a line in the list.
  const auto& [type, drive, law, frame_R, frame_p, mass, com, inertia, rotor_inertia, motor_coulomb, motor_viscous,
               motor_smoothing, gear_ratio, capstan_radius, torque_scale, torque_bias, torque_source, pulley_radius,
               coupling, stiffness, damping, tension, joint_coulomb, joint_viscous, joint_smoothing,
               motor_encoder_offset, joint_encoder_offset, motor_encoder_resolution, joint_encoder_resolution,
               motor_encoder_noise, joint_encoder_noise, motor_zero_known, joint_zero_known, command_delay,
               sensor_delay] = joint;
  (void)command_delay, (void)sensor_delay;  // no numbers of a model: effects make them
  const std::multiset<const void*> members = {&type,
                                              &drive,
                                              &law,
                                              &frame_R,
                                              &frame_p,
                                              &mass,
                                              &com,
                                              &inertia,
                                              &rotor_inertia,
                                              &motor_coulomb,
                                              &motor_viscous,
                                              &motor_smoothing,
                                              &gear_ratio,
                                              &capstan_radius,
                                              &torque_scale,
                                              &torque_bias,
                                              &torque_source,
                                              &pulley_radius,
                                              &coupling,
                                              &stiffness,
                                              &damping,
                                              &tension,
                                              &joint_coulomb,
                                              &joint_viscous,
                                              &joint_smoothing,
                                              &motor_encoder_offset,
                                              &joint_encoder_offset,
                                              &motor_encoder_resolution,
                                              &joint_encoder_resolution,
                                              &motor_encoder_noise,
                                              &joint_encoder_noise,
                                              &motor_zero_known,
                                              &joint_zero_known};
  const auto list = listed([&](const auto& visit) { for_each_joint_field(visit, joint); });
  EXPECT_EQ(std::multiset<const void*>(list.begin(), list.end()), members);
}

TEST(ArmFields, ListEveryMemberOfAnArmButItsJointsOnce) {
  const ArmParameters<double> arm;
  const auto& [n, gravity, payload_point, vertical_axis, joint] = arm;
  (void)joint, (void)vertical_axis;  // the axis is no number of a model: a tilt of the base makes it
  const std::multiset<const void*> members = {&n, &gravity, &payload_point};
  const auto list = listed([&](const auto& visit) { for_each_arm_field(visit, arm); });
  EXPECT_EQ(std::multiset<const void*>(list.begin(), list.end()), members);
}

TEST(ArmFields, HaveNamesOfTheirOwn) {
  std::set<std::string> keys;
  int zeros = 0;
  const auto visit = [&](const ArmField& field, const auto& value) {
    // Whether a zero is known is written in the place of the offset.
    zeros += std::is_same_v<decltype(value), const bool&>;
    keys.insert(std::string(field.part).append(".").append(field.name));
  };
  const JointParameters<double> joint;
  int fields = 0;
  for_each_joint_field([&](const ArmField&, const auto&) { ++fields; }, joint);
  for_each_joint_field(visit, joint);
  EXPECT_EQ(zeros, 2);
  EXPECT_EQ(static_cast<int>(keys.size()), fields - zeros);
}

/// An arm with another number in every entry of every field.
ArmParameters<double> numbered_arm(double first) {
  ArmParameters<double> arm;
  double next = first;
  const auto set = [&](auto& entry) {
    if constexpr (std::is_same_v<decltype(entry), double&>) entry = next++;
  };
  for_each_field(
      kMaxJoints, [&](const ArmField&, auto& value) { for_each_entry(set, value); }, arm);
  arm.n = 3;
  for (JointParameters<double>& j : arm.joint) {
    j.type = JointType::prismatic;
    j.drive = Drive::none;
    j.law = CableLaw::linear;
    j.torque_source = TorqueSource::measured;
    j.motor_zero_known = j.joint_zero_known = false;
  }
  return arm;
}

/// Lane or value of an entry, as a number.
double entry_of(const Lanes& x, int lane) { return x[lane]; }
double entry_of(const Dual& x, int) { return x.a; }
template <class Entry>
double entry_of(const Entry& x, int) {
  return static_cast<double>(x);
}

template <class T>
void expect_equal(const ArmParameters<T>& arm, const ArmParameters<double>& expected, int lane = 0) {
  const auto compare = [&](const ArmField& field, const auto& a, const auto& b) {
    const auto each = [&](const auto& x, const auto& y) {
      EXPECT_EQ(entry_of(x, lane), static_cast<double>(y)) << field.part << "." << field.name;
    };
    for_each_entry(each, a, b);
  };
  for_each_field(kMaxJoints, compare, arm, expected);
}

TEST(ArmFields, AreAllLifted) {
  const ArmParameters<double> arm = numbered_arm(1);
  expect_equal(lift<double>(arm), arm);
  expect_equal(lift<Dual>(arm), arm);
  const ArmParameters<Lanes> lanes = lift<Lanes>(arm);
  for (int lane = 0; lane < kLaneWidth; ++lane) expect_equal(lanes, arm, lane);
}

TEST(ArmFields, AreAllPackedLaneByLane) {
  ArmParameters<double> arms[kLaneWidth];
  for (int lane = 0; lane < kLaneWidth; ++lane) {
    arms[lane] = numbered_arm(1000 * lane);
    // Arms of one structure.
    const auto keep_structure = [](const ArmField&, auto& value, const auto& first, const auto& over_lanes) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::remove_cvref_t<decltype(over_lanes)>>)
        for_each_entry([](auto& x, const auto& y) { x = y; }, value, first);
    };
    static const ArmParameters<Lanes> lanes;
    for_each_field(kMaxJoints, keep_structure, arms[lane], arms[0], lanes);
  }
  EXPECT_NE(arms[1].joint[2].coupling[1], arms[0].joint[2].coupling[1]);
  const ArmParameters<Lanes> packed = pack(arms);
  for (int lane = 0; lane < kLaneWidth; ++lane) expect_equal(packed, arms[lane], lane);
}

TEST(ArmFields, OfACableExistAtACableAndThoseOfAMotorAtEachDrive) {
  const auto field = [](FieldOf of) {
    ArmField f{"part", "name", "", "", FieldKind::structure};
    f.of = of;
    return f;
  };
  for (const Drive drive : {Drive::cable, Drive::rigid, Drive::none}) {
    EXPECT_TRUE(field(FieldOf::every_joint).exists_at(drive));
    EXPECT_EQ(field(FieldOf::driven_joint).exists_at(drive), drive != Drive::none);
    EXPECT_EQ(field(FieldOf::cable_joint).exists_at(drive), drive == Drive::cable);
  }
}

TEST(ArmParameters, OfAJointThatSaysNothingChangeNothing) {
  const JointParameters<double> joint;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(joint.frame_R[r][c], r == c ? 1 : 0) << r << c;
    EXPECT_EQ(joint.frame_p[r], 0) << r;
    EXPECT_EQ(joint.com[r], 0) << r;
  }
  EXPECT_EQ(joint.motor_travel(), 1) << "the cable moves as the motor";
  EXPECT_EQ(joint.pulley_radius, 1) << "the joint moves as the cable";
  EXPECT_EQ(joint.torque_scale, 1);
  for (const double added : {joint.torque_bias, joint.motor_encoder_offset, joint.joint_encoder_offset}) {
    EXPECT_EQ(added, 0);
  }
  for (const double lost : {joint.motor_coulomb, joint.motor_viscous, joint.joint_coulomb, joint.joint_viscous}) {
    EXPECT_EQ(lost, 0);
  }
  for (const double coupled : joint.coupling) EXPECT_EQ(coupled, 0);
  for (const double moment : joint.inertia) EXPECT_EQ(moment, 0);
  EXPECT_EQ(joint.motor_encoder_resolution, 0);
  EXPECT_EQ(joint.joint_encoder_resolution, 0);
  EXPECT_TRUE(joint.motor_zero_known && joint.joint_zero_known);
}

TEST(ArmFields, OfACableBelongToTheRigidTransmissionOfARigidDrive) {
  const ArmField of_cable{"cable", "stiffness", "", "N/m", FieldKind::stiffness};
  const ArmField of_motor{"motor", "viscous", "", "N m s/rad", FieldKind::friction};
  EXPECT_EQ(of_cable.part_at(Drive::rigid), "rigid");
  EXPECT_EQ(of_cable.part_at(Drive::cable), "cable");
  EXPECT_EQ(of_cable.part_at(Drive::none), "cable");
  for (const Drive drive : {Drive::cable, Drive::rigid, Drive::none}) EXPECT_EQ(of_motor.part_at(drive), "motor");
}

TEST(ArmParameters, OfAnArmThatSaysNothingAreNoBodyAndNoCableUnderTheEarthsGravity) {
  const ArmParameters<double> arm;
  EXPECT_EQ(arm.n, 0);
  EXPECT_EQ(arm.gravity[0], -9.81);
  EXPECT_EQ(arm.gravity[1], 0);
  EXPECT_EQ(arm.gravity[2], 0);
  for (const double coordinate : arm.payload_point) EXPECT_EQ(coordinate, 0);
  const JointParameters<double>& joint = arm.joint[0];
  for (const double nothing : {joint.mass, joint.rotor_inertia, joint.stiffness, joint.damping, joint.tension}) {
    EXPECT_EQ(nothing, 0);
  }
  EXPECT_EQ(joint.motor_smoothing, 0.5);
  EXPECT_EQ(joint.joint_smoothing, 5e-3);
}

}  // namespace
}  // namespace halyard
