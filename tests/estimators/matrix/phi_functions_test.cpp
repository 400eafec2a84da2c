#include "estimators/matrix/phi_functions.h"

#include <gtest/gtest.h>

#include <random>
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

/// Of a matrix without a special form.
bool compute(PhiFunctions& phi, const Eigen::MatrixXd& Z) {
  const int n = static_cast<int>(Z.rows());
  return phi.compute(1, Z, {n, 0, n});
}

TEST(PhiFunctions, TheExponentialIsThatOfEigen) {
  PhiFunctions phi;
  const Eigen::MatrixXd Z = stiff_oscillator(1);
  ASSERT_TRUE(compute(phi, Z));
  // The polynomial's remainder, 2e-8 at most, doubled three times.
  EXPECT_LT((phi.level(0).E.view() - Z.exp()).cwiseAbs().maxCoeff(), 1e-7);
  for (int k = 1; k <= phi.doublings(); ++k)
    EXPECT_LT((phi.level(k).E.view() - (std::exp2(-k) * Z).exp()).cwiseAbs().maxCoeff(), 1e-7) << k;
  EXPECT_GT(phi.doublings(), 1);
}

TEST(PhiFunctions, SatisfyTheirRecurrence) {
  PhiFunctions phi;
  const Eigen::MatrixXd Z = stiff_oscillator(1), I = Eigen::MatrixXd::Identity(4, 4);
  ASSERT_TRUE(compute(phi, Z));
  // As above, times the norm of Z, 11.
  EXPECT_LT((Z * phi.level(0).phi_1.view() - (phi.level(0).E.view() - I)).norm(), 1e-6);
  EXPECT_LT((Z * phi.level(0).phi_2.view() - (phi.level(0).phi_1.view() - I)).norm(), 1e-6);
  EXPECT_LT((Z * phi.level(0).phi_3.view() - (phi.level(0).phi_2.view() - 0.5 * I)).norm(), 1e-6);
}

/// p kinematic rows, moving rows up to `end`, and constant states.
Eigen::MatrixXd mechanical(const PhiShape& shape) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd Z = Eigen::MatrixXd::NullaryExpr(shape.n, shape.n, [&] { return uniform(random); });
  Z.topRows(shape.first).setZero();
  Z.bottomRows(shape.n - shape.end).setZero();
  for (int i = 0; i < shape.first; ++i) Z(i, shape.first + i) = 0.8;
  return Z;
}

TEST(PhiFunctions, UseTheFormOfAMechanicalSystem) {
  for (const PhiShape& shape :
       {PhiShape{12, 6, 12}, {15, 6, 12}, {18, 6, 12}, {13, 5, 11}, {16, 7, 16}, {28, 14, 28}}) {
    const Eigen::MatrixXd Z = mechanical(shape);
    PhiFunctions phi, general;
    ASSERT_TRUE(phi.compute(1, Z, shape));
    ASSERT_TRUE(compute(general, Z));
    EXPECT_EQ(phi.doublings(), general.doublings());
    const int m = shape.end - shape.first;
    // Entries of up to 100, with the roundings of three doublings.
    constexpr double kTolerance = 1e-11;
    for (int k = 0; k <= phi.doublings(); ++k) {
      const auto &part = phi.level(k), &whole = general.level(k);
      EXPECT_LT((part.E.view() - whole.E.view()).cwiseAbs().maxCoeff(), kTolerance) << shape.n << " " << k;
      EXPECT_LT((part.phi_1.view() - whole.phi_1.view().middleCols(shape.first, m)).cwiseAbs().maxCoeff(), kTolerance);
      EXPECT_LT((part.phi_2.view() - whole.phi_2.view().middleCols(shape.first, m)).cwiseAbs().maxCoeff(), kTolerance);
    }
    EXPECT_LT(
        (phi.level(0).phi_3.view() - general.level(0).phi_3.view().middleCols(shape.first, m)).cwiseAbs().maxCoeff(),
        kTolerance)
        << shape.n;
  }
}

TEST(PhiFunctions, DoNotDependOnTheUnitsOfTheStates) {
  const double unit = 1 << 10;
  const Eigen::MatrixXd Z = stiff_oscillator(unit);
  PhiFunctions phi, plain;
  phi.balance(Z);
  ASSERT_TRUE(compute(phi, Z));
  ASSERT_TRUE(compute(plain, stiff_oscillator(1)));
  const Eigen::Vector4d scale(1, unit, unit * unit, 1 / unit);
  const Eigen::MatrixXd back = scale.cwiseInverse().asDiagonal() * phi.level(0).phi_1.view() * scale.asDiagonal();
  EXPECT_LT((back - plain.level(0).phi_1.view()).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(PhiFunctions, OfZeroAreTheReciprocalFactorials) {
  PhiFunctions phi;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(3, 3);
  ASSERT_TRUE(compute(phi, Eigen::MatrixXd::Zero(3, 3)));
  EXPECT_LT((phi.level(0).E.view() - I).norm(), 10 * kEps);
  EXPECT_LT((phi.level(0).phi_1.view() - I).norm(), 10 * kEps);
  EXPECT_LT((phi.level(0).phi_2.view() - I / 2).norm(), 10 * kEps);
  EXPECT_LT((phi.level(0).phi_3.view() - I / 6).norm(), 10 * kEps);
}

TEST(PhiFunctions, DoNotDependOnWhatWasComputedBefore) {
  // Other sizes, other parts of the same size, and another matrix of the same parts.
  PhiFunctions again;
  for (const PhiShape& shape : {PhiShape{9, 4, 9}, {9, 4, 8}, {9, 3, 8}, {8, 3, 8}, {8, 3, 8}}) {
    const Eigen::MatrixXd Z = mechanical(shape);
    for (const double h : {1.0, 0.7}) {
      PhiFunctions fresh;
      ASSERT_TRUE(again.compute(h, Z, shape));
      ASSERT_TRUE(fresh.compute(h, Z, shape));
      EXPECT_EQ(again.level(0).E.view(), fresh.level(0).E.view()) << shape.n << shape.first << shape.end;
      EXPECT_EQ(again.level(0).phi_1.view(), fresh.level(0).phi_1.view()) << shape.n << shape.first << shape.end;
      EXPECT_EQ(again.level(0).phi_2.view(), fresh.level(0).phi_2.view()) << shape.n << shape.first << shape.end;
      EXPECT_EQ(again.level(0).phi_3.view(), fresh.level(0).phi_3.view()) << shape.n << shape.first << shape.end;
    }
  }
}

TEST(PhiFunctions, RefuseAMatrixThatIsNotFiniteOrTooLarge) {
  PhiFunctions phi;
  EXPECT_FALSE(compute(phi, Eigen::MatrixXd::Constant(2, 2, kNan)));
  EXPECT_FALSE(compute(phi, Eigen::MatrixXd::Constant(2, 2, 1e9)));
}

/// The functions of a number by their polynomials of degree 11 and so many doublings, in long double.
struct ScalarPhi {
  long double E, phi_1, phi_2, phi_3;

  ScalarPhi(double z, int doublings) {
    const long double y = std::ldexp(static_cast<long double>(z), -doublings);
    phi_3 = 0;
    long double term = 1.0L / 6;
    for (int i = 0; i <= 11; ++i) {  // y^i / (i + 3)!
      phi_3 += term;
      term *= y / (i + 4);
    }
    phi_2 = 0.5L + y * phi_3;
    phi_1 = 1 + y * phi_2;
    E = 1 + y * phi_1;
    for (int k = 0; k < doublings; ++k) {
      phi_3 = (E * phi_3 + phi_1 / 2 + phi_2 + phi_3) / 8;
      phi_2 = (E * phi_2 + phi_1 + phi_2) / 4;
      phi_1 = (E * phi_1 + phi_1) / 2;
      E *= E;
    }
  }
};

TEST(PhiFunctions, OfANumberAreTheirPolynomialsToRounding) {
  for (const double z : {-15.5, -7.7, -3.9, -1.2, 0.3, 1.9, 3.9, 7.7}) {
    PhiFunctions phi;
    ASSERT_TRUE(compute(phi, Eigen::MatrixXd::Constant(1, 1, z)));
    const ScalarPhi expected(z, phi.doublings());
    const auto check = [&](const LaneMatrix& found, long double exact) {
      // Some ten roundings of terms of the order of 1, which each doubling may double.
      EXPECT_NEAR(found.view()(0, 0), static_cast<double>(exact), 100 * kEps * std::max(1.0L, exact)) << z;
    };
    check(phi.level(0).E, expected.E);
    check(phi.level(0).phi_1, expected.phi_1);
    check(phi.level(0).phi_2, expected.phi_2);
    check(phi.level(0).phi_3, expected.phi_3);
  }
}

int doublings_of(const Eigen::MatrixXd& Z) {
  PhiFunctions phi;
  return compute(phi, Z) ? phi.doublings() : -1;
}

TEST(PhiFunctions, HalveTheirArgumentUntilItsSquareAndItsCubeAreThoseOfLessThanTwo) {
  const auto number = [](double z) { return Eigen::MatrixXd::Constant(1, 1, z).eval(); };
  EXPECT_EQ(doublings_of(number(0)), 1) << "once at least";
  EXPECT_EQ(doublings_of(number(-3.99)), 1);
  EXPECT_EQ(doublings_of(number(-4.01)), 2);
  EXPECT_EQ(doublings_of(number(-8.01)), 3);
  const auto with_square = [](double norm) {  // the cube is zero
    Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(3, 3);
    Z(0, 1) = Z(1, 2) = norm;
    return Z;
  };
  EXPECT_EQ(doublings_of(with_square(3.99)), 1);
  EXPECT_EQ(doublings_of(with_square(4)), 2);
  const auto with_cube = [](double norm) {  // the square is the unit matrix
    Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(2, 2);
    Z(0, 1) = norm;
    Z(1, 0) = 1 / norm;
    return Z;
  };
  EXPECT_EQ(doublings_of(with_cube(63.9)), 1);
  EXPECT_EQ(doublings_of(with_cube(64)), 2);
  const double most = std::exp2(PhiFunctions::kMostDoublings + 1);
  EXPECT_EQ(doublings_of(number(-0.99 * most)), PhiFunctions::kMostDoublings);
  EXPECT_EQ(doublings_of(number(-1.01 * most)), -1);
}

TEST(PhiFunctions, DistancesDoNotDependOnTheUnitsOfTheStates) {
  constexpr double kUnit = 1024;  // of the first state over those of the others
  Eigen::MatrixXd A(3, 3);
  A << 100, kUnit, 7, 1 / kUnit, 100, 0, 0, 0, 0;
  PhiFunctions phi;
  phi.balance(A);
  EXPECT_EQ(phi.distance(A, A), 0);
  Eigen::MatrixXd above = A, below = A;
  above(0, 1) -= 0.25 * kUnit;
  below(1, 0) += 0.5 / kUnit;
  EXPECT_EQ(phi.distance(A, above), 0.25);
  EXPECT_EQ(phi.distance(A, below), 0.5);
  below(2, 2) = kNan;
  EXPECT_TRUE(std::isnan(phi.distance(A, below)));
}

}  // namespace
}  // namespace halyard
