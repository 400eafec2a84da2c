#pragma once
/// Rates of a drive train with any drives and effects, over a scalar T.

#include "plant/lanes/drive_model.h"
#include "transmission/drive.h"

namespace halyard {

template <class T>
struct DriveState {
  double time;
  const T *q, *v, *z;
};

template <class T>
HALYARD_INLINE const Transmission<T>& transmission_of(const DriveModel& drive) {
  if constexpr (std::is_same_v<T, double>) return drive.transmission;
  else return drive.dual;
}

/// Sets all signals but the sensor errors; shaft_torque: after the command stage, friction not yet taken off.
template <int known, class T>
HALYARD_INLINE void evaluate_drive(const DriveModel& drive, const DriveState<T>& at, JointSignals<T>* s,
                                   T* shaft_torque, T* effect_rate) {
  const Transmission<T>& transmission = transmission_of<T>(drive);
  const ArmParameters<T>& arm = transmission.arm();
  const PlantLayout& l = drive.layout;
  const int n = joint_count<known>(arm);
  for (int k = 0; k < n; ++k) {
    s[k].command = drive.command[k];
    s[k].external_force = drive.external[k];
    if (arm.joint[k].drive != Drive::cable) continue;
    s[k].motor_angle = at.z[*l.motor_angle[k]];
    s[k].motor_rate = at.z[*l.motor_rate[k]];
  }
  set_motion<known>(arm, at.q, at.v, s);
  const T* effect_states = at.z + l.effect_states;
  transmission.template commanded_torque<known>(at.time, &drive.history, effect_states, s);
  for (int k = 0; k < n; ++k) shaft_torque[k] = arm.joint[k].drive == Drive::none ? T(0.0) : s[k].motor_torque;
  transmission.template evaluate<known>(at.time, &drive.history, effect_states, s, effect_rate);
}

/// The rates of the two meters. stretch_rate: of the elastic stretch, with the states of the effects in motion.
template <int known, class T>
HALYARD_INLINE void meter(const ArmParameters<T>& arm, const T* v, JointSignals<T>* s, const T* shaft_torque,
                          const T* stretch_rate, T& input, T& lost) {
  const int n = joint_count<known>(arm);
  T g[kMaxJoints], reaction[kMaxJoints], path_rate[kMaxJoints];
  for (int k = 0; k < n; ++k) g[k] = s[k].cable_force_joint;
  joint_reaction<known>(arm, g, reaction);
  cable_path<known>(arm, v, path_rate);
  input = lost = T(0.0);
  for (int k = 0; k < n; ++k) {
    const JointParameters<T>& j = arm.joint[k];
    input += shaft_torque[k] * s[k].motor_rate + s[k].external_force * s[k].joint_rate;
    lost += (shaft_torque[k] - s[k].motor_torque) * s[k].motor_rate;
    lost += (reaction[k] + s[k].external_force - s[k].joint_force) * s[k].joint_rate;
    if (j.drive != Drive::cable) continue;
    lost += s[k].cable_force_motor * j.motor_travel() * s[k].motor_rate - g[k] * path_rate[k];
    lost -= cable_force(j, s[k].stretch, T(0.0)) * stretch_rate[k];
  }
}

template <int known, class T>
HALYARD_INLINE void term_rates(const DriveModel& drive, DriveTerms terms, const DriveState<T>& at, T* joint_force,
                               T* z_dot) {
  const ArmParameters<T>& arm = transmission_of<T>(drive).arm();
  const PlantLayout& l = drive.layout;
  const int n = joint_count<known>(arm);
  ArmSignals<T> signals(n);
  JointSignals<T>* s = signals.joint();
  T shaft_torque[kMaxJoints];
  evaluate_drive<known>(drive, at, s, shaft_torque, z_dot + l.effect_states);

  // Of these terms: force on the joints, torque on the rotor with the cable excluded, pull of the cable on the capstan.
  T torque[kMaxJoints], pull[kMaxJoints], motor_acceleration[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    pull[k] = s[k].cable_force_motor;
    switch (terms) {
      case DriveTerms::all:
        joint_force[k] = s[k].joint_force;
        torque[k] = s[k].motor_torque;
        break;
      case DriveTerms::cables_and_friction:
        joint_force[k] = s[k].joint_force - s[k].external_force;
        torque[k] = s[k].motor_torque - shaft_torque[k];
        break;
      case DriveTerms::first_cable:
        joint_force[k] = torque[k] = T(0.0);
        if (k > 0) pull[k] = T(0.0);
        break;
    }
  }
  if (terms == DriveTerms::first_cable) add_cable_reaction<known>(arm, 0, s[0].cable_force_joint, joint_force);
  drive_forces<known>(arm, torque, pull, joint_force, motor_acceleration);

  for (int k = 0; k < n; ++k) {
    if (arm.joint[k].drive != Drive::cable) continue;
    const bool counts = terms != DriveTerms::first_cable || k == 0;
    z_dot[*l.motor_angle[k]] = counts ? s[k].motor_rate : T(0.0);
    z_dot[*l.motor_rate[k]] = motor_acceleration[k];
  }
  if (terms == DriveTerms::first_cable)
    for (int i = 0; i < l.n_effect_states; ++i) z_dot[l.effect_states + i] = T(0.0);
  z_dot[l.input_energy] = z_dot[l.lost_energy] = T(0.0);
  if (terms != DriveTerms::all) return;
  T stretch_rate[kMaxJoints];
  transmission_of<T>(drive).template total_stretch_rates<known>(at.time, &drive.history, at.z + l.effect_states,
                                                                z_dot + l.effect_states, s, stretch_rate);
  meter<known>(arm, at.v, s, shaft_torque, stretch_rate, z_dot[l.input_energy], z_dot[l.lost_energy]);
}

/// term_rates() with its slopes, by dual numbers in all directions of the state.
template <int known>
HALYARD_INLINE void term_slopes(const DriveModel& drive, DriveTerms terms, const PlantInstant& at, double* joint_force,
                                double* z_dot, double* slopes, int stride) {
  const PlantLayout& l = drive.layout;
  const int n = joint_count<known>(drive.transmission.arm()), columns = 2 * n + l.input_energy;
  for (int first = 0; first < columns; first += kDualWidth) {
    const int count = columns - first < kDualWidth ? columns - first : kDualWidth;
    Dual y[2 * kMaxJoints + kMaxAuxiliaryStates], force[kMaxJoints], rate[kMaxAuxiliaryStates];
    for (int k = 0; k < n; ++k) y[k] = at.q[k], y[n + k] = at.v[k];
    for (int i = 0; i < l.input_energy; ++i) y[2 * n + i] = at.z[i];
    for (int i = 0; i < count; ++i) y[first + i].d.set(i, 1);
    term_rates<known>(drive, terms, DriveState<Dual>{at.time, y, y + n, y + 2 * n}, force, rate);
    const auto put = [&](int row, const Dual& x) __attribute__((always_inline)) {
      for (int i = 0; i < count; ++i) slopes[row + (first + i) * stride] = x.d[i];
    };
    for (int k = 0; k < n; ++k) joint_force[k] = force[k].a, put(k, force[k]);
    for (int i = 0; i < l.n_z; ++i) z_dot[i] = rate[i].a, put(n + i, rate[i]);
  }
}

}  // namespace halyard
