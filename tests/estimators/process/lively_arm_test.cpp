/// Slopes, changes and curvatures of an arm whose numbers are of the order of one, entry by entry.

#include "tests/estimators/process/lively_arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/estimators/matrix/lane_matrices.h"

namespace halyard {
namespace {

constexpr int kDeviations = 11;  // more than a register holds

/// An arm at a state, linearised there.
struct LivelyPoint {
  ProcessModel process;
  Step step;
  Eigen::VectorXd x, f;
  Eigen::MatrixXd A;
  LinearisedPoint found;
  int n, first;

  explicit LivelyPoint(const ArmModel& model)
      : process(model), x(lively_state(process)), n(process.n_states()), first(process.layout().positions) {
    static constexpr double kTorque[3] = {0.3, -0.2, 0.1}, kLoad[3] = {0.5, 0.4, -0.3};
    step = {0.2, 1e-2, kTorque, kLoad, nullptr};
    process.linearise(step, x, nullptr, f, A, found);
  }
  Eigen::VectorXd rates(const Eigen::VectorXd& at) const { return process.derivative(step, at); }
  /// Of motors, joints and internal states for each row of d, with a linear chain: from the transmission itself.
  Eigen::MatrixXd changes(const Eigen::MatrixXd& d) const {
    LaneMatrix changed;
    process.changes(step, found.chain, {x.data(), f.data(), found.force}, in_lanes(d), changed);
    return changed.view();
  }
  /// What A says of them.
  Eigen::MatrixXd linear(const Eigen::MatrixXd& d) const { return d * A.middleRows(first, n - first).transpose(); }
};

/// Numbers between -size and size.
Eigen::MatrixXd uniform_matrix(int rows, int columns, double size, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

double largest_entry(const Eigen::MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }

TEST(LivelyArm, EachSlopeIsThatOfTheRates) {
  for (const ArmModel& model : {lively_arm(), lively_arm(CableLaw::exponential), lively_arm_with_effects()}) {
    const LivelyPoint p(model);
    EXPECT_LT(largest_entry(p.f - p.rates(p.x)), 1e-12 * largest_entry(p.f));
    constexpr double kChange = 1e-5;
    for (int c = 0; c < p.n; ++c) {
      const Eigen::VectorXd change = kChange * Eigen::VectorXd::Unit(p.n, c);
      const Eigen::VectorXd slope = (p.rates(p.x + change) - p.rates(p.x - change)) / (2 * kChange);
      // Third derivatives of up to 1e4, and rates of up to 1e3 that are rounded.
      EXPECT_LT(largest_entry(p.A.col(c) - slope), 1e-6) << p.process.state_name(c);
    }
  }
}

TEST(LivelyArm, RatesBesideAnEarlierPointAreThoseOfTheState) {
  for (const ArmModel& model : {lively_arm(), lively_arm_with_effects()}) {
    LivelyPoint p(model);
    const Eigen::VectorXd later = p.x + uniform_matrix(p.n, 1, 1e-4);
    Eigen::VectorXd f;
    p.process.rates_beside(p.step, later, f, p.found);
    const Eigen::VectorXd exact = p.rates(later);
    EXPECT_GT(largest_entry(exact - p.f), 1e-3);
    // The change of the masses times that of the accelerations: both some 1e-4.
    EXPECT_LT(largest_entry(f - exact), 1e-6);
  }
}

TEST(LivelyArm, ChangesAreThoseOfTheRates) {
  const LivelyPoint p(lively_arm_with_effects());
  const Eigen::MatrixXd d = uniform_matrix(kDeviations, p.n, 1e-4), changes = p.changes(d);
  for (int i = 0; i < kDeviations; ++i) {
    const Eigen::VectorXd exact = (p.rates(p.x + d.row(i).transpose()) - p.f).tail(p.n - p.first);
    // The chain's forces of second order.
    EXPECT_LT(largest_entry(changes.row(i).transpose() - exact), 1e-6) << i;
    EXPECT_GT(largest_entry(exact), 1e-4) << i;
  }
}

TEST(LivelyArm, TheSecondStageIsWhatTheTransmissionIsMoreThanLinear) {
  for (const ArmModel& model : {lively_arm(), lively_arm_with_effects()}) {
    const LivelyPoint p(model);
    const Eigen::MatrixXd d = uniform_matrix(1, p.n, 0.3);
    Eigen::VectorXd D;
    LinearisedPoint end;
    p.process.second_stage(p.step, p.found, p.x, p.x + d.row(0).transpose(), end, D);
    const Eigen::VectorXd exact = (p.changes(d) - p.linear(d)).row(0);
    for (int i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(D(i), exact(i), 1e-11) << i;  // rounding of rates of up to 1e3
      EXPECT_GT(std::abs(exact(i)), 1e-3) << i;
    }
  }
}

/// A second stage far from the point.
struct LivelyEnd {
  Eigen::MatrixXd u;  // one row
  Eigen::VectorXd x_2, D;
  LinearisedPoint point;

  explicit LivelyEnd(const LivelyPoint& p) : u(uniform_matrix(1, p.n, 0.3, 2)), x_2(p.x + u.row(0).transpose()) {
    p.process.second_stage(p.step, p.found, p.x, x_2, point, D);
  }
};

/// Checks far_excess() of deviations that are far in the rates, and `near` times as far in the positions, where cables
/// are taken as quadratic and other effects as linear.
void expect_far_excess(const ArmModel& model, double near) {
  const LivelyPoint p(model);
  const LivelyEnd end(p);
  Eigen::MatrixXd d = uniform_matrix(kDeviations, p.n, 4, 3);
  d.leftCols(p.first) *= near;
  LaneMatrix excess;
  p.process.far_excess(p.step, p.found, end.point, end.x_2, -2, in_lanes(d), excess);
  const Eigen::MatrixXd from_x = d.rowwise() + end.u.row(0);
  const Eigen::MatrixXd exact = (p.changes(from_x) - p.linear(d)).rowwise() - p.changes(end.u).row(0);
  // Terms of higher order in 4e-5, times forces of up to 1e3; friction that is not saturated within 1e-8.
  EXPECT_LT(largest_entry(excess.view() + 2 * exact), 1e-6);
  EXPECT_GT(exact.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-3);
}

TEST(LivelyArm, FarExcessIsWhatTheTransmissionIsMoreThanLinearThere) {
  ArmModel with_ripple = lively_arm();
  add_effect(with_ripple, "torque_ripple", 1, {30, -20, 2});
  expect_far_excess(lively_arm(), 1e-5);
  expect_far_excess(with_ripple, 5e-6);
  expect_far_excess(lively_arm_with_effects(), 0);
}

TEST(LivelyArm, NearExcessIsTheChangeOfTheSlopesOfTheTransmission) {
  const LivelyPoint p(lively_arm_with_effects());
  const LivelyEnd end(p);
  const Eigen::MatrixXd d = uniform_matrix(kDeviations, p.n, 1, 3);
  LaneMatrix excess;
  p.process.near_excess(p.found, end.point, -2, in_lanes(d), excess);
  constexpr double kChange = 1e-5;
  const Eigen::MatrixXd above = (kChange * d).rowwise() + end.u.row(0), below = (-kChange * d).rowwise() + end.u.row(0);
  const Eigen::MatrixXd exact = (p.changes(above) - p.changes(below)) / (2 * kChange) - p.linear(d);
  // As for the slopes.
  EXPECT_LT(largest_entry(excess.view() + 2 * exact), 1e-5);
  EXPECT_GT(exact.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-2);
}

TEST(LivelyArm, CurvatureIsTheMeanOfWhatNarrowDeviationsAdd) {
  for (ArmModel model : {lively_arm(), lively_arm_with_effects()}) {
    model.nominal.joint[1].damping = 0;  // whose force the backlash makes one of stretch and rate: left out of the mean
    LivelyPoint p(model);
    constexpr double kSpread = 1e-3;
    const Eigen::MatrixXd S = uniform_matrix(p.n, kDeviations, 1, 4);
    const LaneMatrix root = in_lanes(S.transpose());
    Eigen::VectorXd mean, exact = Eigen::VectorXd::Zero(p.n);
    p.process.chain_curvature(p.found, p.x, p.f, p.A, kSpread, root);
    p.process.mean_curvature(p.step, p.x, p.found.chain, p.found, kSpread, root, mean);
    for (int i = 0; i < kDeviations; ++i) {
      const Eigen::VectorXd d = kSpread * S.col(i);
      exact += (p.rates(p.x + d) - p.f + (p.rates(p.x - d) - p.f)) / (2 * kDeviations);
    }
    EXPECT_EQ(mean.head(p.first).norm(), 0);
    for (int i = p.first; i < p.n; ++i) {
      // Of higher order in 1e-3, and second differences of rates of up to 1e3.
      EXPECT_NEAR(mean(i), exact(i), 1e-3 * std::abs(exact(i)) + 1e-12) << i;
      EXPECT_GT(std::abs(exact(i)), 1e-8) << i;
    }
  }
}

TEST(LivelyArm, ImpulsesMoveItAsTheModelMovesIt) {
  const LivelyPoint p(lively_arm_with_effects());
  const Eigen::VectorXd x_2 = p.x + p.step.dt_s * p.f;
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(kDeviations, p.n);
  G.rightCols(p.n - p.first) = uniform_matrix(kDeviations, p.n - p.first, 2, 5);
  for (int k = 0; k < 3; ++k) G.col(p.process.layout().rate[k]) *= 0.02;
  LaneMatrix Gamma = in_lanes(Eigen::MatrixXd::Zero(kDeviations, p.n));
  p.process.impulse_response(p.step, p.found, p.A, p.x, x_2, in_lanes(G), Gamma);
  for (int i = 0; i < kDeviations; ++i) {
    Eigen::VectorXd free = p.x, forced = p.x + G.row(i).transpose(), exact = G.row(i).transpose() / 6;
    Step half = p.step;
    half.dt_s /= 2;
    for (const double weight : {4.0 / 6, 1.0 / 6}) {
      p.process.advance(half, free.data());
      p.process.advance(half, forced.data());
      half.time_s += half.dt_s;
      exact += weight * (forced - free);
    }
    const Eigen::VectorXd change = exact - G.row(i).transpose(), error = Gamma.view().row(i).transpose() - exact;
    // The chain's forces of second order in 0.04, and masses that change within the step.
    EXPECT_LT(largest_entry(error.head(p.first)), 1e-5 * largest_entry(change.head(p.first))) << i;
    EXPECT_LT(largest_entry(error.tail(p.n - p.first)), 2e-3 * largest_entry(change.tail(p.n - p.first))) << i;
  }
}

/// The excess rate of a second stage where motor k has turned.
double excess_rate_after(const LivelyPoint& p, int k, double turned) {
  Eigen::VectorXd x_2 = p.x, D;
  x_2(*p.process.layout().motor_angle[k]) += turned;
  LinearisedPoint end;
  p.process.second_stage(p.step, p.found, p.x, x_2, end, D);
  return end.excess_rate;
}

TEST(LivelyArm, TheExcessRateOfARippleIsTheChangeOfTheCablesRateUnderIt) {
  ArmModel model = lively_arm();
  constexpr double kAmplitude = 30, kTurned = 0.1;
  add_effect(model, "torque_ripple", 1, {0, kAmplitude, 1});
  const LivelyPoint p(model);
  const JointParameters<double>& j = p.process.arm().joint[1];
  const double angle = p.x(*p.process.layout().motor_angle[1]), radius = j.motor_travel();
  const double added = std::abs(kAmplitude * (std::cos(angle + kTurned) - std::cos(angle)));
  const double stiffness = 2 * j.stiffness * std::cosh(-0.2) * radius * radius;  // the cable is stretched by -0.2
  EXPECT_NEAR(excess_rate_after(p, 1, kTurned),
              std::sqrt((stiffness + added) / j.rotor_inertia) - std::sqrt(stiffness / j.rotor_inertia), 1e-10);
}

TEST(LivelyArm, TheExcessRateOfADamperBehindABacklashIsTheChangeOfItsDamping) {
  ArmModel model = lively_arm();
  model.nominal.joint[1].damping = 1e3;
  constexpr double kGap = 0.1, kRounding = 0.15, kTurned = 0.3;
  add_effect(model, "backlash", 1, {kGap, kRounding});
  const LivelyPoint p(model);
  const JointParameters<double>& j = p.process.arm().joint[1];
  const auto share = [&](double stretch) {  // of the stretch's rate that reaches the cable
    const auto of_edge = [&](double beyond) { return (1 + beyond / std::hypot(beyond, kRounding)) / 2; };
    return of_edge(stretch - kGap) + of_edge(-stretch - kGap);
  };
  const double r = j.motor_travel(), change = std::abs(share(-0.2 + r * kTurned) - share(-0.2));
  EXPECT_NEAR(excess_rate_after(p, 1, kTurned), r * r * 2e3 * change / j.rotor_inertia, 1e-9);
}

TEST(LivelyArm, AStepWithoutTorquesAndForcesIsOneOfNone) {
  const LivelyPoint p(lively_arm());
  constexpr double kNone[3] = {};
  const Step given{0, 1e-3, kNone, kNone, nullptr}, absent{0, 1e-3};
  EXPECT_EQ(p.process.derivative(absent, p.x), p.process.derivative(given, p.x));
  Eigen::VectorXd x = p.x, y = p.x;
  p.process.advance(absent, x.data());
  p.process.advance(given, y.data());
  EXPECT_EQ(x, y);
}

TEST(LivelyArm, IsPlainUnderThePapersLawOnly) {
  EXPECT_TRUE(ProcessModel(lively_arm()).is_plain());
  EXPECT_FALSE(ProcessModel(lively_arm(CableLaw::exponential)).is_plain());
  EXPECT_FALSE(ProcessModel(lively_arm(CableLaw::linear)).is_plain());
}

TEST(LivelyArm, WithoutFiniteRatesAtStandstillItIsNoModel) {
  ArmModel model = lively_arm();
  model.nominal.joint[1].torque_bias = std::numeric_limits<double>::infinity();
  try {
    const ProcessModel process(model);
    FAIL() << "accepted";
  } catch (const std::runtime_error& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("process model: motor_rate_2 is not finite at 0 s; check"))
        << e.what();
  }
}

/// Checks the rates and each slope of a linearisation at x.
void expect_slopes_of_rates(const ProcessModel& process, const Step& step, const Eigen::VectorXd& x) {
  Eigen::VectorXd f;
  Eigen::MatrixXd A;
  process.linearise(step, x, f, A);
  EXPECT_LT(largest_entry(f - process.derivative(step, x)), 1e-10 * largest_entry(f));
  constexpr double kChange = 1e-5;
  for (int c = 0; c < process.n_states(); ++c) {
    const Eigen::VectorXd change = kChange * Eigen::VectorXd::Unit(process.n_states(), c);
    const Eigen::VectorXd slope =
        (process.derivative(step, x + change) - process.derivative(step, x - change)) / (2 * kChange);
    // Rates of up to 1e4 that are rounded; a slope that is left out is of the order of one.
    EXPECT_LT(largest_entry(A.col(c) - slope), 1e-4 * (1 + largest_entry(slope))) << process.state_name(c);
  }
}

/// With more positions and rates than a register holds.
ArmModel lively_arm_of_seven() {
  ArmModel model = lively_arm();
  model.nominal.n = 7;
  for (int k = 3; k < 7; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j = model.nominal.joint[k - 3];
    std::fill(j.coupling, j.coupling + kMaxJoints, 0.0);
    j.coupling[k] = 1;
    j.coupling[k - 1] = 0.1;
    model.joints.push_back(JointDescription(model.joints[k - 3]));
  }
  return model;
}

TEST(LivelyArm, EachSlopeOfSevenJointsIsThatOfTheRates) {
  const ProcessModel process(lively_arm_of_seven());
  ASSERT_TRUE(process.is_plain());
  ASSERT_EQ(process.n_states(), 28);
  const StateLayout& l = process.layout();
  Eigen::VectorXd q(7);
  q << 0.4, -0.3, 0.2, 0.5, -0.4, 0.1, 0.3;
  Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), q), q);
  for (int k = 0; k < 7; ++k) {
    x(*l.motor_angle[k]) += (k % 2 == 0 ? 0.1 : -0.15) / process.arm().joint[k].motor_travel();
    x(l.rate[k]) = 0.5 - 0.15 * k;
    x(*l.motor_rate[k]) = 0.3 * k - 0.8;
  }
  constexpr double kTorques[7] = {0.3, -0.2, 0.1, 0.2, -0.1, 0.3, -0.3};
  constexpr double kLoads[7] = {0.5, 0.4, -0.3, 0.2, 0.1, -0.2, 0.3};
  expect_slopes_of_rates(process, {0.2, 1e-2, kTorques, kLoads, nullptr}, x);
}

/// With states of its own, so that it is not plain.
ArmModel lively_arm_with_memory() {
  ArmModel model = lively_arm();
  add_effect(model, "hysteresis", 0, {0.4, 0.1});
  add_effect(model, "creep", 1, {0.5, 0.3});
  add_effect(model, "pulley_friction", 2, {0.1, 0.4});
  add_effect(model, "motor_presliding", 2, {0.5, 0.4});
  return model;
}

/// lively_state() with states of the effects that are not zero.
Eigen::VectorXd lively_state_with_memory(const ProcessModel& process) {
  Eigen::VectorXd x = lively_state(process);
  x.tail(3) << -0.03, 0.05, -0.1;
  return x;
}

constexpr double kMemoryTorque[3] = {0.3, -0.2, 0.1}, kMemoryLoad[3] = {0.5, 0.4, -0.3};
const Step kMemoryStep{0.2, 1e-2, kMemoryTorque, kMemoryLoad, nullptr};

TEST(LivelyArm, EachSlopeIsThatOfTheRatesAlsoWithMemory) {
  const ProcessModel process(lively_arm_with_memory());
  ASSERT_EQ(process.n_states(), 15);
  ASSERT_FALSE(process.is_plain());
  expect_slopes_of_rates(process, kMemoryStep, lively_state_with_memory(process));
}

TEST(LivelyArm, ChangesAreThoseOfTheRatesAlsoWithMemory) {
  const ProcessModel process(lively_arm_with_memory());
  const int n = process.n_states(), first = process.layout().positions;
  const Eigen::VectorXd x = lively_state_with_memory(process);
  Eigen::VectorXd f;
  Eigen::MatrixXd A;
  LinearisedPoint found;
  process.linearise(kMemoryStep, x, nullptr, f, A, found);
  const Eigen::MatrixXd d = uniform_matrix(kDeviations, n, 1e-4, 6);
  LaneMatrix changes;
  process.changes(kMemoryStep, found.chain, {x.data(), f.data(), found.force}, in_lanes(d), changes);
  for (int i = 0; i < kDeviations; ++i) {
    const Eigen::VectorXd exact = (process.derivative(kMemoryStep, x + d.row(i).transpose()) - f).tail(n - first);
    EXPECT_LT(largest_entry(changes.view().row(i).transpose() - exact), 1e-6) << i;  // as without effects
    EXPECT_GT(exact.tail(3).cwiseAbs().minCoeff(), 0) << i;
  }
}

}  // namespace
}  // namespace halyard
