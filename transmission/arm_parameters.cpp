#include "transmission/arm_parameters.h"

#include "transmission/cable_law.h"

namespace halyard {

namespace {

/// What is no number of an equation: kinds, fixed frames, resolutions.
template <class T>
void copy_structure(const ArmParameters<double>& from, ArmParameters<T>& to) {
  to.n = from.n;
  for (int i = 0; i < 3; ++i) to.payload_point[i] = from.payload_point[i];
  for (int k = 0; k < kMaxJoints; ++k) {
    const JointParameters<double>& a = from.joint[k];
    JointParameters<T>& b = to.joint[k];
    b.type = a.type;
    b.drive = a.drive;
    b.law = a.law;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) b.frame_R[i][j] = a.frame_R[i][j];
      b.frame_p[i] = a.frame_p[i];
    }
    b.motor_encoder_resolution = a.motor_encoder_resolution;
    b.joint_encoder_resolution = a.joint_encoder_resolution;
    b.motor_zero_known = a.motor_zero_known;
    b.joint_zero_known = a.joint_zero_known;
  }
}

/// Calls set(to's number, from's number) for each number of the equations.
template <class To, class Set>
void each_number(const ArmParameters<double>& from, To& to, Set set) {
  for (int i = 0; i < 3; ++i) set(to.gravity[i], from.gravity[i]);
  for (int k = 0; k < kMaxJoints; ++k) {
    const JointParameters<double>& a = from.joint[k];
    auto& b = to.joint[k];
    set(b.mass, a.mass);
    for (int i = 0; i < 3; ++i) set(b.com[i], a.com[i]);
    for (int i = 0; i < 6; ++i) set(b.inertia[i], a.inertia[i]);
    set(b.rotor_inertia, a.rotor_inertia);
    set(b.motor_coulomb, a.motor_coulomb);
    set(b.motor_viscous, a.motor_viscous);
    set(b.motor_smoothing, a.motor_smoothing);
    set(b.gear_ratio, a.gear_ratio);
    set(b.capstan_radius, a.capstan_radius);
    set(b.torque_scale, a.torque_scale);
    set(b.torque_bias, a.torque_bias);
    set(b.pulley_radius, a.pulley_radius);
    for (int i = 0; i < kMaxJoints; ++i) set(b.coupling[i], a.coupling[i]);
    set(b.stiffness, a.stiffness);
    set(b.damping, a.damping);
    set(b.tension, a.tension);
    set(b.joint_coulomb, a.joint_coulomb);
    set(b.joint_viscous, a.joint_viscous);
    set(b.joint_smoothing, a.joint_smoothing);
    set(b.motor_encoder_offset, a.motor_encoder_offset);
    set(b.joint_encoder_offset, a.joint_encoder_offset);
  }
}

}  // namespace

template <class T>
ArmParameters<T> lift(const ArmParameters<double>& from) {
  ArmParameters<T> to;
  copy_structure(from, to);
  each_number(from, to, [](T& b, double a) { b = a; });
  return to;
}

template ArmParameters<double> lift(const ArmParameters<double>&);
template ArmParameters<Dual> lift(const ArmParameters<double>&);
template ArmParameters<Lanes> lift(const ArmParameters<double>&);

ArmParameters<Lanes> pack(const ArmParameters<double>* arms) {
  ArmParameters<Lanes> to;
  copy_structure(arms[0], to);
  for (int lane = 0; lane < kLaneWidth; ++lane)
    each_number(arms[lane], to, [lane](Lanes& b, double a) { b.set(lane, a); });
  return to;
}

double cable_energy(const JointParameters<double>& j, double x) {
  switch (j.law) {
    case CableLaw::paper: return 2 * j.stiffness * (std::cosh(x) - 1);
    case CableLaw::exponential: {
      const double a = j.stiffness / j.tension;
      return 2 * j.tension / a * (std::cosh(a * x) - 1);
    }
    case CableLaw::linear: {
      // Beyond |x| = T_0 / k_e one run is slack: twice the slope before, once after.
      const double slack = j.tension / j.stiffness, u = std::abs(x);
      if (u <= slack) return j.stiffness * u * u;
      const double beyond = u - slack;
      return j.stiffness * slack * slack + 2 * j.tension * beyond + 0.5 * j.stiffness * beyond * beyond;
    }
  }
  return 0;
}

}  // namespace halyard
