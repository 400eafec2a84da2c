#include "plant/drive_train.h"

#include <stdexcept>
#include <string>

#include "transmission/drive.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

/// No effect looks further back than this, s.
constexpr double kHistorySpan = 2;

PlantLayout make_layout(const Transmission<double>& transmission) {
  PlantLayout l;
  l.n = transmission.arm().n;
  for (int k = 0; k < l.n; ++k) {
    if (transmission.arm().joint[k].drive != Drive::cable) continue;
    if (!(transmission.arm().joint[k].rotor_inertia > 0))
      throw std::invalid_argument("joint " + std::to_string(k + 1) +
                                  ": a motor that drives a cable needs a rotor inertia above 0");
    l.motor_angle[k] = l.n_z++;
    l.motor_rate[k] = l.n_z++;
  }
  l.effect_states = l.n_z;
  l.n_effect_states = transmission.n_states();
  l.n_z += l.n_effect_states;
  l.input_energy = l.n_z++;
  l.lost_energy = l.n_z++;
  if (l.n_z > kMaxAuxiliaryStates)
    throw std::invalid_argument("the effects have " + std::to_string(l.n_effect_states) +
                                " internal states, more than there is room for; place fewer of them");
  return l;
}

Eigen::MatrixXd make_rotor_mass(const ArmParameters<double>& arm) {
  double M[kMaxJoints][kMaxJoints] = {};
  add_rotor_mass(arm, M);
  return Eigen::Map<Eigen::Matrix<double, kMaxJoints, kMaxJoints, Eigen::RowMajor>>(&M[0][0]).topLeftCorner(arm.n,
                                                                                                            arm.n);
}

template <class T>
struct Motion {
  double time;
  const CommandHistory* history;
  const double* command;
  const double* external;
  const T *q, *v, *z;
};

template <class T>
struct Evaluation {
  JointSignals<T> s[kMaxJoints];
  T shaft_torque[kMaxJoints];  ///< after the command stage, friction not yet taken off
  T path_rate[kMaxJoints];     ///< R q'
  T effect_rate[kMaxAuxiliaryStates];
};

template <class T>
void evaluate(const Transmission<T>& transmission, const PlantLayout& l, const Motion<T>& m, Evaluation<T>& e) {
  const ArmParameters<T>& arm = transmission.arm();
  cable_path(arm, m.v, e.path_rate);
  for (int k = 0; k < l.n; ++k) {
    e.s[k].command = m.command[k];
    e.s[k].external_force = m.external[k];
    if (arm.joint[k].drive != Drive::cable) continue;
    e.s[k].motor_angle = m.z[*l.motor_angle[k]];
    e.s[k].motor_rate = m.z[*l.motor_rate[k]];
  }
  set_motion(arm, m.q, m.v, e.s);
  const T* effect_states = m.z + l.effect_states;
  transmission.commanded_torque(m.time, m.history, effect_states, e.s);
  for (int k = 0; k < l.n; ++k) e.shaft_torque[k] = arm.joint[k].drive == Drive::none ? T(0.0) : e.s[k].motor_torque;
  transmission.evaluate(m.time, m.history, effect_states, e.s, e.effect_rate);
}

/// The rates of the two meters.
template <class T>
void meter(const ArmParameters<T>& arm, const PlantLayout& l, const Evaluation<T>& e, T& input, T& lost) {
  T g[kMaxJoints], reaction[kMaxJoints];
  for (int k = 0; k < l.n; ++k) g[k] = e.s[k].cable_force_joint;
  joint_reaction(arm, g, reaction);
  input = lost = T(0.0);
  for (int k = 0; k < l.n; ++k) {
    const JointSignals<T>& s = e.s[k];
    const JointParameters<T>& j = arm.joint[k];
    input += e.shaft_torque[k] * s.motor_rate + s.external_force * s.joint_rate;
    lost += (e.shaft_torque[k] - s.motor_torque) * s.motor_rate;
    lost += (reaction[k] + s.external_force - s.joint_force) * s.joint_rate;
    if (j.drive != Drive::cable) continue;
    lost += s.cable_force_motor * j.motor_travel() * s.motor_rate - g[k] * e.path_rate[k];
    lost -= cable_force(j, s.stretch, T(0.0)) * s.stretch_rate;
  }
}

template <class T>
void term_rates(DriveTerms terms, const Transmission<T>& transmission, const PlantLayout& l, const Motion<T>& m,
                T* joint_force, T* z_dot) {
  const ArmParameters<T>& arm = transmission.arm();
  Evaluation<T> e;
  evaluate(transmission, l, m, e);

  // Of these terms: force on the joints, torque on the rotor with the cable excluded, pull of the cable on the capstan.
  T torque[kMaxJoints], pull[kMaxJoints], motor_acceleration[kMaxJoints];
  for (int k = 0; k < l.n; ++k) {
    const JointSignals<T>& s = e.s[k];
    pull[k] = s.cable_force_motor;
    switch (terms) {
      case DriveTerms::all:
        joint_force[k] = s.joint_force;
        torque[k] = s.motor_torque;
        break;
      case DriveTerms::cables_and_friction:
        joint_force[k] = s.joint_force - s.external_force;
        torque[k] = s.motor_torque - e.shaft_torque[k];
        break;
      case DriveTerms::first_cable:
        joint_force[k] = torque[k] = T(0.0);
        if (k > 0) pull[k] = T(0.0);
        break;
    }
  }
  if (terms == DriveTerms::first_cable) add_cable_reaction(arm, 0, e.s[0].cable_force_joint, joint_force);
  drive_forces(arm, torque, pull, joint_force, motor_acceleration);

  for (int k = 0; k < l.n; ++k) {
    if (arm.joint[k].drive != Drive::cable) continue;
    const bool counts = terms != DriveTerms::first_cable || k == 0;
    z_dot[*l.motor_angle[k]] = counts ? e.s[k].motor_rate : T(0.0);
    z_dot[*l.motor_rate[k]] = motor_acceleration[k];
  }
  for (int i = 0; i < l.n_effect_states; ++i)
    z_dot[l.effect_states + i] = terms == DriveTerms::first_cable ? T(0.0) : e.effect_rate[i];
  z_dot[l.input_energy] = z_dot[l.lost_energy] = T(0.0);
  if (terms == DriveTerms::all) meter(arm, l, e, z_dot[l.input_energy], z_dot[l.lost_energy]);
}

}  // namespace

DriveTrain::DriveTrain(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects)
    : transmission_(nominal, effects),
      slope_transmission_(lift_transmission<Dual>(nominal, effects)),
      layout_(make_layout(transmission_)),
      rotor_mass_(make_rotor_mass(transmission_.arm())),
      history_(nominal.n, kHistorySpan) {}

void DriveTrain::set_inputs(double time_s, const double* command, const double* external) {
  for (int k = 0; k < layout_.n; ++k) command_[k] = command[k], external_[k] = external[k];
  history_.push(time_s, command);
}

void DriveTrain::rates(DriveTerms terms, double time_s, const double* q, const double* v, const double* z,
                       double* joint_force, double* z_dot) const {
  term_rates(terms, transmission_, layout_, Motion<double>{time_s, &history_, command_, external_, q, v, z},
             joint_force, z_dot);
}

void DriveTrain::slopes(DriveTerms terms, double time_s, const double* q, const double* v, const double* z,
                        Eigen::MatrixXd& slopes) const {
  const int n = layout_.n, rows = n + layout_.n_z, others = 2 * n + layout_.input_energy;
  Eigen::VectorXd y(others), values(rows);
  y << Eigen::Map<const Eigen::VectorXd>(q, n), Eigen::Map<const Eigen::VectorXd>(v, n),
      Eigen::Map<const Eigen::VectorXd>(z, layout_.input_energy);
  slopes.resize(rows, layout_.size());
  const auto rates_at = [&](const Dual* at, Dual* out) {
    term_rates(terms, slope_transmission_, layout_,
               Motion<Dual>{time_s, &history_, command_, external_, at, at + n, at + 2 * n}, out, out + n);
  };
  jacobian(rates_at, y, values, slopes.leftCols(others));
  slopes.rightCols(layout_.size() - others).setZero();
}

void DriveTrain::signals(double time_s, const double* q, const double* v, const double* z,
                         JointSignals<double>* s) const {
  Evaluation<double> e;
  evaluate(transmission_, layout_, Motion<double>{time_s, &history_, command_, external_, q, v, z}, e);
  transmission_.sensor_errors(time_s, z + layout_.effect_states, e.s);
  for (int k = 0; k < layout_.n; ++k) s[k] = e.s[k];
}

double DriveTrain::stored_energy(double time_s, const double* q, const double* v, const double* z) const {
  JointSignals<double> s[kMaxJoints];
  signals(time_s, q, v, z, s);
  double energy = 0;
  for (int k = 0; k < layout_.n; ++k) {
    const JointParameters<double>& j = arm().joint[k];
    if (j.drive == Drive::cable) energy += cable_energy(j, s[k].stretch);
    if (j.drive != Drive::none) energy += 0.5 * j.rotor_inertia * s[k].motor_rate * s[k].motor_rate;
  }
  return energy;
}

}  // namespace halyard
