#include "plant/drive_train.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "transmission/cable_law.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// No effect looks further back than this, s.
constexpr double kHistorySpan = 2;
/// The last states, on which nothing depends.
constexpr int kMeters = 2;

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

std::optional<PlainDrive> make_plain(const Transmission<double>& transmission) {
  const ArmParameters<double>& arm = transmission.arm();
  for (const PlacedEffect& e : transmission.effects())
    if ((e.effect->stages() & ~static_cast<unsigned>(EffectStage::sensors)) != 0 || e.effect->n_states() > 0) return {};
  ArmParameters<double> of_joint[kLaneWidth];
  for (int k = 0; k < kLaneWidth; ++k) {
    of_joint[k].joint[0] = arm.joint[std::min(k, arm.n - 1)];
    if (of_joint[k].joint[0].drive != Drive::cable || of_joint[k].joint[0].law != arm.joint[0].law) return {};
  }
  const JointParameters<Lanes> joint = pack(of_joint).joint[0];
  return PlainDrive{joint, joint.motor_travel()};
}

DriveModel make_model(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects) {
  Transmission<double> transmission(nominal, effects);
  const PlantLayout layout = make_layout(transmission);
  const std::optional<PlainDrive> plain = make_plain(transmission);
  return {std::move(transmission), lift_transmission<Dual>(nominal, effects), plain, layout,
          CommandHistory(nominal.n, kHistorySpan)};
}

}  // namespace

DriveTrain::DriveTrain(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects)
    : model_(make_model(nominal, effects)), kernels_(plant_kernels().front()), rotor_mass_(make_rotor_mass(arm())) {}

void DriveTrain::set_inputs(double time_s, const double* command, const double* external) {
  for (int k = 0; k < layout().n; ++k) model_.command[k] = command[k], model_.external[k] = external[k];
  model_.history.push(time_s, command);
}

void DriveTrain::rates(DriveTerms terms, double time_s, const double* q, const double* v, const double* z,
                       double* joint_force, double* z_dot) const {
  kernels_.rates(model_, terms, {time_s, q, v, z}, joint_force, z_dot);
}

void DriveTrain::slopes(DriveTerms terms, double time_s, const double* q, const double* v, const double* z,
                        Eigen::MatrixXd& slopes) const {
  const int n = layout().n, n_z = layout().n_z;
  double joint_force[kMaxJoints], z_dot[kMaxAuxiliaryStates];
  slopes.resize(n + n_z, layout().size());
  kernels_.slopes(model_, terms, {time_s, q, v, z}, joint_force, z_dot, slopes.data(), n + n_z);
  slopes.rightCols(kMeters).setZero();
}

void DriveTrain::linearise(DriveTerms terms, double time_s, const double* y, double* y_dot,
                           Eigen::Ref<Eigen::MatrixXd> J) const {
  const int n = layout().n;
  kernels_.slopes(model_, terms, {time_s, y, y + n, y + 2 * n}, y_dot + n, y_dot + 2 * n, J.data() + n,
                  static_cast<int>(J.outerStride()));
  J.rightCols(kMeters).bottomRows(n + layout().n_z).setZero();
}

void DriveTrain::signals(double time_s, const double* q, const double* v, const double* z,
                         JointSignals<double>* s) const {
  kernels_.signals(model_, {time_s, q, v, z}, s);
}

double DriveTrain::stored_energy(double time_s, const double* q, const double* v, const double* z) const {
  JointSignals<double> s[kMaxJoints];
  signals(time_s, q, v, z, s);
  double energy = 0;
  for (int k = 0; k < layout().n; ++k) {
    const JointParameters<double>& j = arm().joint[k];
    if (j.drive == Drive::cable) energy += cable_energy(j, s[k].stretch);
    if (j.drive != Drive::none) energy += 0.5 * j.rotor_inertia * s[k].motor_rate * s[k].motor_rate;
  }
  return energy;
}

}  // namespace halyard
