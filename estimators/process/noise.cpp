#include "estimators/process/noise.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "estimators/process/standstill.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kEncoderFloor = 1e-5;  // rad

/// Typical size of every effect state.
Eigen::VectorXd effect_scales(const ProcessModel& process) {
  Eigen::VectorXd scales(process.layout().n_effect_states);
  Eigen::Index next = 0;
  for (const auto& e : process.transmission().effects())
    for (const double scale : e.effect->state_scale(process.arm(), e.joint, e.p)) scales(next++) = scale;
  return scales;
}

/// [n_joints x n_joints], without memory from the heap.
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints, kMaxJoints>;

/// M(q)⁻¹ of a state x.
JointMatrix mobility_at(const ProcessModel& process, const Eigen::VectorXd& x) {
  const ArmParameters<double>& arm = process.arm();
  double q[kMaxJoints];
  for (int k = 0; k < arm.n; ++k) q[k] = x(process.layout().position[k]);
  double M[kMaxJoints][kMaxJoints];
  mass_matrix(arm, chain_pose(arm, q), M);
  add_rotor_mass(arm, M);
  ldl_factor(arm.n, M);
  JointMatrix inverse = JointMatrix::Identity(arm.n, arm.n);
  for (int c = 0; c < arm.n; ++c) ldl_solve(arm.n, M, inverse.col(c).data());
  return inverse;
}

}  // namespace

double reading_deviation(double resolution, double noise) { return std::hypot(resolution / std::sqrt(12.0), noise); }

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
    levels.encoder(k) = std::max(reading_deviation(j.motor_encoder_resolution, j.motor_encoder_noise), kEncoderFloor);
    const Tolerances& t = model.joints[k].tolerances;
    levels.torque(k) = t.friction * j.motor_coulomb;
    levels.joint_force(k) = t.friction * j.joint_coulomb + t.mass * gravity(k);
  }
  levels.encoder = options.per_joint("encoder_noise", levels.encoder, 1e-9, kInfinity);
  levels.torque = options.per_joint("torque_noise", levels.torque, 0, kInfinity);
  levels.joint_force = options.per_joint("joint_force_noise", levels.joint_force, 0, kInfinity);
  levels.correlation_time = options.number("noise_time", 0.001, 0, kInfinity);
  levels.wander = effect_scales(process) / std::sqrt(options.number("effect_noise_time", 1e4, 1e-6, kInfinity));
  levels.adaptation_time = options.number("adaptation_time", 0, 0, kInfinity);
  return levels;
}

ArmNoise::ArmNoise(const ArmModel& model, const ProcessModel& process, const NoiseLevels& levels)
    : process_(process),
      levels_(levels),
      effect_scale_(effect_scales(process)),
      adapted_(Eigen::VectorXd::Ones(process.n_joints())),
      points_(process.n_states(), 2 * process.n_joints() + 1) {  // now, so that a later step needs no memory
  const ArmParameters<double>& arm = process.arm();
  const int n = arm.n;
  tolerance_.resize(n);
  friction_stretch_.setZero(n);
  undriven_.resize(n);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    tolerance_(k) = model.joints[k].tolerances.stiffness;
    if (j.drive == Drive::cable && j.stiffness > 0)
      friction_stretch_(k) = j.joint_coulomb / std::abs(j.pulley_radius) / (2 * j.stiffness) / std::sqrt(3.0);
    undriven_(k) = 0.1 * (model.joints[k].upper - model.joints[k].lower);
  }
}

const Eigen::MatrixXd& ArmNoise::impulses(const Step& step, const Eigen::Ref<const Eigen::MatrixXd>& mobility) {
  const ArmParameters<double>& arm = process_.arm();
  const StateLayout& l = process_.layout();
  const int n = arm.n;
  const double impulse = std::sqrt(2 * levels_.correlation_time * step.dt_s);
  G_.setZero(l.size, 2 * n);
  for (int k = 0; k < n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const double force = adapted_(k) * levels_.joint_force(k) * impulse;
    const double unknown = step.held ? step.held->impulse_variance(k, step.time_s, step.time_s + step.dt_s) : 0;
    const double torque = std::hypot(adapted_(k) * levels_.torque(k) * impulse, std::sqrt(unknown));
    for (int i = 0; i < n; ++i) G_(l.rate[i], n + k) = mobility(i, k) * force;
    if (j.drive == Drive::cable) G_(*l.motor_rate[k], k) = torque / j.rotor_inertia;
    if (j.drive != Drive::rigid) continue;
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < n; ++c) G_(l.rate[i], k) += mobility(i, c) * path_per_joint(j, c) / j.motor_travel() * torque;
  }
  return G_;
}

const Eigen::MatrixXd& ArmNoise::process_root(const Step& step, const Eigen::VectorXd& x,
                                              ExponentialStep* exponential) {
  const StateLayout& l = process_.layout();
  const int n_z = l.n_effect_states, forces = 2 * l.n_joints;
  Q_root_.setZero(l.size, forces + n_z);
  for (int i = 0; i < n_z; ++i) Q_root_(l.effect_states + i, forces + i) = levels_.wander(i) * std::sqrt(step.dt_s);
  if (exponential && exponential->respond(Q_root_.leftCols(forces))) return Q_root_;
  if (!exponential) impulses(step, mobility_at(process_, x));
  points_.col(0) = x;
  points_.rightCols(forces) = G_.colwise() + x;
  auto Gamma = Q_root_.leftCols(forces);
  Gamma = G_ / 6;
  Step half = step;
  half.dt_s = step.dt_s / 2;
  for (const double weight : {4.0 / 6, 1.0 / 6}) {
    process_.advance_many(half, points_);
    half.time_s += half.dt_s;
    Gamma += weight * (points_.rightCols(forces).colwise() - points_.col(0));
  }
  return Q_root_;
}

void ArmNoise::adapt(const std::vector<int>& motors, const Innovation& innovation, const ReadingVector& dt_s) {
  constexpr double kMost = 9;  // of ν² / S: an outlier counts as three deviations
  constexpr double kRange = 30;
  if (!(levels_.adaptation_time > 0)) return;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double square = std::pow(innovation.nu(row), 2) / innovation.S_root.row(row).squaredNorm();
    const double change = 0.5 * dt_s(row) / levels_.adaptation_time * (std::min(square, kMost) - 1);
    double& c = adapted_(motors[i]);
    c = std::clamp(c * std::exp(change), 1 / kRange, kRange);
  }
}

Eigen::MatrixXd ArmNoise::initial_root(const Eigen::VectorXd& x, double dt_s) const {
  const ArmParameters<double>& arm = process_.arm();
  const StateLayout& l = process_.layout();
  const int n = arm.n;
  const Eigen::MatrixXd R = path_matrix(arm);
  Eigen::VectorXd q(n);
  for (int k = 0; k < n; ++k) q(k) = x(l.position[k]);
  const Eigen::VectorXd path = R * q;

  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(l.size, l.size);
  Eigen::MatrixXd joints_per_path = R;  // of driven joints; one without drive stands for itself
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
      const double stretch = travel * x(*l.motor_angle[k]) - path(k);
      path_std(k) = encoder + tolerance_(k) * std::abs(stretch) + friction_stretch_(k);
      S(*l.motor_angle[k], *l.motor_angle[k]) = levels_.encoder(k);
      S(*l.motor_rate[k], *l.motor_rate[k]) = std::max(j.motor_smoothing, std::sqrt(2) * levels_.encoder(k) / dt_s);
    }
    const double joint_per_travel = j.drive == Drive::none ? 0 : 1 / std::abs(j.pulley_radius);
    S(l.rate[k], l.rate[k]) = std::max(j.joint_smoothing, std::sqrt(2) * encoder * joint_per_travel / dt_s);
  }
  const Eigen::MatrixXd position_root = joints_per_path.fullPivLu().solve(Eigen::MatrixXd(path_std.asDiagonal()));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) S(l.position[r], l.position[c]) = position_root(r, c);
  for (int i = 0; i < l.n_effect_states; ++i) S(l.effect_states + i, l.effect_states + i) = effect_scale_(i);
  return S;
}

}  // namespace halyard
