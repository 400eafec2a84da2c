#include "bench/diagnosis/draw/arms.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace halyard::blind {
namespace {

constexpr double kGravity = 9.81;  // m/s²

/// What a joint carries: torque | force by gravity at full stretch, and inertia | mass.
struct Load {
  double force = 0, inertia = 0;
};

/// A slender link along its own x axis, or a carriage.
void draw_link(JointParameters<double>& j, double length, double mass, Random& random) {
  j.mass = mass;
  j.com[0] = length * random.uniform(0.3, 0.6);
  j.com[1] = length * random.uniform(-0.15, 0.15);
  j.com[2] = length * random.uniform(-0.15, 0.15);
  const double along = mass * length * length / 12, across = along * random.uniform(0.05, 0.2);
  // Two principal moments equal and the third below their sum: moments of a body.
  j.inertia[0] = across;
  j.inertia[1] = j.inertia[2] = along;
}

/// The frame at the end of the link before, turned by an angle that leaves the two axes far from parallel, or not.
void place_frame(JointParameters<double>& j, double length_before, Random& random) {
  const std::vector<double> angles = {0, 60, 75, 90, -60, -90};
  const double twist = random.one_of(angles) * std::numbers::pi / 180;
  const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(twist, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) j.frame_R[r][c] = R(r, c);
  j.frame_p[0] = length_before;
}

/// Of the links from joint k on, stretched out.
Load load_of(const ArmParameters<double>& arm, const std::vector<double>& length, int k) {
  const bool turns = arm.joint[k].type == JointType::revolute;
  double reach = 0;
  Load load;
  for (int i = k; i < arm.n; ++i) {
    const JointParameters<double>& link = arm.joint[i];
    const double lever = turns ? reach + link.com[0] : 1;
    load.force += link.mass * kGravity * lever;
    load.inertia += link.mass * lever * lever + (turns ? link.inertia[2] : 0);
    reach += length[i];
  }
  return load;
}

/// Motor, gear, friction and encoders for a load.
void size_drive(JointParameters<double>& j, const Load& load, bool geared, Random& random) {
  const bool turns = j.type == JointType::revolute;
  if (geared) {
    j.capstan_radius = j.pulley_radius = 1;
    j.gear_ratio = std::round(random.uniform(50, 150));
  } else {
    j.capstan_radius = random.uniform(4e-3, 8e-3);
    j.pulley_radius = turns ? random.uniform(0.03, 0.07) : 1;
    const double ratio = random.log_uniform(60, 150) * (turns ? 1 : 20);  // of a prismatic joint: 1/m
    j.gear_ratio = ratio * j.capstan_radius / j.pulley_radius;
  }
  const double ratio = j.pulley_radius / j.motor_travel();  // motor turns per joint turn, or rad/m
  j.rotor_inertia = random.uniform(0.3, 1) * load.inertia / (ratio * ratio);
  j.motor_coulomb = random.uniform(0.05, 0.2) * load.force / ratio;
  j.motor_viscous = j.motor_coulomb / random.log_uniform(200, 1000);
  j.motor_smoothing = 0.5;
  j.joint_coulomb = random.uniform(0.05, 0.15) * load.force;
  j.joint_viscous = 0.1 * j.joint_coulomb * (turns ? 1 : 10);
  j.joint_smoothing = turns ? 5e-3 : 5e-4;
  j.motor_encoder_resolution = 2 * std::numbers::pi / 4000;
  j.joint_encoder_resolution = turns ? 2 * std::numbers::pi / 80000 : 5e-6;
}

/// Stiffness at the joint, N m/rad | N/m.
double size_cable(JointParameters<double>& j, const Load& load, bool geared, Random& random) {
  const double w = 2 * std::numbers::pi * (geared ? random.log_uniform(15, 40) : random.log_uniform(7, 20));
  const double stiffness = load.inertia * w * w, r2 = j.pulley_radius * j.pulley_radius;
  j.stiffness = stiffness / (2 * r2);
  j.damping = 2 * random.uniform(0.03, 0.15) * load.inertia * w / (2 * r2);
  j.tension = random.uniform(0.6, 1.2) * load.force / j.pulley_radius;
  return stiffness;
}

/// As stiff against the motor as `stiffness` tells; the recording's controllers are 2.5 times this.
void size_controller(JointDescription& d, const JointParameters<double>& j, const Load& load, double stiffness) {
  const double ratio = j.pulley_radius / j.motor_travel();
  const double inertia = j.rotor_inertia + load.inertia / (ratio * ratio);
  d.controller.kp = 0.3 * stiffness / (ratio * ratio);
  d.controller.kd = 0.5 * std::sqrt(d.controller.kp * inertia);
  d.controller.torque_limit = 5 * load.force / ratio;
}

void draw_joint(ArmModel& model, int k, const std::vector<double>& length, bool geared, bool rigid, Random& random) {
  JointParameters<double>& j = model.nominal.joint[k];
  JointDescription& d = model.joints[k];
  j.drive = rigid ? Drive::rigid : Drive::cable;
  const Load load = load_of(model.nominal, length, k);
  size_drive(j, load, geared, random);
  double stiffness = load.inertia * std::pow(2 * std::numbers::pi * 10, 2);
  if (!rigid) stiffness = size_cable(j, load, geared, random);
  size_controller(d, j, load, stiffness);
  for (double& c : j.coupling) c = 0;
  j.coupling[k] = 1;
  if (!geared && k > 0) {
    const bool from_turn = model.nominal.joint[k - 1].type == JointType::revolute;
    const bool to_turn = j.type == JointType::revolute;
    if (from_turn) j.coupling[k - 1] = random.uniform(0.05, 0.2) * (to_turn ? 1 : 0.05);
  }
  d.name = "joint " + std::to_string(k + 1);
  const double half = j.type == JointType::revolute ? random.uniform(0.6, 1.2) : random.uniform(0.08, 0.15);
  d.lower = -half;
  d.upper = half;
}

ArmModel random_arm(bool geared, Random& random) {
  ArmModel model;
  const int n = 1 + random.below(geared ? 6 : 7);
  const bool rigid = geared && random.chance(0.5);
  model.name = std::string(rigid ? "rigid gears" : geared ? "elastic gears" : "cables");
  model.source = model.name;
  model.nominal.n = n;
  model.joints.resize(n);
  std::vector<double> length;
  const double mass = random.uniform(0.3, 0.9);
  for (int k = 0; k < n; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j.type = !geared && random.chance(0.2) ? JointType::prismatic : JointType::revolute;
    length.push_back(random.uniform(0.1, 0.25));
    draw_link(j, length[k], mass * std::pow(0.5, k), random);
    place_frame(j, k > 0 ? length[k - 1] : 0, random);
  }
  model.nominal.payload_point[0] = length.back();
  for (int k = 0; k < n; ++k) draw_joint(model, k, length, geared, rigid, random);
  return model;
}

}  // namespace

ArmModel draw_arm(Arms arms, const ArmModel& raven2, Random& random) {
  if (arms == Arms::mixed) arms = random.one_of<Arms>({Arms::raven2, Arms::raven2, Arms::random, Arms::geared});
  return arms == Arms::raven2 ? raven2 : random_arm(arms == Arms::geared, random);
}

}  // namespace halyard::blind
