#include "estimators/process/process_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimators/eigen_modes.h"
#include "estimators/process/standstill.h"
#include "model/input_error.h"
#include "model/output/number_text.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

constexpr double kStableStep = 2.2;  // h |λ|; see the header

std::vector<std::string> name_states(const Transmission<double>& transmission, const StateLayout& l) {
  std::vector<std::string> names(l.size);
  const auto put = [&](std::optional<int> index, const char* what, int k) {
    if (index) names[*index] = std::string(what).append("_").append(std::to_string(k + 1));
  };
  for (int k = 0; k < l.n_joints; ++k) {
    put(l.motor_angle[k], "motor_angle", k);
    put(l.motor_rate[k], "motor_rate", k);
    put(l.position[k], "joint_position", k);
    put(l.rate[k], "joint_rate", k);
  }
  int next = l.effect_states;
  for (const auto& e : transmission.effects()) {
    for (int i = 0; i < e.effect->n_states(); ++i) {
      std::string& name = names[next++] = e.effect->name();
      if (e.joint) name.append("_").append(std::to_string(*e.joint + 1));
      name.append("_state_").append(std::to_string(i + 1));
    }
  }
  return names;
}

/// A step's inputs over the scalar T.
template <class T>
struct StepInputs {
  T command[kMaxJoints], external[kMaxJoints];
  StepInputs(const Step& step, int n) {
    for (int k = 0; k < n; ++k) {
      command[k] = step.motor_torque ? step.motor_torque[k] : 0.0;
      external[k] = step.external_force ? step.external_force[k] : 0.0;
    }
  }
};

}  // namespace

int steps_over(double span_s, double longest_s) {
  constexpr double kRounding = 1e-9, kMost = 1e9;
  return static_cast<int>(std::clamp(std::ceil(span_s / longest_s - kRounding), 1.0, kMost));
}

void load_lanes(const Eigen::Ref<const Eigen::MatrixXd>& X, int first, Lanes* x) {
  const int last = static_cast<int>(X.cols()) - 1;
  for (int lane = 0; lane < kLaneWidth; ++lane) {
    const double* column = X.col(std::min(first + lane, last)).data();
    for (Eigen::Index i = 0; i < X.rows(); ++i) x[i].set(lane, column[i]);
  }
}

ProcessModel::ProcessModel(const ArmModel& model)
    : transmission_(lift_transmission<double>(model.nominal, model.effects)),
      dual_(lift_transmission<Dual>(model.nominal, model.effects)),
      lanes_(lift_transmission<Lanes>(model.nominal, model.effects)),
      layout_(state_layout(transmission_)),
      plain_(plain_transmission(transmission_, layout_)) {
  if (layout_.size > kMaxStates)
    throw InputError("arm with effects has " + std::to_string(layout_.size) + " states, more than " +
                     std::to_string(kMaxStates) + ": place fewer effects with internal states");
  state_names_ = name_states(transmission_, layout_);
  for (const auto& e : transmission_.effects())
    if (e.effect->stages() & static_cast<unsigned>(EffectStage::sensors)) readings_are_linear_ = false;
  is_plain_ = plain_.has_value();
  for (int k = 0; k < n_joints(); ++k) is_plain_ = is_plain_ && arm().joint[k].law == CableLaw::paper;
  has_effects_ = !plain_ || plain_->has_effects();
  linear_z_.resize(n_joints());
  linear_H_.set_zero(n_joints(), n_states());
  differentiate_readings(0, Eigen::VectorXd::Zero(n_states()), linear_z_, linear_H_.view());
  find_stiffest_rate(model);
}

void ProcessModel::find_stiffest_rate(const ArmModel& model) {
  const Step at_rest;
  for (const StandstillPose& pose : standstill_poses(transmission_, model)) {
    Eigen::MatrixXd A;
    const Eigen::VectorXd x_dot = derivative(at_rest, state_at_rest(pose.motor_angle, pose.joint_position), &A);
    for (int i = 0; i < n_states(); ++i)
      if (!std::isfinite(x_dot(i)) || !A.row(i).allFinite()) throw_not_finite(0, i);
    const EigenModes modes = eigen_modes(A);
    int k = 0, k_left = 0;
    const double rate = modes.eigenvalues.cwiseAbs().maxCoeff(&k);
    if (rate <= stiffest_rate_) continue;
    stiffest_rate_ = rate;
    // Participation factors, right times left eigenvector, do not depend on the states' units.
    const EigenModes left = eigen_modes(A.transpose());
    (left.eigenvalues.array() - modes.eigenvalues(k)).abs().minCoeff(&k_left);
    (modes.eigenvectors.col(k).array() * left.eigenvectors.col(k_left).array()).abs().maxCoeff(&stiffest_state_);
  }
}

double ProcessModel::substeps_needed(double dt_s) const {
  return std::max(1.0, std::ceil(dt_s * stiffest_rate_ / kStableStep));
}

int ProcessModel::substeps(double dt_s) const {
  constexpr double kLongStep = 1e-3;  // s
  const double needed = substeps_needed(dt_s);
  const double allowed = std::floor(kMaxSubsteps * std::max(1.0, dt_s / kLongStep));
  if (needed <= allowed) return static_cast<int>(needed);
  throw std::runtime_error("process model: a step of " + with_digits(dt_s, 6) + " s would need " +
                           with_digits(needed, 6) + " sub-steps (at most " + with_digits(allowed, 6) + ") for " +
                           stiffest_state() + ", which settles at " + with_digits(stiffest_rate_, 6) +
                           " 1/s at standstill; take shorter steps, a larger smoothing speed of its friction, or less "
                           "damping");
}

void ProcessModel::throw_not_finite(double time_s, int state) const {
  throw std::runtime_error("process model: " + state_names_[state] + " is not finite at " + with_digits(time_s, 12) +
                           " s; check the model's parameters and the log's torques there");
}

void ProcessModel::advance(const Step& step, double* x) const {
  const StepInputs<double> in(step, n_joints());
  const int parts = substeps(step.dt_s);
  const double h = step.dt_s / parts;
  for (int i = 0; i < parts; ++i)
    runge_kutta_4(transmission_, layout_, step.time_s + i * h, h, step.history, in.command, in.external, x);
  for (int i = 0; i < n_states(); ++i)
    if (!std::isfinite(x[i])) throw_not_finite(step.time_s + step.dt_s, i);
}

void ProcessModel::advance_many(const Step& step, Eigen::Ref<Eigen::MatrixXd> X, const LaneKernels& kernels) const {
  const StepInputs<Lanes> in(step, n_joints());
  const int parts = substeps(step.dt_s), n = n_states(), count = static_cast<int>(X.cols());
  for (int first = 0; first < count; first += kLaneWidth) {
    const int used = std::min(kLaneWidth, count - first);
    Lanes x[kMaxStates];
    load_lanes(X, first, x);
    kernels.advance(lanes_, layout_, step.time_s, step.dt_s, parts, step.history, in.command, in.external, x);
    for (int lane = 0; lane < used; ++lane)
      for (int i = 0; i < n; ++i) {
        if (!std::isfinite(x[i][lane])) throw_not_finite(step.time_s + step.dt_s, i);
        X(i, first + lane) = x[i][lane];
      }
  }
}

void ProcessModel::advance_with_jacobian(const Step& step, double* x, Eigen::Ref<Eigen::MatrixXd> F,
                                         const LaneKernels& kernels) const {
  const StepInputs<Dual> in(step, n_joints());
  const int parts = substeps(step.dt_s), n = n_states();
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStates, 1> next(n);
  const auto one_step = [&](const Dual* at, Dual* after) {
    std::copy(at, at + n, after);
    kernels.advance_dual(dual_, layout_, step.time_s, step.dt_s, parts, step.history, in.command, in.external, after);
  };
  jacobian(one_step, Eigen::Map<Eigen::VectorXd>(x, n), next, F);
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(next(i)) || !F.row(i).allFinite()) throw_not_finite(step.time_s + step.dt_s, i);
    x[i] = next(i);
  }
}

Eigen::VectorXd ProcessModel::derivative(const Step& step, const Eigen::VectorXd& x, Eigen::MatrixXd* A) const {
  Eigen::VectorXd x_dot;
  if (A) linearise(step, x, x_dot, *A);
  else derivative(step, x, x_dot);
  return x_dot;
}

void ProcessModel::derivative(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot) const {
  const StepInputs<double> in(step, n_joints());
  x_dot.resize(n_states());
  state_derivative(transmission_, layout_, step.time_s, step.history, in.command, in.external, x.data(), x_dot.data());
}

void ProcessModel::linearise(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot,
                             Eigen::MatrixXd& A) const {
  LinearisedPoint point;
  linearise(step, x, nullptr, x_dot, A, point);
}

void ProcessModel::linearise(const Step& step, const Eigen::VectorXd& x, const ChainPoint* near, Eigen::VectorXd& x_dot,
                             Eigen::MatrixXd& A, LinearisedPoint& point) const {
  const StepInputs<Dual> in(step, n_joints());
  x_dot.resize(n_states());
  A.resize(n_states(), n_states());
  lane_kernels()[0].linearise(linearised_arm(), step.time_s, {step.history, in.command, in.external}, x.data(), near,
                              x_dot.data(), A.data(), point);
}

void ProcessModel::jacobian_beside(const Step& step, const Eigen::VectorXd& x, const ChainPoint& chain,
                                   Eigen::MatrixXd& A) const {
  const StepInputs<Dual> in(step, n_joints());
  A.resize(n_states(), n_states());
  lane_kernels()[0].jacobian(linearised_arm(), step.time_s, {step.history, in.command, in.external}, x.data(), chain,
                             A.data());
}

void ProcessModel::changes(const Step& step, const ChainPoint& chain, const KnownRates& at, const LaneMatrix& d,
                           LaneMatrix& changes, double* first_force) const {
  const StepInputs<Lanes> in(step, n_joints());
  changes.reshape(d.rows(), n_states() - layout_.positions);
  lane_kernels()[0].changes(lanes_, layout_, step.time_s, step.history, in.command, in.external, chain, at, d.blocks(),
                            d.lanes(), changes.lanes(), first_force);
}

void ProcessModel::chain_curvature(LinearisedPoint& point, const Eigen::VectorXd& x, const Eigen::VectorXd& x_dot,
                                   const Eigen::MatrixXd& A, double gamma, const LaneMatrix& root) const {
  lane_kernels()[0].chain_curvature(linearised_arm(), point, x.data(), x_dot.data(), A.data(), gamma, root.rows(),
                                    root.blocks(), root.lanes());
}

void ProcessModel::mean_curvature(const Step& step, const Eigen::VectorXd& x, const ChainPoint& chain,
                                  const LinearisedPoint& point, double gamma, const LaneMatrix& root,
                                  Eigen::VectorXd& mean) const {
  mean.resize(n_states());
  lane_kernels()[0].mean_curvature(linearised_arm(), step.time_s, x.data(), chain, point, gamma, root.rows(),
                                   root.blocks(), root.lanes(), mean.data());
}

void ProcessModel::second_stage(const Step& next, const LinearisedPoint& start, const Eigen::VectorXd& x,
                                const Eigen::VectorXd& x_2, LinearisedPoint& end, Eigen::VectorXd& D) const {
  D.resize(moving_states() - layout_.positions);
  lane_kernels()[0].second_stage(linearised_arm(), next.time_s, start, x.data(), x_2.data(), end, D.data());
}

void ProcessModel::rates_beside(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot,
                                LinearisedPoint& point) const {
  const StepInputs<Dual> in(step, n_joints());
  x_dot.resize(n_states());
  lane_kernels()[0].rates_beside(linearised_arm(), step.time_s, {step.history, in.command, in.external}, x.data(),
                                 x_dot.data(), point);
}

void ProcessModel::far_excess(const Step& next, const LinearisedPoint& start, const LinearisedPoint& end,
                              const Eigen::VectorXd& x_2, double factor, const LaneMatrix& d, LaneMatrix& rates) const {
  rates.reshape(d.rows(), moving_states() - layout_.positions);
  lane_kernels()[0].far_excess(linearised_arm(), next.time_s, start, end, x_2.data(), factor, d.blocks(), d.lanes(),
                               rates.lanes());
}

void ProcessModel::near_excess(const LinearisedPoint& start, const LinearisedPoint& at, double factor,
                               const LaneMatrix& d, LaneMatrix& rates) const {
  rates.reshape(d.rows(), moving_states() - layout_.positions);
  lane_kernels()[0].near_excess(linearised_arm(), start, at, factor, d.blocks(), d.lanes(), rates.lanes());
}

bool ProcessModel::has_kink_near(const Step& step, const Eigen::VectorXd& x, const LinearisedPoint& at,
                                 const Eigen::VectorXd& x_2, double deviations, const LaneMatrix& S) const {
  return plain_ && halyard::has_kink_near(*plain_, transmission_, layout_, step.time_s, x.data(), at.cable, x_2.data(),
                                          deviations, S.view());
}

void ProcessModel::impulse_response(const Step& step, const LinearisedPoint& start, const Eigen::MatrixXd& A,
                                    const Eigen::VectorXd& x, const Eigen::VectorXd& x_2, const LaneMatrix& G,
                                    LaneMatrix& Gamma) const {
  const ImpulseStep impulses{
      step.time_s, start, A.data(), x.data(), x_2.data(), step.dt_s, 2 * substeps(step.dt_s / 2)};
  lane_kernels()[0].impulse_response(linearised_arm(), impulses, G.blocks(), G.lanes(), Gamma.lanes());
}

Eigen::VectorXd ProcessModel::motor_readings(double time_s, const Eigen::VectorXd& x, Eigen::MatrixXd* H) const {
  Eigen::VectorXd z(n_joints());
  Eigen::MatrixXd own;
  Eigen::MatrixXd& slopes = H ? *H : own;
  slopes.resize(n_joints(), n_states());
  linearise_readings(time_s, x, z, slopes);
  return z;
}

void ProcessModel::read(double time_s, const Eigen::Ref<const Eigen::VectorXd>& x,
                        Eigen::Ref<Eigen::VectorXd> z) const {
  read_encoders(transmission_, layout_, time_s, x.data(), z.data());
}

void ProcessModel::linearise_readings(double time_s, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                                      Eigen::Ref<Eigen::MatrixXd> H) const {
  if (!readings_are_linear_) return differentiate_readings(time_s, x, z, H);
  Lanes change;
  multiply(linear_H_.columns(0, n_states()), right(x), {n_joints(), 1, 1, &change}, false);
  for (int k = 0; k < n_joints(); ++k) z(k) = linear_z_(k) + change[k];
  set_block(linear_H_.view(), H);
}

void ProcessModel::differentiate_readings(double time_s, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                                          Eigen::Ref<Eigen::MatrixXd> H) const {
  const auto read = [&](const Dual* at, Dual* reading) { read_encoders(dual_, layout_, time_s, at, reading); };
  jacobian(read, x, z, H);
}

Eigen::VectorXd ProcessModel::state_at_rest(const Eigen::VectorXd& motor_angle,
                                            const Eigen::VectorXd& joint_position) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n_states());
  for (int k = 0; k < n_joints(); ++k) {
    x(layout_.position[k]) = joint_position(k);
    if (layout_.motor_angle[k]) x(*layout_.motor_angle[k]) = motor_angle(k);
  }
  return x;
}

}  // namespace halyard
