#include "estimators/noise.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "estimators/standstill.h"
#include "transmission/path_matrix.h"

namespace halyard {
namespace {

constexpr double kEncoderFloor = 1e-5;   // rad

/// Typical size of every effect state.
Eigen::VectorXd effect_scales(const ProcessModel& process) {
  Eigen::VectorXd scales(process.layout().n_effect_states);
  Eigen::Index next = 0;
  for (const auto& e : process.transmission().effects())
    for (const double scale : e.effect->state_scale(process.arm(), e.joint, e.p)) scales(next++) = scale;
  return scales;
}

/// Accelerations of the joints per joint force, motors of rigid drives carried along: M(q)⁻¹.
Eigen::MatrixXd mobility(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  double M[kMaxJoints][kMaxJoints];
  factored_mass(arm, chain_pose(arm, q.data()), M);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(arm.n, arm.n);
  for (int c = 0; c < arm.n; ++c) ldl_solve(arm.n, M, inverse.col(c).data());
  return inverse;
}

}  // namespace

NoiseLevels read_noise(OptionReader& options, const ArmModel& model, const ProcessModel& process) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ArmParameters<double>& arm = process.arm();
  const Eigen::VectorXd gravity = largest_gravity_force(arm, model);
  NoiseLevels levels;
  levels.encoder.resize(arm.n);
  levels.torque.resize(arm.n);
  levels.joint_force.resize(arm.n);
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    levels.encoder(k) = std::max(j.motor_encoder_resolution / std::sqrt(12.0), kEncoderFloor);
    levels.torque(k) = j.tolerance.friction * j.motor_coulomb;
    levels.joint_force(k) = j.tolerance.friction * j.joint_coulomb + j.tolerance.mass * gravity(k);
  }
  levels.encoder = options.per_joint("encoder_noise", levels.encoder, 1e-9, kInfinity);
  levels.torque = options.per_joint("torque_noise", levels.torque, 0, kInfinity);
  levels.joint_force = options.per_joint("joint_force_noise", levels.joint_force, 0, kInfinity);
  levels.correlation_time = options.number("noise_time", 0.001, 0, kInfinity);
  levels.wander = effect_scales(process) / std::sqrt(options.number("effect_noise_time", 1e4, 1e-6, kInfinity));
  return levels;
}

ArmNoise::ArmNoise(const ArmModel& model, const ProcessModel& process, const NoiseLevels& levels)
    : process_(process), levels_(levels), effect_scale_(effect_scales(process)) {
  const ArmParameters<double>& arm = process.arm();
  const StateLayout& l = process.layout();
  const int n = arm.n;
  tolerance_.resize(n);
  friction_stretch_.setZero(n);
  undriven_.resize(n);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    tolerance_(k) = j.tolerance.stiffness;
    if (j.drive == Drive::cable && j.stiffness > 0)
      friction_stretch_(k) = j.joint_coulomb / std::abs(j.pulley_radius) / (2 * j.stiffness) / std::sqrt(3.0);
    undriven_(k) = 0.1 * (model.joints[k].upper - model.joints[k].lower);
  }

  const double density = std::sqrt(2 * levels.correlation_time);
  const Eigen::MatrixXd M_inverse = mobility(arm, model.home());
  const int n_z = l.n_effect_states, sources = 2 * n + n_z;
  rate_.setZero(l.size, sources);
  position_.setZero(l.size, sources);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    for (int i = 0; i < n; ++i) rate_(l.rate[i], n + k) = M_inverse(i, k) * levels.joint_force(k) * density;
    if (j.drive == Drive::cable) rate_(l.motor_rate[k], k) = levels.torque(k) / j.rotor_inertia * density;
    if (j.drive != Drive::rigid) continue;
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < n; ++c)
        rate_(l.rate[i], k) += M_inverse(i, c) * j.coupling[c] * j.pulley_radius / j.motor_travel() *
                               levels.torque(k) * density;
  }
  for (int k = 0; k < n; ++k) {
    position_.row(l.position[k]) = 0.5 * rate_.row(l.rate[k]);
    if (l.motor_angle[k] >= 0) position_.row(l.motor_angle[k]) = 0.5 * rate_.row(l.motor_rate[k]);
  }
  for (int i = 0; i < n_z; ++i)
    rate_(l.effect_states + i, 2 * n + i) = levels.wander(i);
}

const Eigen::MatrixXd& ArmNoise::process_root(double dt_s) {
  Q_root_ = std::sqrt(dt_s) * rate_ + (dt_s * std::sqrt(dt_s)) * position_;
  return Q_root_;
}

Eigen::MatrixXd ArmNoise::initial_root(const Eigen::VectorXd& x) const {
  const ArmParameters<double>& arm = process_.arm();
  const StateLayout& l = process_.layout();
  const int n = arm.n;
  const Eigen::MatrixXd R = path_matrix(arm);
  Eigen::VectorXd q(n);
  for (int k = 0; k < n; ++k) q(k) = x(l.position[k]);
  const Eigen::VectorXd path = R * q;

  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(l.size, l.size);
  Eigen::MatrixXd joints_per_path = R;   // of driven joints; one without drive stands for itself
  Eigen::VectorXd path_std(n);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const double travel = j.motor_travel(), encoder = travel * levels_.encoder(k);
    if (j.drive == Drive::none) {
      joints_per_path.row(k) = Eigen::RowVectorXd::Unit(n, k);
      path_std(k) = undriven_(k);
    } else if (j.drive == Drive::rigid) {
      path_std(k) = encoder;
    } else {
      const double stretch = travel * x(l.motor_angle[k]) - path(k);
      path_std(k) = encoder + tolerance_(k) * std::abs(stretch) + friction_stretch_(k);
      S(l.motor_angle[k], l.motor_angle[k]) = levels_.encoder(k);
      S(l.motor_rate[k], l.motor_rate[k]) = j.motor_smoothing;
    }
    S(l.rate[k], l.rate[k]) = j.joint_smoothing;
  }
  const Eigen::MatrixXd position_root = joints_per_path.fullPivLu().solve(Eigen::MatrixXd(path_std.asDiagonal()));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) S(l.position[r], l.position[c]) = position_root(r, c);
  for (int i = 0; i < l.n_effect_states; ++i) S(l.effect_states + i, l.effect_states + i) = effect_scale_(i);
  return S;
}

}  // namespace halyard
