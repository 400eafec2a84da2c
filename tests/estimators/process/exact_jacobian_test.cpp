/// The process model and its Jacobian against long double, on arms without effects: cables, friction, coupling, rotors
/// and the rigid chain. tests/transmission/laws/exact_derivatives_test.cpp has the effects.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "estimators/process/arm_dynamics.h"
#include "model/model_file.h"
#include "tests/estimators/process/precise.h"
#include "tests/support/limits.h"
#include "tests/support/random_arm.h"
#include "transmission/cable_law.h"
#include "transmission/friction.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

using Real = long double;
using PreciseVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// x' of an arm of cable drives, from the library's templates for each term. A Transmission, which would join them,
/// exists for the scalars of effects alone.
PreciseVector precise_rates(const ArmParameters<double>& arm, const StateLayout& l, const double* command,
                            const PreciseVector& at) {
  const int n = arm.n;
  const ArmParameters<Precise> parameters = precise(arm);
  Precise q[kMaxJoints], v[kMaxJoints], path[kMaxJoints], path_rate[kMaxJoints], pull[kMaxJoints], a[kMaxJoints],
      zero[kMaxJoints], bias[kMaxJoints], M[kMaxJoints][kMaxJoints];
  for (int k = 0; k < n; ++k) q[k].a = at(l.position[k]), v[k].a = at(l.rate[k]);
  cable_path(parameters, q, path);
  cable_path(parameters, v, path_rate);
  PreciseVector rates(l.size);
  for (int k = 0; k < n; ++k) {
    const JointParameters<Precise>& j = parameters.joint[k];
    const Precise turn = Precise::of(at(*l.motor_angle[k])), speed = Precise::of(at(*l.motor_rate[k]));
    pull[k] = cable_force(j, j.motor_travel() * turn - path[k], j.motor_travel() * speed - path_rate[k]);
    const Precise torque = j.torque_scale * Precise(command[k]) + j.torque_bias -
                           friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, speed);
    rates(*l.motor_angle[k]) = speed.a;
    rates(*l.motor_rate[k]) = ((torque - j.motor_travel() * pull[k]) / j.rotor_inertia).a;
  }
  joint_reaction(parameters, pull, a);
  const ChainPose<Precise> pose = chain_pose(parameters, q);
  inverse_dynamics(parameters, pose, v, zero, bias);
  for (int k = 0; k < n; ++k) {
    const JointParameters<Precise>& j = parameters.joint[k];
    a[k] -= friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, v[k]) + bias[k];
  }
  mass_matrix(parameters, pose, M);
  ldl_factor<Precise, kMaxJoints>(n, M);
  ldl_solve<Precise, kMaxJoints>(n, M, a);
  for (int k = 0; k < n; ++k) rates(l.position[k]) = v[k].a, rates(l.rate[k]) = a[k].a;
  return rates;
}

/// Rates and Jacobian of the process model, by dual numbers.
void linearise(const ArmParameters<double>& arm, const StateLayout& l, const double* command, const Eigen::VectorXd& x,
               Eigen::VectorXd& rates, Eigen::MatrixXd& J) {
  const Transmission<Dual> transmission(lift<Dual>(arm), {});
  Dual torque[kMaxJoints], no_load[kMaxJoints];
  for (int k = 0; k < arm.n; ++k) torque[k] = Dual(command[k]), no_load[k] = Dual(0.0);
  jacobian([&](const Dual* at, Dual* out) { state_derivative(transmission, l, 0, nullptr, torque, no_load, at, out); },
           x, rates, J);
}

/// Largest relative differences of rates and Jacobian, of the largest entry of their row.
void expect_exact(const ArmParameters<double>& arm, std::mt19937_64& random, double stretch) {
  const StateLayout l = state_layout(Transmission<double>(arm, {}));
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::VectorXd x(l.size), rates(l.size);
  for (double& each : x) each = unit(random);
  double q[kMaxJoints], path[kMaxJoints], command[kMaxJoints];
  for (int k = 0; k < arm.n; ++k) q[k] = x(l.position[k]), command[k] = unit(random);
  cable_path(arm, q, path);
  for (int k = 0; k < arm.n; ++k)
    x(*l.motor_angle[k]) = (path[k] + stretch * unit(random)) / arm.joint[k].motor_travel();
  Eigen::MatrixXd J(l.size, l.size);
  linearise(arm, l, command, x, rates, J);

  const PreciseVector at = x.cast<Real>(), wanted = precise_rates(arm, l, command, at);
  // Some hundred roundings of forces that partly cancel.
  EXPECT_LT((rates.cast<Real>() - wanted).cwiseAbs().maxCoeff(), 1e-12L * wanted.cwiseAbs().maxCoeff());
  for (int c = 0; c < l.size; ++c) {
    // Off by h⁶ / 140 of the seventh derivative, and by rounding of 5e-20 over h. Stretches are small numbers, and so
    // are the speeds over which friction turns. Observed: 3e-12.
    const Real h = c < l.positions ? 4e-2L * stretch : 1e-4L;
    const auto across = [&](Real by) {
      PreciseVector above = at, below = at;
      above(c) += by, below(c) -= by;
      return PreciseVector((precise_rates(arm, l, command, above) - precise_rates(arm, l, command, below)) / h);
    };
    const PreciseVector column = 3.0L / 4 * across(h) - 3.0L / 20 * across(2 * h) + 1.0L / 60 * across(3 * h);
    EXPECT_LT((J.col(c).cast<Real>() - column).cwiseAbs().maxCoeff(), 1e-10L * column.cwiseAbs().maxCoeff())
        << "column " << c;
  }
}

TEST(ExactJacobian, OfAnArmOfNumbersOfTheOrderOfOneIsThatOfLongDouble) {
  std::mt19937_64 random(3);
  for (const CableLaw law : {CableLaw::paper, CableLaw::exponential, CableLaw::linear})
    for (unsigned seed = 1; seed < 10; ++seed) expect_exact(random_arm(seed, law), random, 0.1);
}

TEST(ExactJacobian, OfTheRaven2IsThatOfLongDouble) {
  const ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 20; ++trial) expect_exact(model.nominal, random, 1e-3);
}

}  // namespace
}  // namespace halyard
