#include "diagnosis/prediction/start/driven_start.h"

#include <algorithm>
#include <cmath>

#include "estimators/eigen_modes.h"
#include "transmission/coupling.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

/// Jacobian of the driven state [q, q', z] at x.
Eigen::MatrixXd driven_jacobian(const Transmission<Dual>& transmission, const Record& record, const DrivenInput& u,
                                const DrivenState<double>& x) {
  const int n = record.n, m = transmission.n_states(), size = 2 * n + m;
  Eigen::VectorXd at(size), rate(size);
  at << Eigen::Map<const Eigen::VectorXd>(x.q, n), Eigen::Map<const Eigen::VectorXd>(x.v, n),
      Eigen::Map<const Eigen::VectorXd>(x.z, m);
  Eigen::MatrixXd J(size, size);
  const auto rate_at = [&](const Dual* y, Dual* y_dot) {
    DrivenState<Dual> state, state_rate;
    std::copy(y, y + n, state.q);
    std::copy(y + n, y + 2 * n, state.v);
    std::copy(y + 2 * n, y + size, state.z);
    HeldChain<Dual> chain;
    chain_at(transmission.arm(), state.q, state.v, chain);
    driven_derivative<Dual>(transmission, &chain, record.start, nullptr, u, state, state_rate, nullptr, nullptr);
    std::copy(state_rate.q, state_rate.q + n, y_dot);
    std::copy(state_rate.v, state_rate.v + n, y_dot + n);
    std::copy(state_rate.z, state_rate.z + m, y_dot + 2 * n);
  };
  jacobian(rate_at, at, rate, J);
  return J;
}

/// In motion, from x on, where each cable pulls as hard as its motor ever did: a cable may be stiffer there, and the
/// joints' Coulomb friction no longer damps.
DrivenState<double> working_state(const Hypothesis& h, const Record& record, const DrivenInput& u,
                                  DrivenState<double> x) {
  const Transmission<double> transmission = lift_transmission<double>(h.nominal, h.effects);
  const ArmParameters<double>& arm = transmission.arm();
  for (int k = 0; k < arm.n; ++k) {
    if (arm.joint[k].drive != Drive::cable || !record.has_torque(k)) continue;
    double most = 0;
    for (const double torque : record.torque[k]) most = std::max(most, std::abs(torque));
    const double wanted = most / arm.joint[k].motor_travel(), from = x.q[k];
    constexpr double kFirst = 1e-6;  // rad | m, then twice as far each time
    constexpr int kMostDoublings = 18;
    for (int i = 0; i < kMostDoublings; ++i) {
      x.q[k] = from + std::ldexp(kFirst, i);
      JointSignals<double> s[kMaxJoints];
      for (int j = 0; j < arm.n; ++j) s[j].motor_angle = u.motor_angle[j], s[j].joint_position = x.q[j];
      double z_dot[kMaxStates];
      transmission.evaluate(record.start, nullptr, x.z, s, z_dot);
      if (std::abs(s[k].cable_force_joint) >= wanted) break;
    }
  }
  constexpr double kBeyondSmoothing = 10;
  for (int k = 0; k < arm.n; ++k) x.v[k] = kBeyondSmoothing * arm.joint[k].joint_smoothing;
  return x;
}

/// The states of all effects at `times` their scales, and cables that stretch fast. A loop that has yielded follows the
/// stretch at once, the faster this is; one that has not does not relax at all. At the start of a record the joints
/// fall into their cables: in a log of the RAVEN-II, predictions of a loop that yields at once were not finite with
/// three times less than this speed.
DrivenState<double> with_states(double times, const Hypothesis& h, DrivenState<double> x) {
  constexpr double kFast = 4;
  for (double& v : x.v) v *= kFast;
  double* z = x.z;
  for (const PlacedEffect& e : h.effects)
    for (const double scale : e.effect->state_scale(h.nominal, e.joint, e.p)) *z++ = times * scale;
  return x;
}

/// What no number of stages could follow does not keep a hypothesis from being predicted.
void limit_to(double fastest, Eigenvalues& spectrum) {
  for (std::complex<double>& rate : spectrum) rate *= std::min(1.0, fastest / std::abs(rate));
}

}  // namespace

DrivenState<double> unstretched_state(const Hypothesis& h, const Record& record, const DrivenInput& u) {
  const int n = record.n;
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  Eigen::VectorXd q_m(n), q_undriven(n);
  for (int k = 0; k < n; ++k) {
    q_m(k) = u.motor_angle[k] - arm.joint[k].motor_encoder_offset;
    q_undriven(k) = u.motor_angle[k] - arm.joint[k].joint_encoder_offset;
  }
  const Eigen::VectorXd q = unstretched_joints(arm, q_m, q_undriven);
  DrivenState<double> x = {};
  for (int k = 0; k < n; ++k) x.q[k] = q(k);
  return x;
}

std::vector<Eigenvalues> eigenvalues_of(const Hypothesis& h, const Record& record, const DrivenInput& held,
                                        const DrivenState<double>& x) {
  const Transmission<Dual> transmission = lift_transmission<Dual>(h.nominal, h.effects);
  std::vector<Eigenvalues> spectra;
  constexpr std::size_t kWithoutStates = 2;
  std::vector<DrivenState<double>> states = {x, working_state(h, record, held, x)};
  if (transmission.n_states() > 0)
    for (const double direction : {-1, 1}) states.push_back(with_states(direction, h, states[1]));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool has_to_be_known = i < kWithoutStates;
    const Eigen::MatrixXd J = driven_jacobian(transmission, record, held, states[i]);
    if (!J.allFinite() && has_to_be_known) return {};
    if (!J.allFinite()) continue;
    const Eigen::VectorXcd lambda = eigenvalues(J);
    spectra.emplace_back(lambda.begin(), lambda.end());
    if (!has_to_be_known) limit_to(fastest_stable(record.dt), spectra.back());
  }
  return spectra;
}

}  // namespace halyard
