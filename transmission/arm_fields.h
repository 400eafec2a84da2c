#pragma once
/// The list of an arm's parameters: each field of ArmParameters and JointParameters appears once, with its description.
/// Code that treats all fields alike iterates over this list. Examples are the reader and writer of model files, the
/// conversion to other scalar types, parameter studies, and the keys of predictions. A new field needs one line here.
///
///   for_each_field(arm.n, [](const ArmField& field, const auto& value) { ... }, arm);
///
/// If several arms are given, visit gets the same field of each, for example to compare or to copy arms. In a model
/// file, ArmField::part is the name of an element, and ArmField::name is the name of an attribute of that element. Keys
/// combine the two: joint2.motor.viscous.

#include <cstddef>
#include <string_view>
#include <type_traits>

#include "transmission/arm_parameters.h"

namespace halyard {

/// Kind of a field. Numbers of one kind are known with similar accuracy.
enum class FieldKind {
  structure,  ///< not a measured number: a type, a frame
  length,     ///< radii, ratios, lengths
  mass,       ///< masses, and inertias of rotors
  com,        ///< centres of mass
  inertia,    ///< moments and products of inertia of links
  stiffness,  ///< stiffness, damping and tension of cables
  friction,   ///< Coulomb and viscous
  smoothing,  ///< speed scale over which the sign of friction is smoothed: v_s of friction.h
  coupling,
  torque_scale,
  torque_bias,
  gravity,
  sensor,  ///< offsets, resolutions and noise of encoders
};

/// The values that a field may have.
enum class Bound { none, not_negative, positive };

/// The joints that have a field.
enum class FieldOf { every_joint, driven_joint, cable_joint };

/// What a field changes in an arm, if the motion of its motors is given.
enum class Influence {
  motion,          ///< the motion of the joints and everything that depends on it
  motor_torque,    ///< only the torque that the motors need
  sensor_reading,  ///< only the readings of the sensors
};

/// Unit of a field at a revolute and at a prismatic joint; "1" if dimensionless, "" if the field is not a number.
struct FieldUnit {
  constexpr FieldUnit(const char* of_both) : revolute(of_both), prismatic(of_both) {}  // NOLINT: most have one unit
  constexpr FieldUnit(const char* of_revolute, const char* of_prismatic)
      : revolute(of_revolute), prismatic(of_prismatic) {}
  constexpr const char* of(JointType type) const { return type == JointType::revolute ? revolute : prismatic; }

  const char *revolute, *prismatic;
};

/// Unit of the coupling coefficient that says how far joint `moving` moves the cable of `joint`. The cable's motion is
/// expressed as motion of `joint`, rad | m.
constexpr const char* coupling_unit(JointType joint, JointType moving) {
  if (joint == moving) return "1";
  return joint == JointType::prismatic ? "m/rad" : "rad/m";
}

struct ArmField {
  std::string_view part;  ///< part of the joint or of the arm: "motor"; "": the joint or the arm itself
  std::string_view name;  ///< name within the part: "viscous"
  std::string_view noun;  ///< name in words: "viscous friction"; "": studies do not vary the field
  FieldUnit unit;
  FieldKind kind;
  Bound bound = Bound::none;
  bool has_default = false;  ///< a model file may omit it; its initial value then applies
  FieldOf of = FieldOf::every_joint;
  Influence influence = Influence::motion;

  constexpr bool exists_at(Drive drive) const {
    return of == FieldOf::every_joint || (of == FieldOf::driven_joint ? drive != Drive::none : drive == Drive::cable);
  }
  /// Name of the part at a joint. At a rigid drive the fields of part "cable" belong to part "rigid".
  constexpr std::string_view part_at(Drive drive) const {
    return part == "cable" && drive == Drive::rigid ? "rigid" : part;
  }
};

/// Those of the part "encoders", as in for_each_joint_field.
template <class Visit, class... Joint>
void for_each_encoder_field(Visit&& visit, Joint&... j) {
  using enum FieldOf;
  using enum Influence;
  constexpr auto none = Bound::none, not_negative = Bound::not_negative;
  const auto encoder = [&](std::string_view name, FieldUnit unit, Bound bound, FieldOf of, Influence influence,
                           auto&... value) {
    visit(ArmField{"encoders", name, "", unit, FieldKind::sensor, bound, true, of, influence}, value...);
  };
  const FieldUnit position{"rad", "m"};
  encoder("motor_resolution", "rad", not_negative, driven_joint, sensor_reading, j.motor_encoder_resolution...);
  encoder("motor_noise", "rad", not_negative, driven_joint, sensor_reading, j.motor_encoder_noise...);
  encoder("motor_offset", "", none, driven_joint, sensor_reading, j.motor_zero_known...);
  // The motor's motion is its encoder's reading minus this offset.
  encoder("motor_offset", "rad", none, driven_joint, motion, j.motor_encoder_offset...);
  encoder("joint_resolution", position, not_negative, every_joint, sensor_reading, j.joint_encoder_resolution...);
  encoder("joint_noise", position, not_negative, every_joint, sensor_reading, j.joint_encoder_noise...);
  encoder("joint_offset", "", none, every_joint, sensor_reading, j.joint_zero_known...);
  encoder("joint_offset", position, none, every_joint, sensor_reading, j.joint_encoder_offset...);
}

/// Calls visit(field, j.member...) for each field of a joint. The joints may have different scalar types.
template <class Visit, class... Joint>
void for_each_joint_field(Visit&& visit, Joint&... j) {
  using F = ArmField;
  using enum FieldKind;
  using enum FieldOf;
  using enum Influence;
  constexpr auto none = Bound::none, not_negative = Bound::not_negative, positive = Bound::positive;

  visit(F{"", "type", "", "", structure}, j.type...);
  visit(F{"", "drive", "", "", structure}, j.drive...);

  visit(F{"frame", "xyz", "", "m", structure}, j.frame_p...);
  visit(F{"frame", "matrix", "", "1", structure}, j.frame_R...);

  visit(F{"link", "mass", "mass", "kg", mass, not_negative}, j.mass...);
  visit(F{"link", "com", "centre of mass", "m", com}, j.com...);
  visit(F{"link", "inertia", "inertia", "kg m^2", inertia}, j.inertia...);

  const auto motor = [&](std::string_view name, std::string_view noun, FieldUnit unit, FieldKind kind, Bound bound,
                         bool has_default, Influence influence, auto&... value) {
    visit(F{"motor", name, noun, unit, kind, bound, has_default, driven_joint, influence}, value...);
  };
  motor("inertia", "inertia", "kg m^2", mass, not_negative, false, motor_torque, j.rotor_inertia...);
  motor("coulomb", "Coulomb friction", "N m", friction, not_negative, false, motor_torque, j.motor_coulomb...);
  motor("viscous", "viscous friction", "N m s/rad", friction, not_negative, false, motor_torque, j.motor_viscous...);
  // The smoothing speed also regularises the friction of cables, on which the motion depends.
  motor("smoothing", "smoothing speed", "rad/s", smoothing, positive, true, motion, j.motor_smoothing...);
  motor("gear_ratio", "gear ratio", "1", length, positive, false, motion, j.gear_ratio...);
  motor("capstan_radius", "capstan radius", "m", length, positive, false, motion, j.capstan_radius...);
  motor("torque_scale", "torque scale", "1", torque_scale, positive, true, motor_torque, j.torque_scale...);
  motor("torque_bias", "torque bias", "N m", torque_bias, none, true, motor_torque, j.torque_bias...);
  visit(F{"motor", "torque", "", "", structure, none, true, driven_joint}, j.torque_source...);

  visit(F{"cable", "law", "", "", structure, none, false, cable_joint}, j.law...);
  visit(F{"cable", "stiffness", "stiffness", "N/m", stiffness, positive, false, cable_joint}, j.stiffness...);
  visit(F{"cable", "damping", "damping", "N s/m", stiffness, not_negative, false, cable_joint}, j.damping...);
  visit(F{"cable", "tension", "tension", "N", stiffness, not_negative, false, cable_joint}, j.tension...);
  visit(F{"cable", "pulley_radius", "pulley radius", {"m", "1"}, length, positive, false, driven_joint},
        j.pulley_radius...);

  // The unit depends on both joints: see coupling_unit().
  visit(F{"coupling", "coefficient", "coupling", "", coupling, none, true, driven_joint}, j.coupling...);

  visit(F{"friction", "coulomb", "Coulomb friction", {"N m", "N"}, friction, not_negative}, j.joint_coulomb...);
  visit(F{"friction", "viscous", "viscous friction", {"N m s/rad", "N s/m"}, friction, not_negative},
        j.joint_viscous...);
  visit(F{"friction", "smoothing", "smoothing speed", {"rad/s", "m/s"}, smoothing, positive, true},
        j.joint_smoothing...);

  for_each_encoder_field(visit, j...);
}

/// Calls visit(field, a.member...) for each field of the arm itself, not of its joints.
template <class Visit, class... Arm>
void for_each_arm_field(Visit&& visit, Arm&... a) {
  visit(ArmField{"", "joints", "", "", FieldKind::structure}, a.n...);
  visit(ArmField{"gravity", "", "", "m/s^2", FieldKind::gravity}, a.gravity...);
  visit(ArmField{"payload", "point", "", "m", FieldKind::length, Bound::none, true}, a.payload_point...);
}

/// Calls visit for the fields of an arm and of its first `n` joints.
template <class Visit, class... Arm>
void for_each_field(int n, Visit&& visit, Arm&... a) {
  for_each_arm_field(visit, a...);
  for (int k = 0; k < n; ++k) for_each_joint_field(visit, a.joint[k]...);
}

/// Calls visit(x...) for each entry of an array, row by row. Any other value counts as one entry.
template <class Visit, class Value, class... Other>
void for_each_entry(Visit&& visit, Value& value, Other&... other) {
  if constexpr (std::is_array_v<Value>) {
    for (std::size_t i = 0; i < std::extent_v<Value>; ++i) for_each_entry(visit, value[i], other[i]...);
  } else {
    visit(value, other...);
  }
}

}  // namespace halyard
