/// Linearisation and curvature of an arm whose transmission is plain, with unknown constants.

#include <gtest/gtest.h>

#include <random>

#include "estimators/filters/camera_filter.h"
#include "estimators/filters/disturbance_filter.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

/// The RAVEN-II with an unknown force and an unknown offset of each joint: 18 states.
ArmModel with_constants() {
  const ArmModel model = raven2();
  const EstimatorOptions none;
  OptionReader reader("the test", none);
  return with_unknown_offsets(with_unknown_forces(model, read_force_levels(reader, model)),
                              read_camera_options(reader, model));
}

/// A state in motion, within the smoothing speeds of friction, with constants that are not zero.
struct Point {
  ProcessModel process;
  Step step{0, 1e-3};
  Eigen::VectorXd x, f;
  Eigen::MatrixXd A;
  LinearisedPoint found;

  explicit Point(const ArmModel& model) : process(model) {
    const StateLayout& l = process.layout();
    x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home());
    for (int k = 0; k < 3; ++k) {
      x(l.rate[k]) = 3e-3 * (k - 0.5);
      x(*l.motor_rate[k]) = 0.2 * (1 - k);
    }
    for (int i = l.effect_states; i < l.size; ++i) x(i) = 1e-4 * (i + 1 - l.effect_states);
    process.linearise(step, x, nullptr, f, A, found);
  }
  Eigen::VectorXd rates(const Eigen::VectorXd& at) const { return process.derivative(step, at); }
};

TEST(ArmCurvature, UnknownConstantsHaveTheirSlopes) {
  const Point p(with_constants());
  ASSERT_TRUE(p.process.is_smooth());
  for (int i = p.process.layout().effect_states; i < p.process.n_states(); ++i) {
    const Eigen::VectorXd change = 1e-4 * Eigen::VectorXd::Unit(p.process.n_states(), i);
    const Eigen::VectorXd slope = (p.rates(p.x + change) - p.rates(p.x - change)) / 2e-4;
    // The cables are linear within 1e-7; rates of up to 1e4 are rounded.
    EXPECT_LT((p.A.col(i) - slope).norm(), 1e-6 * slope.norm() + 1e-7) << i;
    EXPECT_GT(slope.norm(), 0) << i;
  }
}

TEST(ArmCurvature, IsTheMeanOfWhatNarrowDeviationsAdd) {
  for (const ArmModel& model : {raven2(), with_constants()}) {
    Point p(model);
    const int n = p.process.n_states();
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd S = 1e-3 * Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    LaneMatrix root;
    root.set_zero(n, n);
    root.view() = S.transpose();
    constexpr double kSpread = 1e-2;
    Eigen::VectorXd mean, exact = Eigen::VectorXd::Zero(n);
    p.process.mean_curvature(p.found, nullptr, p.x, p.f, p.A, kSpread, root, mean);
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd d = kSpread * S.col(i);
      exact += (p.rates(p.x + d) - p.f + (p.rates(p.x - d) - p.f)) / (2 * n);
    }
    for (int i = 0; i < n; ++i)
      // Terms of fourth order: the spread's square times a few. Rates of up to 1e4 are rounded.
      EXPECT_NEAR(mean(i), exact(i), 1e-3 * std::abs(exact(i)) + 1e-10) << i << " of " << n;
    LinearisedPoint near = p.found;
    Eigen::VectorXd again;
    p.process.mean_curvature(near, &p.found, p.x, p.f, p.A, kSpread, root, again);
    EXPECT_EQ(again, mean);
  }
}

TEST(ArmCurvature, RatesNearbyFollowFrictionFarAndTheChainLinearly) {
  const Point p(with_constants());
  const StateLayout& l = p.process.layout();
  LaneMatrix D, rates;
  D.set_zero(6, p.process.n_states());
  for (int k = 0; k < 3; ++k) {
    D.view()(k, l.rate[k]) = 5e-3;  // as far as friction's smoothing speed
    D.view()(3 + k, *l.motor_rate[k]) = 0.5;
  }
  p.process.rates_nearby(p.found, p.x, p.f, p.A, D, rates);
  double farthest = 0;  // of the tangent from the model, relative
  for (int i = 0; i < D.rows(); ++i) {
    const Eigen::VectorXd d = D.view().row(i), exact = p.rates(p.x + d);
    // The chain's forces of second order in 5 mrad/s.
    EXPECT_LT((rates.view().row(i).transpose() - exact).norm(), 1e-4 * (exact - p.f).norm()) << i;
    farthest = std::max(farthest, (p.A * d - (exact - p.f)).norm() / (exact - p.f).norm());
  }
  EXPECT_GT(farthest, 0.05);
}

TEST(ArmCurvature, AnEffectBetweenCommandAndJointIsNotPlain) {
  ArmModel model = raven2();
  model.effects.push_back(place_effect(*find_effect("encoder_offset"), model.nominal, 1));
  EXPECT_TRUE(ProcessModel(model).is_smooth());
  model.effects.push_back(place_effect(*find_effect("backlash"), model.nominal, 1));
  EXPECT_FALSE(ProcessModel(model).is_smooth());
}

}  // namespace
}  // namespace halyard
