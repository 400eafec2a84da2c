/// The dual filter on a linear arm, whose posterior is known: a slide on an elastic cable, without Coulomb friction or
/// gravity, whose motor's torque has an unknown bias.
///
///   x' = F x + b w + noise,   z = H x + noise,   w ~ N(0, 1)
///
/// There the filter with held weights is Friedland's separate-bias estimation, which is exact: its sums over a record
/// are those of the Kalman filter of [x, w]. (Friedland, IEEE Trans. Automatic Control 14, 1969.)

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/estimators/identification/linear_slide.h"

namespace halyard {
namespace {

constexpr double kBias = 0.01;  // N m, prior deviation of the torque's bias

/// A record of the slide with bias w.
std::vector<EncoderSample> record_of(const ArmModel& model, double w, int samples, unsigned seed) {
  ArmModel robot = model;
  robot.nominal.joint[0].torque_bias = kBias * w;
  return record_of_slide(robot, samples, seed);
}

DualUkf filter_of(const ArmModel& model, const DualUkfOptions& options) {
  return DualUkf(model, {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = kBias}}, options);
}

Eigen::VectorXd number(double x) { return Eigen::VectorXd::Constant(1, x); }

/// Mean and deviation of w by the sums of held weights.
struct Posterior {
  double mean, deviation;
};
Posterior by_held_weights(const ArmModel& model, const std::vector<EncoderSample>& record, double settle_s) {
  DualUkf filter = filter_of(model, {.learn = false, .settle = settle_s});
  double A = 1, g = 0;
  for (const EncoderSample& sample : record) {
    const DualStep step = filter.update(sample);
    if (step.nu.size() == 0) continue;
    const auto S = step.S_root.triangularView<Eigen::Lower>();
    const Eigen::VectorXd white = S.solve(step.Y.col(0));
    A += white.squaredNorm(), g += white.dot(S.solve(step.nu));
  }
  return {g / A, 1 / std::sqrt(A)};
}

/// The Kalman filter of [x, w], in extended precision, from the belief with which the dual filter starts.
Posterior by_augmented_filter(const ArmModel& model, const std::vector<EncoderSample>& record) {
  using Real = long double;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  ArmModel biased = model;
  biased.nominal.joint[0].torque_bias = kBias;
  const ProcessModel process(model), with_bias(biased);
  const StateLayout& l = process.layout();
  const JointParameters<double>& j = process.arm().joint[0];
  const int n = process.n_states();
  ArmNoise noise(model, process, noise_of_slide(model, process));

  Eigen::VectorXd start = Eigen::VectorXd::Zero(n);
  start(*l.motor_angle[0]) = record[0].motor_position(0);
  start(l.position[0]) = record[0].joint_position(0);
  Eigen::MatrixXd S_0 = noise.initial_root(start, INFINITY);
  S_0(l.rate[0], l.rate[0]) = model.joints[0].upper - model.joints[0].lower;
  S_0(*l.motor_rate[0], *l.motor_rate[0]) = S_0(l.rate[0], l.rate[0]) / j.motor_travel();

  Vector x = Vector::Zero(n + 1);
  x.head(n) = start.cast<Real>();
  Matrix P = Matrix::Identity(n + 1, n + 1), H = Matrix::Zero(2, n + 1), F = Matrix::Identity(n + 1, n + 1);
  P.topLeftCorner(n, n) = (S_0 * S_0.transpose()).cast<Real>();
  H(0, *l.motor_angle[0]) = H(1, l.position[0]) = 1;
  const Matrix R = encoder_noise_of_slide(model).cwiseAbs2().asDiagonal().toDenseMatrix().cast<Real>();

  for (std::size_t i = 1; i < record.size(); ++i) {
    Step step;
    step.time_s = record[i - 1].time_s;
    step.dt_s = record[i].time_s - step.time_s;
    step.motor_torque = record[i - 1].motor_torque.data();
    const Eigen::VectorXd before = x.head(n).cast<double>();
    Eigen::VectorXd after = before, after_biased = before;
    Eigen::MatrixXd F_x(n, n);
    process.advance_with_jacobian(step, after.data(), F_x);
    with_bias.advance(step, after_biased.data());
    F.topLeftCorner(n, n) = F_x.cast<Real>();
    F.topRightCorner(n, 1) = (after_biased - after).cast<Real>();
    const Matrix Q_root = noise.process_root(step, before).cast<Real>();
    x.head(n) = after.cast<Real>() + F.topRightCorner(n, 1) * x(n);
    P = (F * P * F.transpose()).eval();
    P.topLeftCorner(n, n) += Q_root * Q_root.transpose();

    const Vector z = (Vector(2) << record[i].motor_position(0), record[i].joint_position(0)).finished();
    const Eigen::Matrix<Real, 2, 2> S = H * P * H.transpose() + R;
    const Matrix K = P * H.transpose() * S.inverse();
    const Matrix rest = Matrix::Identity(n + 1, n + 1) - K * H;
    x += K * (z - H * x);
    P = (rest * P * rest.transpose() + K * R * K.transpose()).eval();
  }
  return {double(x(n)), double(std::sqrt(P(n, n)))};
}

TEST(DualUkfOnALinearArm, DerivativesAreTheExactChangeOfItsInnovations) {
  const ArmModel model = slide();
  const std::vector<EncoderSample> record = record_of(model, 0.7, 200, 1);
  DualUkf at_0 = filter_of(model, {.learn = false, .settle = 0}),
          at_1 = filter_of(model, {.learn = false, .settle = 0});
  at_1.set_weights(number(1), number(1));
  for (const EncoderSample& sample : record) {
    const DualStep a = at_0.update(sample), b = at_1.update(sample);
    ASSERT_EQ(a.nu.size(), b.nu.size());
    if (a.nu.size() == 0) continue;
    EXPECT_LT((a.S_root - b.S_root).norm(), 1e-8 * a.S_root.norm()) << sample.time_s;
    // Y is a difference over 1e-3 of readings of up to 1e3 rad: 1e3 · 4 eps / 1e-3, carried along for some steps.
    EXPECT_LT((a.nu - a.Y.col(0) - b.nu).cwiseAbs().maxCoeff(), 1e-8) << sample.time_s;
  }
}

TEST(DualUkfOnALinearArm, HeldWeightsGiveThePosteriorOfTheAugmentedKalmanFilter) {
  const ArmModel model = slide();
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const std::vector<EncoderSample> record = record_of(model, -0.4, 250, seed);
    const Posterior dual = by_held_weights(model, record, 0), kalman = by_augmented_filter(model, record);
    EXPECT_LT(kalman.deviation, 0.5) << "the record tells of the bias";
    EXPECT_NEAR(dual.mean, kalman.mean, 1e-6);
    EXPECT_NEAR(dual.deviation, kalman.deviation, 1e-6);
  }
}

/// On this arm, readings depend on both weights linearly, so that their derivatives do not depend on what is believed.
TEST(DualUkfOnALinearArm, DerivativesByTwoWeightsAreThoseOfHeldOnesWhileItLearns) {
  const ArmModel model = slide();
  const std::vector<Weight> weights = {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = kBias},
                                       {.key = "joint1.motor.zero", .nominal = 0, .scale = 0.3}};
  DualUkf held(model, weights, {.learn = false, .settle = 0}), learns(model, weights, {.settle = 0});
  double compared = 0;
  for (const EncoderSample& sample : record_of(model, 0.7, 300, 1)) {
    const DualStep a = held.update(sample), b = learns.update(sample);
    if (a.nu.size() == 0 || b.nu.size() == 0) continue;
    EXPECT_LT((a.Y - b.Y).cwiseAbs().maxCoeff(), 1e-5 * (1 + a.Y.cwiseAbs().maxCoeff())) << sample.time_s;
    ++compared;
  }
  EXPECT_GT(compared, 250);
  EXPECT_GT(std::abs(learns.S_w()(0, 1)) + std::abs(learns.S_w()(1, 0)), 0);
}

/// Errors of the held weights' posteriors over their deviations, of records with weights drawn from the prior.
std::vector<double> normalised_errors(const ArmModel& robot, const ArmModel& believed, int records) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  std::vector<double> errors;
  for (int r = 0; r < records; ++r) {
    const double truth = normal(random);
    const Posterior p = by_held_weights(believed, record_of(robot, truth, 250, 100 + r), 0.05);
    errors.push_back((p.mean - truth) / p.deviation);
  }
  return errors;
}

double mean_square(const std::vector<double>& x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0) / static_cast<double>(x.size());
}

TEST(DualUkfOnALinearArm, ThePosteriorHoldsTheTruthAsOftenAsItSays) {
  constexpr int kRecords = 200;
  const std::vector<double> errors = normalised_errors(slide(), slide(), kRecords);
  const auto held = std::ranges::count_if(errors, [](double e) { return std::abs(e) <= 1.96; });
  // χ²(200) / 200 and a binomial count, each within four of its standard deviations.
  EXPECT_NEAR(mean_square(errors), 1, 4 * std::sqrt(2.0 / kRecords));
  EXPECT_NEAR(static_cast<double>(held), 0.95 * kRecords, 4 * std::sqrt(kRecords * 0.95 * 0.05));
}

TEST(DualUkfOnALinearArm, ThePosteriorIsTooNarrowForAFilterThatTakesTheArmForQuiet) {
  constexpr int kRecords = 50;
  ArmModel quiet = slide();
  quiet.estimators["sr_ukf"]["torque_noise"] = "0.007";  // a third of what is drawn: errors of three deviations
  EXPECT_GT(mean_square(normalised_errors(slide(), quiet, kRecords)), 1 + 8 * std::sqrt(2.0 / kRecords));
}

TEST(DualUkfOnALinearArm, LearningEndsAtThePosterior) {
  const ArmModel model = slide();
  constexpr int kRecords = 20;
  std::vector<double> to_posterior, to_truth;
  double wider = 0;
  for (int r = 0; r < kRecords; ++r) {
    const double truth = -1.9 + 0.2 * r;
    const std::vector<EncoderSample> record = record_of(model, truth, 1500, 500 + r);
    const Posterior p = by_held_weights(model, record, 0.5);
    DualUkf filter = filter_of(model, {});
    for (const EncoderSample& sample : record) filter.update(sample);
    const double w = filter.w()(0), deviation = filter.S_w()(0, 0);
    to_posterior.push_back((w - p.mean) / p.deviation);
    to_truth.push_back((w - truth) / deviation);
    wider += deviation / p.deviation / kRecords;
  }
  // The learning filter is no exact one, as it does not correct the past by what it has learnt since, and forgets.
  // Observed after 3 s: 0.44, and 1.21 times the posterior's deviation.
  EXPECT_LT(mean_square(to_posterior), 1);
  EXPECT_GT(wider, 1);
  EXPECT_LT(wider, 1.5);
  // χ²(20) / 20 and four of its standard deviations.
  EXPECT_LT(mean_square(to_truth), 1 + 4 * std::sqrt(2.0 / kRecords));
}

}  // namespace
}  // namespace halyard
