#include "model/rigid_chain.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "model/model_file.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

class Raven2Chain : public ::testing::Test {
 protected:
  const ArmParameters<double> arm = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml").nominal;
  const double q[3] = {30 * M_PI / 180, 90 * M_PI / 180, 0.40};
  const double rest[3] = {0, 0, 0};
};

// The check values of an independent Newton-Euler derivation; the tolerance is half a unit of the last digit printed.

TEST_F(Raven2Chain, MassMatrixHasTheCheckValues) {
  double M[kMaxJoints][kMaxJoints];
  mass_matrix(arm, chain_pose(arm, q), M);
  EXPECT_NEAR(M[0][0], 0.148012, 0.5e-6);
  EXPECT_NEAR(M[0][1], 0.021593, 0.5e-6);
  EXPECT_NEAR(M[0][2], -0.007846, 0.5e-6);
  EXPECT_NEAR(M[1][1], 0.080530, 0.5e-6);
  EXPECT_NEAR(M[1][2], 0.0000641, 0.5e-7);
  EXPECT_NEAR(M[2][2], 0.407, 1e-15);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(M[r][c], M[c][r]);
}

TEST_F(Raven2Chain, HoldingForceHasTheCheckValues) {
  double force[3];
  inverse_dynamics(arm, chain_pose(arm, q), rest, rest, force);
  EXPECT_NEAR(force[0], -0.402541, 0.5e-6);
  EXPECT_NEAR(force[1], -0.545831, 0.5e-6);
  EXPECT_NEAR(force[2], 3.7496, 0.5e-4);
}

TEST_F(Raven2Chain, VelocityForceHasTheCheckValues) {
  const double v[3] = {0.5, -0.4, 0.1};
  double moving[3], holding[3];
  inverse_dynamics(arm, chain_pose(arm, q), v, rest, moving);
  inverse_dynamics(arm, chain_pose(arm, q), rest, rest, holding);
  EXPECT_NEAR(moving[0] - holding[0], 0.00926842, 0.5e-8);
  EXPECT_NEAR(moving[1] - holding[1], -0.00143779, 0.5e-8);
  EXPECT_NEAR(moving[2] - holding[2], -0.0441737, 0.5e-7);
}

TEST_F(Raven2Chain, InverseDynamicsIsMassTimesAccelerationPlusBias) {
  const double v[3] = {0.5, -0.4, 0.1}, a[3] = {2, -3, 1};
  double M[kMaxJoints][kMaxJoints], force[3], bias[3];
  const auto pose = chain_pose(arm, q);
  mass_matrix(arm, pose, M);
  inverse_dynamics(arm, pose, v, a, force);
  inverse_dynamics(arm, pose, v, rest, bias);
  for (int r = 0; r < 3; ++r) {
    const double expected = bias[r] + M[r][0] * a[0] + M[r][1] * a[1] + M[r][2] * a[2];
    // Sums of about 60 products, the largest of them forces of 10 N at arms of 0.5 m.
    EXPECT_NEAR(force[r], expected, 60 * 5 * kEps);
  }
}

TEST_F(Raven2Chain, KineticEnergyChangesByThePowerOfTheJointForces) {
  // Without gravity d/dt (v'Mv / 2) = v'F: M's change along the motion is what the velocity forces account for.
  ArmParameters<double> weightless = arm;
  for (double& g : weightless.gravity) g = 0;
  const double v[3] = {0.5, -0.4, 0.1}, a[3] = {2, -3, 1};
  double force[3];
  inverse_dynamics(weightless, chain_pose(weightless, q), v, a, force);
  const auto energy_at = [&](double t) {
    double q_t[3], v_t[3], M[kMaxJoints][kMaxJoints], sum = 0;
    for (int k = 0; k < 3; ++k) q_t[k] = q[k] + v[k] * t + 0.5 * a[k] * t * t, v_t[k] = v[k] + a[k] * t;
    mass_matrix(weightless, chain_pose(weightless, q_t), M);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) sum += 0.5 * M[r][c] * v_t[r] * v_t[c];
    return sum;
  };
  const double h = 1e-5;
  const double change = (energy_at(h) - energy_at(-h)) / (2 * h);
  // Central difference: h² times a third derivative of the order of 10, and rounding of 0.03 J over 2h.
  EXPECT_NEAR(change, force[0] * v[0] + force[1] * v[1] + force[2] * v[2], 10 * h * h + 0.03 * kEps / h);
}

TEST(LdlFactor, SolvesWhatCholeskySolves) {
  constexpr int n = 5;
  Eigen::MatrixXd B(n, n);
  B << 4, 1, 0, 2, 1, 1, 5, 1, 0, 3, 0, 1, 6, 1, 0, 2, 0, 1, 7, 1, 1, 3, 0, 1, 8;
  const Eigen::MatrixXd A = B * B.transpose();
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1, 2);
  double factor[n][kMaxJoints];
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) factor[r][c] = A(r, c);
  double x[n];
  for (int i = 0; i < n; ++i) x[i] = b(i);
  ldl_factor<double, kMaxJoints>(n, factor);
  ldl_solve<double, kMaxJoints>(n, factor, x);
  const Eigen::VectorXd expected = A.llt().solve(b);
  const double condition = A.norm() * A.inverse().norm();
  for (int i = 0; i < n; ++i) EXPECT_NEAR(x[i], expected(i), 10 * condition * kEps * expected.norm());
}

}  // namespace
}  // namespace halyard
