#pragma once
/// Rates of a plain drive train (drive_model.h). The laws of cables and friction are evaluated at all joints at once:
///
///   x = (r_m / N) q_m - R q,  g = cable law(x, x')        F = Rᵀ g - friction(v) + external
///   J ω' = τ_c - friction(ω) - (r_m / N) g                E_in' = Σ τ_c ω + external v
///   E_lost' = Σ friction(ω) ω + friction(v) v + (g(x, x') - g(x, 0)) x'
///
/// The slopes follow from each law's own: of g in x and x', of friction in its speed. The rest is linear.

#include "plant/lanes/drive_model.h"
#include "transmission/drive.h"

namespace halyard {

/// One number of each joint, in lanes; lanes beyond the last joint are 0.
template <int known>
HALYARD_INLINE Lanes in_lanes(int n, const double* x) {
  Lanes lanes(0.0);
  for (int k = 0; k < (known > 0 ? known : n); ++k) lanes.set(k, x[k]);
  return lanes;
}

/// Motor and joint motion of a plain drive train: [n], in rad and m.
struct PlainMotion {
  double angle[kMaxJoints], rate[kMaxJoints];            ///< of the motors
  double stretch[kMaxJoints], stretch_rate[kMaxJoints];  ///< x, x' of the cables
};

template <int known>
HALYARD_INLINE PlainMotion plain_motion(const DriveModel& drive, const PlantInstant& at) {
  const ArmParameters<double>& arm = drive.transmission.arm();
  PlainMotion m;
  double path[kMaxJoints], path_rate[kMaxJoints];
  cable_path<known>(arm, at.q, path);
  cable_path<known>(arm, at.v, path_rate);
  for (int k = 0; k < joint_count<known>(arm); ++k) {
    m.angle[k] = at.z[*drive.layout.motor_angle[k]];
    m.rate[k] = at.z[*drive.layout.motor_rate[k]];
    const double travel = drive.plain->travel.v[k];
    m.stretch[k] = travel * m.angle[k] - path[k];
    m.stretch_rate[k] = travel * m.rate[k] - path_rate[k];
  }
  return m;
}

template <int known>
HALYARD_INLINE void plain_rates(const DriveModel& drive, const PlantInstant& at, double* joint_force, double* z_dot) {
  const ArmParameters<double>& arm = drive.transmission.arm();
  const JointParameters<Lanes>& j = drive.plain->joint;
  const PlantLayout& l = drive.layout;
  const int n = joint_count<known>(arm);
  const PlainMotion m = plain_motion<known>(drive, at);
  const Lanes rate = in_lanes<known>(n, m.rate), speed = in_lanes<known>(n, at.v),
              external = in_lanes<known>(n, drive.external), stretch = in_lanes<known>(n, m.stretch),
              stretch_rate = in_lanes<known>(n, m.stretch_rate);
  const Lanes g = cable_force(j, stretch, stretch_rate);
  const Lanes at_motor = friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, rate);
  const Lanes at_joint = friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, speed);
  const Lanes shaft = j.torque_scale * in_lanes<known>(n, drive.command) + j.torque_bias;
  const Lanes acceleration = (shaft - at_motor - drive.plain->travel * g) / j.rotor_inertia;
  const Lanes input = shaft * rate + external * speed;
  const Lanes lost = at_motor * rate + at_joint * speed + (g - cable_force(j, stretch, Lanes(0.0))) * stretch_rate;

  double pull[kMaxJoints];
  for (int k = 0; k < n; ++k) pull[k] = g[k];
  joint_reaction<known>(arm, pull, joint_force);
  z_dot[l.input_energy] = z_dot[l.lost_energy] = 0;
  for (int k = 0; k < n; ++k) {
    joint_force[k] += external[k] - at_joint[k];
    z_dot[*l.motor_angle[k]] = m.rate[k];
    z_dot[*l.motor_rate[k]] = acceleration[k];
    z_dot[l.input_energy] += input[k];
    z_dot[l.lost_energy] += lost[k];
  }
}

/// One joint's laws and their slopes.
struct JointLaws {
  double pull, pull_slope[2];  ///< g; its slopes in x, x'
  double at_motor_slope, at_joint_slope;
  double lost_slope[4];  ///< of E_lost' in x, x', ω, v
};

HALYARD_INLINE JointLaws joint_laws(const JointParameters<Dual>& j, double stretch, double stretch_rate, double rate,
                                    double speed) {
  const Dual x = Dual::seed(stretch, 0), x_dot = Dual::seed(stretch_rate, 1), w = Dual::seed(rate, 2),
             v = Dual::seed(speed, 3);
  const Dual g = cable_force(j, x, x_dot);
  const Dual at_motor = friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, w);
  const Dual at_joint = friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, v);
  const Dual lost = at_motor * w + at_joint * v + (g - cable_force(j, x, Dual(0.0))) * x_dot;
  return {g.a, {g.d[0], g.d[1]}, at_motor.d[2], at_joint.d[3], {lost.d[0], lost.d[1], lost.d[2], lost.d[3]}};
}

/// plain_rates() with its slopes.
template <int known>
HALYARD_INLINE void plain_slopes(const DriveModel& drive, const PlantInstant& at, double* joint_force, double* z_dot,
                                 double* slopes, int stride) {
  plain_rates<known>(drive, at, joint_force, z_dot);
  const ArmParameters<double>& arm = drive.transmission.arm();
  const PlantLayout& l = drive.layout;
  const int n = joint_count<known>(arm), input = n + l.input_energy, lost = n + l.lost_energy;
  const PlainMotion m = plain_motion<known>(drive, at);
  for (int c = 0; c < 2 * n + l.input_energy; ++c)
    for (int r = 0; r < n + l.n_z; ++r) slopes[r + c * stride] = 0;
  double* const in_q = slopes;
  double* const in_v = slopes + n * stride;
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const JointLaws law = joint_laws(drive.dual.arm().joint[k], m.stretch[k], m.stretch_rate[k], m.rate[k], at.v[k]);
    const int angle_row = n + *l.motor_angle[k], rate_row = n + *l.motor_rate[k];
    double* const in_angle = slopes + (2 * n + *l.motor_angle[k]) * stride;
    double* const in_rate = slopes + (2 * n + *l.motor_rate[k]) * stride;
    const double travel = drive.plain->travel.v[k], per_inertia = 1 / j.rotor_inertia, pull = travel * per_inertia;
    in_rate[angle_row] = 1;
    in_angle[rate_row] = -pull * travel * law.pull_slope[0];
    in_rate[rate_row] = -pull * travel * law.pull_slope[1] - per_inertia * law.at_motor_slope;
    in_rate[input] = j.torque_scale * drive.command[k] + j.torque_bias;
    in_v[k * stride + input] = drive.external[k];
    in_angle[lost] = travel * law.lost_slope[0];
    in_rate[lost] = travel * law.lost_slope[1] + law.lost_slope[2];
    in_v[k * stride + lost] += law.lost_slope[3];
    in_v[k * stride + k] -= law.at_joint_slope;
    for (int i = 0; i < n; ++i) {
      const double path = path_per_joint(j, i), stiff = path * law.pull_slope[0], damped = path * law.pull_slope[1];
      in_angle[i] = travel * stiff;
      in_rate[i] = travel * damped;
      in_q[i * stride + rate_row] = pull * stiff;
      in_v[i * stride + rate_row] = pull * damped;
      in_q[i * stride + lost] -= path * law.lost_slope[0];
      in_v[i * stride + lost] -= path * law.lost_slope[1];
      for (int c = 0; c < n; ++c) {
        in_q[c * stride + i] -= path_per_joint(j, c) * stiff;
        in_v[c * stride + i] -= path_per_joint(j, c) * damped;
      }
    }
  }
}

}  // namespace halyard
