#include "estimators/matrix/phi_functions.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "tests/support/limits.h"

namespace halyard {
namespace {

/// An oscillator of two masses with a stiff damper, in units of very different size; h A.
Eigen::MatrixXd stiff_oscillator(double unit) {
  Eigen::MatrixXd Z(4, 4);
  Z << 0, 1, 0, 0, -2, -8, 1.5, 3, 0, 0, 0, 1, 0.5, 1, -0.7, -0.2;
  const Eigen::Vector4d scale(1, unit, unit * unit, 1 / unit);
  return scale.asDiagonal() * Z * scale.cwiseInverse().asDiagonal();
}

Eigen::MatrixXd phi_1(PhiFunctions& phi) {
  const Eigen::Index n = phi.E().rows();
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index i = 0; i < n; ++i) all.col(i) = phi.phi_1_times(Eigen::VectorXd::Unit(n, i));
  return all;
}
Eigen::MatrixXd phi_3(PhiFunctions& phi) {
  const Eigen::Index n = phi.E().rows();
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index i = 0; i < n; ++i) all.col(i) = phi.phi_3_times(Eigen::VectorXd::Unit(n, i));
  return all;
}

TEST(PhiFunctions, TheExponentialIsThatOfEigen) {
  PhiFunctions phi;
  const Eigen::MatrixXd Z = stiff_oscillator(1);
  ASSERT_TRUE(phi.compute(Z));
  // The polynomial's remainder, 5e-12 at most, doubled five times.
  EXPECT_LT((phi.E().view() - Z.exp()).cwiseAbs().maxCoeff(), 1e-9);
  for (int k = 1; k <= phi.doublings(); ++k)
    EXPECT_LT((phi.level(k).E.view() - (std::exp2(-k) * Z).exp()).cwiseAbs().maxCoeff(), 1e-9) << k;
  EXPECT_GT(phi.doublings(), 2);
}

TEST(PhiFunctions, SatisfyTheirRecurrence) {
  PhiFunctions phi;
  const Eigen::MatrixXd Z = stiff_oscillator(1), I = Eigen::MatrixXd::Identity(4, 4);
  ASSERT_TRUE(phi.compute(Z));
  // As above, times the norm of Z, 11.
  EXPECT_LT((Z * phi_1(phi) - (phi.E().view() - I)).norm(), 1e-8);
  EXPECT_LT((Z * phi.phi_2().view() - (phi_1(phi) - I)).norm(), 1e-8);
  EXPECT_LT((Z * phi_3(phi) - (phi.phi_2().view() - 0.5 * I)).norm(), 1e-8);
}

TEST(PhiFunctions, DoNotDependOnTheUnitsOfTheStates) {
  const double unit = 1 << 10;
  const Eigen::MatrixXd Z = stiff_oscillator(unit);
  PhiFunctions phi, plain;
  phi.balance(Z);
  ASSERT_TRUE(phi.compute(Z));
  ASSERT_TRUE(plain.compute(stiff_oscillator(1)));
  const Eigen::Vector4d scale(1, unit, unit * unit, 1 / unit);
  const Eigen::MatrixXd back = scale.cwiseInverse().asDiagonal() * phi_1(phi) * scale.asDiagonal();
  EXPECT_LT((back - phi_1(plain)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PhiFunctions, OfZeroAreTheReciprocalFactorials) {
  PhiFunctions phi;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(3, 3);
  ASSERT_TRUE(phi.compute(Eigen::MatrixXd::Zero(3, 3)));
  EXPECT_LT((phi.E().view() - I).norm(), 10 * kEps);
  EXPECT_LT((phi_1(phi) - I).norm(), 10 * kEps);
  EXPECT_LT((phi.phi_2().view() - I / 2).norm(), 10 * kEps);
  EXPECT_LT((phi_3(phi) - I / 6).norm(), 10 * kEps);
}

TEST(PhiFunctions, RefuseAMatrixThatIsNotFiniteOrTooLarge) {
  PhiFunctions phi;
  EXPECT_FALSE(phi.compute(Eigen::MatrixXd::Constant(2, 2, kNan)));
  EXPECT_FALSE(phi.compute(Eigen::MatrixXd::Constant(2, 2, 1e9)));
}

}  // namespace
}  // namespace halyard
