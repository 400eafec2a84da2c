#include "diagnosis/explanation/view_sentence.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace halyard {
namespace {

/// A radius of a linear motor is 1 in the model as given, and may be refitted. No rotating motor has a capstan of a
/// metre.
bool is_about_one(double radius) { return std::abs(radius - 1) < 0.5; }

/// True if the motor's "angle" and "torque" are the joint's position and force.
bool is_linear_motor(const JointParameters<double>& j) {
  return j.type == JointType::prismatic && is_about_one(j.motor_travel()) && is_about_one(j.pulley_radius);
}

ShownUnit position_unit(const JointParameters<double>& j) {
  return j.type == JointType::revolute ? ShownUnit{"deg", 180 / std::numbers::pi} : ShownUnit{"mm", 1e3};
}

}  // namespace

ShownUnit residual_unit(const ArmParameters<double>& arm, int joint, ResidualKind residual) {
  const JointParameters<double>& j = arm.joint[joint];
  switch (residual) {
    case ResidualKind::joint_position:
    case ResidualKind::transmission: return position_unit(j);
    case ResidualKind::motor_torque:
      if (is_linear_motor(j)) return {"N", 1};
      // By the motor's own friction: a large one or a small one.
      return j.motor_coulomb > 0.5 ? ShownUnit{"N\u00a0m", 1} : ShownUnit{"mN\u00a0m", 1e3};
    case ResidualKind::joint_torque: break;
  }
  return {j.type == JointType::revolute ? "N\u00a0m" : "N", 1};
}

ShownUnit abscissa_unit(const ArmParameters<double>& arm, int joint, ResidualKind residual, Abscissa abscissa) {
  const JointParameters<double>& j = arm.joint[joint];
  const ShownUnit position = position_unit(j);
  const bool linear = is_linear_motor(j);
  switch (abscissa) {
    case Abscissa::constant:
    case Abscissa::time: return {"s", 1};
    case Abscissa::direction: return {"", 1};
    case Abscissa::joint_position: return position;
    case Abscissa::rate:
      if (residual == ResidualKind::motor_torque) return {linear ? "m/s" : "rad/s", 1};
      return {position.name + "/s", position.per_si};
    case Abscissa::load: return {"N", 1};
    case Abscissa::stretch: return {"mm", 1e3};
    case Abscissa::motor_angle:
    case Abscissa::capstan_angle: return {"turn", 0.5 / std::numbers::pi};
    case Abscissa::other_residual: break;
  }
  return residual_unit(
      arm, joint, residual == ResidualKind::motor_torque ? ResidualKind::joint_position : ResidualKind::motor_torque);
}

std::string residual_name(const ArmParameters<double>& arm, int joint, ResidualKind residual) {
  switch (residual) {
    case ResidualKind::joint_position: return "position residual";
    case ResidualKind::transmission: return "transmission residual";
    case ResidualKind::motor_torque:
      return is_linear_motor(arm.joint[joint]) ? "motor force residual" : "motor torque residual";
    case ResidualKind::joint_torque: break;
  }
  return arm.joint[joint].type == JointType::revolute ? "joint torque residual" : "joint force residual";
}

std::string abscissa_name(ResidualKind residual, Abscissa abscissa) {
  const bool motor = residual == ResidualKind::motor_torque;
  switch (abscissa) {
    case Abscissa::constant:
    case Abscissa::time: return "time";
    case Abscissa::direction: return "direction of motion";
    case Abscissa::joint_position: return "joint position";
    case Abscissa::rate: return motor ? "motor rate" : "joint rate";
    case Abscissa::load: return "load";
    case Abscissa::stretch: return "stretch";
    case Abscissa::motor_angle: return "motor angle";
    case Abscissa::capstan_angle: return "capstan angle";
    case Abscissa::other_residual: break;
  }
  return motor ? "position residual" : "motor torque residual";
}

std::string shown(double value, const ShownUnit& unit) {
  return fmt::format("{:.3g}{}{}", value * unit.per_si, unit.name.empty() ? "" : " ", unit.name);
}

std::string shown_share(double share) {
  if (share < 1e-3) return "less than 0.1 %";
  if (share > 0.995) return "over 99 %";
  return share < 0.095 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

std::string view_phrase(const View& v, const ArmParameters<double>& arm, int joint) {
  const ShownUnit unit = residual_unit(arm, joint, v.residual);
  const std::string swing = shown(v.swing, unit), half = shown(0.5 * v.swing, unit);
  const std::string share = shown_share(v.explained_before), name = abscissa_name(v.residual, v.abscissa);
  if (v.loop)
    return fmt::format(
        "runs through a loop over {}, {} from end to end: {} of its variance goes with {} and direction of motion",
        name, swing, share, name);
  switch (v.abscissa) {
    case Abscissa::constant:
      return fmt::format("is off by {} throughout: {} of its mean square is a constant", swing, share);
    case Abscissa::direction:
      return fmt::format("steps by ±{} at each reversal: {} of its variance goes with the direction of motion", half,
                         share);
    case Abscissa::motor_angle:
    case Abscissa::capstan_angle:
      return fmt::format(
          "repeats with each turn of the {}, ±{}: {} of its variance goes with the {}, its strongest line has order "
          "{:.2g}",
          v.abscissa == Abscissa::motor_angle ? "motor" : "capstan", half, share, name, v.line.frequency);
    case Abscissa::time:
      return fmt::format("changes in the course of time by {}: {} of its variance goes with time", swing, share);
    default:
      return fmt::format("follows the {}, {} from end to end: {} of its variance goes with it", name, swing, share);
  }
}

}  // namespace halyard
