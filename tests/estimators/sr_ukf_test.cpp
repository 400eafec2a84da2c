#include "estimators/filters/sr_ukf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "tests/support/linear_gaussian.h"

namespace halyard {
namespace {

TEST(SrUkf, IsTheKalmanFilterOnALinearProblem) {
  const LinearGaussian problem(200);
  for (const double alpha : {1e-3, 0.1, 1.0}) {
    for (const bool admits_linearity : {true, false}) {
      SquareRootUkf filter({.alpha = alpha});
      // A spread of α √n σ between numbers of up to 10 is good to 1e-15 / α, 1e-12 for the paper's α, and the
      // covariance with it; a few such errors are not forgotten yet. Observed: 7e-16 / α to 2e-15 / α.
      EXPECT_LT(largest_difference(filter, problem, admits_linearity), 1e-14 / alpha) << alpha << admits_linearity;
      EXPECT_EQ(filter.repaired(), 0);
    }
  }
}

TEST(SrUkf, InnovationsAreConsistentAtTheRightNoiseAndNotAtAWrongOne) {
  const LinearGaussian problem(2000);
  SquareRootUkf filter;
  // As for the EKF: four standard deviations of χ² / 4000.
  EXPECT_NEAR(normalised_nis(filter, problem, 1), 1, 0.09);
  EXPECT_GT(normalised_nis(filter, problem, 0.5), 1.09);
  EXPECT_LT(normalised_nis(filter, problem, 2), 0.91);
}

/// y = x² of one state, as process and as measurement.
class Square final : public DiscreteProcess, public MeasurementModel {
 public:
  void advance(Eigen::MatrixXd& X) const override { X = X.cwiseProduct(X).eval(); }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    F = 2 * x;
    x(0) *= x(0);
  }
  std::string name_of(int) const override { return "the square at 1 s"; }
  bool is_affine() const override { return false; }
  void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    z = x.cwiseProduct(x);
  }
  void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                 Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = 2 * x;
    read(x, z);
  }
};

TEST(SrUkf, GivesMeanAndVarianceOfASquareExactly) {
  // E x² = m² + σ², var x² = 4 m² σ² + 2 σ⁴ for a Gaussian: β = 2 makes the fourth moment right, up to α².
  const double m = 3, sigma = 0.5;
  for (const double alpha : {1e-3, 0.5}) {
    SquareRootUkf filter({.alpha = alpha});
    filter.reset(Eigen::VectorXd::Constant(1, m), Eigen::MatrixXd::Constant(1, 1, sigma));
    filter.predict(Square(), Eigen::MatrixXd::Zero(1, 1));
    // 9 is good to 1e-15, its second difference over α σ of it to 1e-15 / α².
    const double rounding = 10 * 9 * kEps / (alpha * alpha);
    EXPECT_NEAR(filter.x()(0), m * m + sigma * sigma, rounding);
    const double variance = 4 * m * m * sigma * sigma + 2 * std::pow(sigma, 4);
    EXPECT_NEAR(std::pow(filter.S()(0, 0), 2), variance, 10 * rounding + 1e-12);
  }
}

TEST(SrUkf, ASmallerBetaTakesTheSquaresOwnVarianceAway) {
  // The fourth moment counts β times: 4 m² σ² + β σ⁴. Below α², β takes it from the covariance by a down-date.
  const double m = 3, sigma = 0.5;
  for (const double beta : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    SquareRootUkf filter({.alpha = 1, .beta = beta});
    filter.reset(Eigen::VectorXd::Constant(1, m), Eigen::MatrixXd::Constant(1, 1, sigma));
    filter.predict(Square(), Eigen::MatrixXd::Zero(1, 1));
    EXPECT_NEAR(std::pow(filter.S()(0, 0), 2), 4 * m * m * sigma * sigma + beta * std::pow(sigma, 4), 100 * 9 * kEps)
        << beta;
    EXPECT_EQ(filter.repaired(), 0) << beta;
  }
}

TEST(SrUkf, AMeasurementThroughSigmaPointsSeesItsCurvature) {
  const double m = 3, sigma = 0.5, r = 0.2;
  SquareRootUkf filter;
  filter.reset(Eigen::VectorXd::Constant(1, m), Eigen::MatrixXd::Constant(1, 1, sigma));
  const Innovation innovation =
      filter.update(Square(), Eigen::VectorXd::Constant(1, 10), Eigen::MatrixXd::Constant(1, 1, r), kNoGate);
  const double S = 4 * m * m * sigma * sigma + 2 * std::pow(sigma, 4) + r * r, K = 2 * m * sigma * sigma / S;
  const double rounding = 1e-7;  // 10 · 9 eps / α², through the gain
  EXPECT_NEAR(innovation.nu(0), 10 - m * m - sigma * sigma, rounding);
  EXPECT_NEAR(std::pow(innovation.S_root(0, 0), 2), S, 10 * rounding);
  EXPECT_NEAR(filter.x()(0), m + K * innovation.nu(0), rounding);
  EXPECT_NEAR(std::pow(filter.S()(0, 0), 2), sigma * sigma - K * K * S, rounding);
}

TEST(SrUkf, ADownDateThatLosesDefinitenessIsRepairedAndCounted) {
  // β = 0 at m = 0 with α = 1: P = σ⁴ - σ⁴ = 0, and with rounding or Q = 0 less.
  SquareRootUkf filter({.alpha = 1.5, .beta = 0});
  filter.reset(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1));
  filter.predict(Square(), Eigen::MatrixXd::Zero(1, 1));
  EXPECT_EQ(filter.repaired(), 1);
  EXPECT_TRUE(std::isfinite(filter.S()(0, 0)));
  EXPECT_GT(filter.S()(0, 0), 0);
}

TEST(SrUkf, ABeliefThatIsNotFiniteThrowsAndNamesTheState) {
  SquareRootUkf filter;
  filter.reset(Eigen::VectorXd::Constant(1, 1e200), Eigen::MatrixXd::Constant(1, 1, 1));
  try {
    filter.predict(Square(), Eigen::MatrixXd::Constant(1, 1, 1));
    FAIL() << "went on";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("the square at 1 s"), std::string::npos) << e.what();
  }
}

TEST(SrUkf, PaperWeightsDoNotLoseAMotorAngleOf431Rad) {
  // The same motor near 0 and near 431 rad: x' = x + dt v, v' = 0.99 v.
  Eigen::Matrix2d F, Q_root;
  F << 1, 1e-3, 0, 0.99;
  Q_root << 1e-5, 0, 0, 1e-2;
  Eigen::MatrixXd H(1, 2), R_root(1, 1);
  H << 1, 0;
  R_root << 4.5e-4;
  for (const bool affine : {true, false}) {
    SquareRootUkf near, far;
    const double offset = 431;
    const Eigen::MatrixXd S = Eigen::Vector2d(1e-3, 1e-1).asDiagonal();
    near.reset(Eigen::Vector2d(0, 1), S);
    far.reset(Eigen::Vector2d(offset, 1), S);
    double largest = 0;
    for (int i = 1; i <= 2000; ++i) {
      const Eigen::VectorXd z = Eigen::VectorXd::Constant(1, 0.3 * std::sin(i * 1e-3));
      for (SquareRootUkf* filter : {&near, &far}) filter->predict(LinearProcess(F), Q_root);
      near.update(LinearReadings(H, affine), z, R_root, kNoGate);
      far.update(LinearReadings(H, affine), z.array() + offset, R_root, kNoGate);
      largest = std::max(largest, std::abs(far.x()(0) - offset - near.x()(0)));
    }
    // A sigma point at 431 rad is rounded to 2.8e-14, a spread of 1e-3 · 1e-4 rad between them to 3e-7 of itself; the
    // gain with it, on innovations of 1e-3 rad. Weights whose sum is off by 8e-6 would be 3.6e-3 rad off.
    EXPECT_LT(largest, 1e-8) << affine;
  }
}

TEST(SrUkf, AKinkMovesTheMeanByNoMoreThanTheLimitAllows) {
  // |x| at x = 0: E |x| = 0.8 σ, but points a thousandth of σ apart tell a curvature of 1 / α.
  class Fold final : public DiscreteProcess {
    void advance(Eigen::MatrixXd& X) const override { X = X.cwiseAbs().eval(); }
    void advance_with_jacobian(Eigen::VectorXd&, Eigen::MatrixXd&) const override {}
    std::string name_of(int) const override { return "fold"; }
  };
  const auto mean_after = [](const UkfWeights& weights) {
    SquareRootUkf filter(weights);
    filter.reset(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
    filter.predict(Fold(), Eigen::MatrixXd::Zero(1, 1));
    return filter.x()(0);
  };
  EXPECT_NEAR(mean_after({}), 1e3, 1e-6);  // the textbook's: 1 / α standard deviations off
  EXPECT_EQ(mean_after({.curvature_limit = 0.03}), 0);
}

/// x' = F x. Of pairs of sigma points it says that their mean moves by `shift` besides.
class LinearPairs final : public DiscreteProcess {
 public:
  LinearPairs(const Eigen::MatrixXd& F, const Eigen::VectorXd& shift) : F_(F), shift_(shift) {}
  void advance(Eigen::MatrixXd& X) const override { X = F_ * X; }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    x = F_ * x;
    F = F_;
  }
  bool advance_pairs(Eigen::VectorXd& x, const LaneMatrix& S, double gamma, LaneMatrix& FS,
                     Eigen::VectorXd& shift) const override {
    gamma_ = gamma;
    x = F_ * x;
    FS.view().leftCols(F_.cols()) = F_ * S.view();
    shift = shift_;
    return true;
  }
  std::string name_of(int state) const override { return "state " + std::to_string(state); }
  /// Of the pairs; 0: none were moved.
  double gamma() const { return gamma_; }

 private:
  Eigen::MatrixXd F_;
  Eigen::VectorXd shift_;
  mutable double gamma_ = 0;
};

TEST(SrUkf, MovesSigmaPointsInPairsWhereTheyAreNarrow) {
  const LinearGaussian p(1);
  for (const double gamma : {1e-3, 0.099, 0.101, 1.0}) {
    SquareRootUkf filter({.alpha = gamma / 2});  // γ² = α² n of four states
    filter.reset(p.x_0, initial_root());
    const LinearPairs process(p.F, Eigen::VectorXd::Zero(4));
    filter.predict(process, p.Q_root);
    EXPECT_DOUBLE_EQ(process.gamma(), gamma < 0.1 ? gamma : 0);
  }
}

TEST(SrUkf, WhatPairsMoveTheMeanByCountsForADeviationOfOneAndWidensTheBelief) {
  constexpr double kAlpha = 0.02, kBeta = 1.5, kKappa = 2, kSquare = kAlpha * kAlpha * (4 + kKappa);  // γ²
  const LinearGaussian p(1);
  const Eigen::Vector4d delta(0.1, -0.2, 0.05, 0.3);
  SquareRootUkf filter({.alpha = kAlpha, .beta = kBeta, .kappa = kKappa});
  filter.reset(p.x_0, initial_root());
  filter.predict(LinearPairs(p.F, kSquare / 4 * delta), p.Q_root);  // δ = W Σ d_i, of eight points
  const Eigen::MatrixXd P =
      p.F * p.F.transpose() + p.Q_root * p.Q_root.transpose() + (kBeta - kAlpha * kAlpha) * delta * delta.transpose();
  // A few roundings of numbers up to 10.
  EXPECT_LT((filter.x() - p.F * p.x_0 - delta).norm(), 20 * kEps);
  EXPECT_LT((filter.S() * filter.S().transpose() - P).norm(), 100 * kEps);
}

TEST(SrUkf, TheBackwardStepOfPairsIsThatOfTheKalmanSmoother) {
  const LinearGaussian p(1);
  Eigen::Matrix4d root;
  root << 2, 0, 0, 0, 0.3, 1, 0, 0, -0.2, 0.1, 3, 0, 0.4, -0.6, 0.2, 0.5;
  SquareRootUkf filter;
  filter.reset(p.x_0, root);
  const LaneMatrix S_0 = filter.root();
  const LinearPairs process(p.F, Eigen::VectorXd::Zero(4));
  filter.predict(process, p.Q_root);
  ASSERT_GT(process.gamma(), 0);
  BackwardStep step;
  filter.backward_step(p.x_0, S_0, step);
  const Eigen::MatrixXd P_0 = root * root.transpose();
  const Eigen::MatrixXd P = p.F * P_0 * p.F.transpose() + p.Q_root * p.Q_root.transpose();
  const Eigen::MatrixXd G = P.llt().solve(p.F * P_0).transpose(), V = step.V_root.view();
  // Roundings of numbers up to 10, through the inverse of P.
  EXPECT_LT((step.G.view() - G).norm(), 1e-12);
  EXPECT_LT((V * V.transpose() - (P_0 - G * P * G.transpose())).norm(), 1e-12);
}

TEST(SrUkf, WeightsWithoutSpreadAreRefused) {
  EXPECT_THROW(SquareRootUkf({.alpha = 0}), std::invalid_argument);
  const LinearGaussian p(1);
  SquareRootUkf filter({.kappa = -4});  // four states
  filter.reset(p.x_0, initial_root());
  EXPECT_THROW(filter.predict(LinearProcess(p.F), p.Q_root), std::invalid_argument);
}

}  // namespace
}  // namespace halyard
