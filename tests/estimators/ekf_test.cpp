#include "estimators/filters/ekf.h"

#include <gtest/gtest.h>

#include <limits>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"
#include "tests/support/linear_gaussian.h"

namespace halyard {
namespace {

TEST(Ekf, IsTheKalmanFilterOnALinearProblem) {
  ExtendedKalmanFilter filter;
  // Roundings of numbers up to 10, 2e-15 each, forgotten within a few steps. Observed: 1e-15.
  EXPECT_LT(largest_difference(filter, LinearGaussian(200), true), 1e-14);
}

TEST(Ekf, InnovationsAreConsistentAtTheRightNoiseAndNotAtAWrongOne) {
  const LinearGaussian problem(2000);
  ExtendedKalmanFilter filter;
  // χ² of 4000 degrees of freedom, divided by them: standard deviation √(2 / 4000) = 0.022; four of them.
  EXPECT_NEAR(normalised_nis(filter, problem, 1), 1, 0.09);
  EXPECT_GT(normalised_nis(filter, problem, 0.5), 1.09);
  EXPECT_LT(normalised_nis(filter, problem, 2), 0.91);
}

/// x' = x², z = x: the linearisation is 2x.
class Square final : public DiscreteProcess {
 public:
  void advance(Eigen::MatrixXd& X) const override { X = X.cwiseProduct(X).eval(); }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    F = 2 * x;
    x(0) *= x(0);
  }
  std::string name_of(int) const override { return "the square at 1 s"; }
};

TEST(Ekf, LinearisesAtTheOldMean) {
  ExtendedKalmanFilter filter;
  filter.reset(Eigen::VectorXd::Constant(1, 3), Eigen::MatrixXd::Constant(1, 1, 0.1));
  filter.predict(Square(), Eigen::MatrixXd::Constant(1, 1, 0.8));
  EXPECT_DOUBLE_EQ(filter.x()(0), 9);
  EXPECT_DOUBLE_EQ(filter.S()(0, 0), 1);  // √((6·0.1)² + 0.8²)
}

TEST(Ekf, ABeliefThatIsNotFiniteThrowsAndNamesTheState) {
  ExtendedKalmanFilter filter;
  filter.reset(Eigen::VectorXd::Constant(1, 1e200), Eigen::MatrixXd::Constant(1, 1, 1));
  try {
    filter.predict(Square(), Eigen::MatrixXd::Constant(1, 1, 1));
    FAIL() << "went on";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("the square at 1 s"), std::string::npos) << e.what();
  }
}

TEST(Ekf, RefusesAMeasurementThatIsNotFinite) {
  const LinearGaussian p(1);
  ExtendedKalmanFilter filter;
  filter.reset(p.x_0, initial_root());
  const Eigen::Vector2d z(std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_THROW(filter.update(LinearReadings(p.H, true), z, p.R_root, kNoGate), std::runtime_error);
}

TEST(Ekf, FindsTheJointsOfTheArmFromMotorSignals) {
  const ArmModel model = raven2();
  const ArmRun run = run_arm(model, 3);
  const auto ekf = make_ekf(model, {}), kinematics = make_kinematics(model, {});
  const Eigen::VectorXd filtered = rms_error(*ekf, run, 0.5), naive = rms_error(*kinematics, run, 0.5);
  // The model is the truth: what is left is the encoders' rounding, against the stretch of the cables.
  for (int k = 0; k < 3; ++k) EXPECT_LT(filtered(k), 0.1 * naive(k)) << "joint " << k + 1;
}

TEST(Ekf, FindsTheJointsOfTheSecondSimulator) {
  for (const std::string log : {"clean-1", "clean-2"}) {
    const ArmRun run = rig_run(log + "/holdout.csv", 3);
    if (run.samples.empty()) GTEST_SKIP() << "shared data not found: rig/" << log;
    const auto ekf = make_ekf(raven2(), {});
    const Eigen::VectorXd rms = rms_error(*ekf, run, 0.5);
    // 0.004 deg, 0.015 deg, 0.02 mm are asked for; 0.0013, 0.0015, 0.0015 were observed, the joint encoders' rounding.
    EXPECT_LT(rms(0), 0.004 * M_PI / 180) << log;
    EXPECT_LT(rms(1), 0.015 * M_PI / 180) << log;
    EXPECT_LT(rms(2), 0.02e-3) << log;
  }
}

TEST(Ekf, AStateWithoutDoubtHasNoBackwardGain) {
  ExtendedKalmanFilter filter;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(2, 2), Q_root = S;
  S(0, 0) = 3;
  Q_root(0, 0) = 4;
  const Eigen::Vector2d x(1, 2);
  filter.reset(x, S);
  const LaneMatrix S_0 = filter.root();
  filter.predict(LinearProcess(Eigen::Matrix2d::Identity()), Q_root);
  BackwardStep step;
  filter.backward_step(x, S_0, step);
  EXPECT_DOUBLE_EQ(step.G.view()(0, 0), 9.0 / 25);  // of the variance after it, what was there before
  EXPECT_EQ(step.G.view()(0, 1), 0);
  EXPECT_EQ(step.G.view()(1, 0), 0);
  EXPECT_EQ(step.G.view()(1, 1), 0);
}

}  // namespace
}  // namespace halyard
