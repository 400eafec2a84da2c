/// The integral of a curvature that falls within a step, against its closed forms.

#include "estimators/matrix/mean_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/estimators/matrix/lane_matrices.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

/// The shift of one state with x' = a x over a step of length 1, by the functions of `level`, from m(0) to m(1).
double shift_of(double a, double from, double to, int level = 0) {
  const PhiShape shape{1, 0, 1};
  PhiFunctions phi;
  EXPECT_TRUE(phi.compute(std::exp2(level), Eigen::MatrixXd::Constant(1, 1, a), shape));
  MeanShift mean_shift(shape);
  LaneMatrix shift;
  const auto number = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  constexpr double kDeviation = 0.3;
  mean_shift.compute(phi, level, in_lanes(Eigen::MatrixXd::Constant(1, 1, kDeviation)),
                     number(std::pow(kDeviation * std::exp(a), 2)), number(from), number(to), shift);
  return shift.view()(0, 0);
}

double phi_1(double z) { return std::expm1(z) / z; }
double phi_2(double z) { return (phi_1(z) - 1) / z; }

TEST(MeanShift, OfACurvatureThatStaysIsThatOfAConstantForce) {
  for (const double a : {-6.0, -1.5, -0.2, 0.7})
    for (const int level : {0, 1}) EXPECT_NEAR(shift_of(a, 2, 2, level), 2 * phi_1(a), 1e-7) << a;
}

TEST(MeanShift, WhereDeviationsDoNotFallTheCurvatureGoesStraight) {
  // ∫ exp(a (1 - s)) (m_0 + (m_1 - m_0) s) ds
  for (const double a : {0.4, 1.0, 2.5}) EXPECT_NEAR(shift_of(a, 3, 1), 3 * phi_1(a) + (1 - 3) * phi_2(a), 1e-6) << a;
}

TEST(MeanShift, WhereTheyFallItFollowsTheSquareOfTheDeviations) {
  // With V(s) = exp(2 a s) the integral is φ_1 (m_1 + (m_0 - m_1) exp(a) / (1 + exp(a))).
  for (const double a : {-0.5, -2.0, -4.4, -9.0})
    for (const int level : {0, 1}) {
      const double exact = phi_1(a) * (1 + (5 - 1) * std::exp(a) / (1 + std::exp(a)));
      // Simpson's mean in each part of the step, and straight lines between them.
      EXPECT_NEAR(shift_of(a, 5, 1, level), exact, 0.02 * exact) << a << ", level " << level;
    }
}

TEST(MeanShift, OfAPositionIsTheIntegralOfItsRates) {
  // q' = v, v' = a v: with a constant curvature of v the shift of q is φ_2, and a constant state has none.
  const PhiShape shape{3, 1, 2};
  constexpr double kRate = -3;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3), S = 0.1 * Eigen::MatrixXd::Identity(3, 3);
  A(0, 1) = 1, A(1, 1) = kRate, A(1, 2) = 0.5;
  PhiFunctions phi;
  ASSERT_TRUE(phi.compute(1, A, shape));
  LaneMatrix shift;
  const Eigen::Vector3d m(0, 2, 0);
  const Eigen::VectorXd end_squares = (phi.level(0).E.view() * S).rowwise().squaredNorm();
  MeanShift(shape).compute(phi, 0, in_lanes(S.transpose()), end_squares, m, m, shift);
  EXPECT_NEAR(shift.view()(0, 0), 2 * phi_2(kRate), 1e-7);
  EXPECT_NEAR(shift.view()(1, 0), 2 * phi_1(kRate), 1e-7);
  EXPECT_EQ(shift.view()(2, 0), 0);
}

TEST(MeanShift, OfSeveralStatesIsThatOfEach) {
  // Two positions whose rates fall alone, so fast that both take the same number of halves.
  const PhiShape shape{4, 2, 4};
  const Eigen::Vector2d a(-9, -8.5), from(5, 2), to(1, 3);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4), S = 0.3 * Eigen::MatrixXd::Identity(4, 4);
  for (int k = 0; k < 2; ++k) A(k, 2 + k) = 1, A(2 + k, 2 + k) = a(k);
  PhiFunctions phi;
  ASSERT_TRUE(phi.compute(1, A, shape));
  ASSERT_EQ(phi.doublings(), 3);
  Eigen::VectorXd first = Eigen::VectorXd::Zero(4), last = first;
  first.tail(2) = from;
  last.tail(2) = to;
  const Eigen::VectorXd end_squares = (phi.level(0).E.view() * S).rowwise().squaredNorm();
  LaneMatrix shift;
  MeanShift(shape).compute(phi, 0, in_lanes(S.transpose()), end_squares, first, last, shift);
  // Roundings of numbers of the order of 1.
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(shift.view()(2 + k, 0), shift_of(a(k), from(k), to(k)), 1e-12) << k;
}

TEST(MeanShift, OfAStateThatIsCertainGoesStraight) {
  const PhiShape shape{1, 0, 1};
  constexpr double kRate = -1.5;
  PhiFunctions phi;
  ASSERT_TRUE(phi.compute(1, Eigen::MatrixXd::Constant(1, 1, kRate), shape));
  const Eigen::VectorXd certain = Eigen::VectorXd::Zero(1), from = Eigen::VectorXd::Constant(1, 3),
                        to = Eigen::VectorXd::Constant(1, 1);
  LaneMatrix shift;
  MeanShift(shape).compute(phi, 0, in_lanes(Eigen::MatrixXd::Zero(1, 1)), certain, from, to, shift);
  // As where deviations do not fall.
  EXPECT_NEAR(shift.view()(0, 0), 3 * phi_1(kRate) + (1 - 3) * phi_2(kRate), 1e-6);
}

}  // namespace
}  // namespace halyard
