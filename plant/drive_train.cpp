#include "plant/drive_train.h"

#include <stdexcept>
#include <string>

namespace halyard {
namespace {

/// No effect looks further back than this, s.
constexpr double kHistorySpan = 2;

PlantLayout make_layout(const Transmission<double>& transmission) {
  PlantLayout l;
  l.n = transmission.arm().n;
  for (int k = 0; k < kMaxJoints; ++k) {
    l.motor_angle[k] = l.motor_rate[k] = PlantLayout::kNone;
    if (k >= l.n || transmission.arm().joint[k].drive != Drive::cable) continue;
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

Transmission<Dual> lift_transmission(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects) {
  std::vector<EffectInstance<Dual>> lifted;
  for (const PlacedEffect& e : effects) {
    EffectInstance<Dual> d;
    d.effect = e.effect;
    d.joint = e.joint;
    for (int i = 0; i < kMaxEffectParameters; ++i) d.p[i] = e.p[i];
    lifted.push_back(d);
  }
  return Transmission<Dual>(lift<Dual>(nominal), lifted);
}

Eigen::MatrixXd make_rotor_mass(const ArmParameters<double>& arm) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(arm.n, arm.n);
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    if (j.drive != Drive::rigid) continue;
    const Eigen::Map<const Eigen::VectorXd> C(j.coupling, arm.n);
    const double turns = j.pulley_radius / j.motor_travel();
    M += j.rotor_inertia * turns * turns * C * C.transpose();
  }
  return M;
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
  T path[kMaxJoints];
  cable_path(arm, m.q, path);
  cable_path(arm, m.v, e.path_rate);
  for (int k = 0; k < l.n; ++k) {
    JointSignals<T>& s = e.s[k];
    s.command = m.command[k];
    s.external_force = m.external[k];
    s.joint_position = m.q[k];
    s.joint_rate = m.v[k];
    if (arm.joint[k].drive == Drive::cable) {
      s.motor_angle = m.z[l.motor_angle[k]];
      s.motor_rate = m.z[l.motor_rate[k]];
    } else if (arm.joint[k].drive == Drive::rigid) {
      s.motor_angle = path[k] / arm.joint[k].motor_travel();
      s.motor_rate = e.path_rate[k] / arm.joint[k].motor_travel();
    }
  }
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

  T torque[kMaxJoints], pull[kMaxJoints];  // of these terms: on the rotor, cable excluded; of the cable on the capstan
  for (int k = 0; k < l.n; ++k) {
    const JointSignals<T>& s = e.s[k];
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
        joint_force[k] = arm.joint[0].pulley_radius * arm.joint[0].coupling[k] * e.s[0].cable_force_joint;
        torque[k] = T(0.0);
        break;
    }
    pull[k] = terms == DriveTerms::first_cable && k > 0 ? T(0.0) : s.cable_force_motor;
  }

  for (int k = 0; k < l.n; ++k) {
    const JointParameters<T>& j = arm.joint[k];
    if (j.drive == Drive::rigid) {
      const T force = torque[k] / j.motor_travel() * j.pulley_radius;
      for (int i = 0; i < l.n; ++i) joint_force[i] += j.coupling[i] * force;
    } else if (j.drive == Drive::cable) {
      const bool counts = terms != DriveTerms::first_cable || k == 0;
      z_dot[l.motor_angle[k]] = counts ? e.s[k].motor_rate : T(0.0);
      z_dot[l.motor_rate[k]] = (torque[k] - j.motor_travel() * pull[k]) / j.rotor_inertia;
    }
  }
  for (int i = 0; i < l.n_effect_states; ++i)
    z_dot[l.effect_states + i] = terms == DriveTerms::first_cable ? T(0.0) : e.effect_rate[i];
  z_dot[l.input_energy] = z_dot[l.lost_energy] = T(0.0);
  if (terms == DriveTerms::all) meter(arm, l, e, z_dot[l.input_energy], z_dot[l.lost_energy]);
}

}  // namespace

DriveTrain::DriveTrain(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects)
    : transmission_(nominal, effects),
      slope_transmission_(lift_transmission(nominal, effects)),
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
  const int n = layout_.n, size = layout_.size();
  slopes.resize(n + layout_.n_z, size);
  Dual y[2 * kMaxJoints + kMaxAuxiliaryStates], force[kMaxJoints], z_dot[kMaxAuxiliaryStates];
  for (int first = 0; first < size; first += kDualWidth) {
    for (int i = 0; i < size; ++i) {
      const double value = i < n ? q[i] : i < 2 * n ? v[i - n] : z[i - 2 * n];
      const bool seeded = i >= first && i < first + kDualWidth;
      y[i] = seeded ? Dual::seed(value, i - first) : Dual(value);
    }
    term_rates(terms, slope_transmission_, layout_,
               Motion<Dual>{time_s, &history_, command_, external_, y, y + n, y + 2 * n}, force, z_dot);
    for (int c = first; c < std::min(first + kDualWidth, size); ++c) {
      for (int r = 0; r < n; ++r) slopes(r, c) = force[r].d[c - first];
      for (int r = 0; r < layout_.n_z; ++r) slopes(n + r, c) = z_dot[r].d[c - first];
    }
  }
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
