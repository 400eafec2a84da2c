/// Linearisation, curvature and changes of rates: of an arm whose transmission is plain, with unknown constants or with
/// effects of one signal, and of one with other effects.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

/// The RAVEN-II with all kinds of effects of one signal.
ArmModel with_one_signal_effects() {
  ArmModel model = raven2();
  add_effect(model, "motor_friction", 0, {1e-3, 1e-6, 0.5, 0.5});
  add_effect(model, "stribeck", 0, {0.2, 0.05, 3e-3, 2});
  add_effect(model, "cable_slip", 0, {1e-6, 5e-4});
  add_effect(model, "torque_ripple", 1, {2e-3, -1e-3, 12});
  add_effect(model, "friction_drift", 1, {-0.5, 0.3, 0, 1});
  add_effect(model, "stiffness", 1, {1.2, 0.8, 1e5});
  add_effect(model, "joint_friction", 2, {0.1, 0.01, 0.5, 0.5});
  add_effect(model, "backlash", 2, {1e-4, 1e-3});  // well rounded
  return model;
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
  ASSERT_TRUE(p.process.is_plain());
  for (int i = p.process.layout().effect_states; i < p.process.n_states(); ++i) {
    const Eigen::VectorXd change = 1e-4 * Eigen::VectorXd::Unit(p.process.n_states(), i);
    const Eigen::VectorXd slope = (p.rates(p.x + change) - p.rates(p.x - change)) / 2e-4;
    // The cables are linear within 1e-7; rates of up to 1e4 are rounded.
    EXPECT_LT((p.A.col(i) - slope).norm(), 1e-6 * slope.norm() + 1e-7) << i;
    EXPECT_GT(slope.norm(), 0) << i;
  }
}

TEST(ArmLinearisation, EffectsOfOneSignalHaveTheirRatesAndSlopes) {
  const Point p(with_one_signal_effects());
  ASSERT_TRUE(p.process.is_plain());
  EXPECT_LT((p.f - p.rates(p.x)).norm(), 1e-12 * p.f.norm());
  for (int i = 0; i < p.process.n_states(); ++i) {
    const Eigen::VectorXd change = 1e-7 * Eigen::VectorXd::Unit(p.process.n_states(), i);
    const Eigen::VectorXd slope = (p.rates(p.x + change) - p.rates(p.x - change)) / 2e-7;
    // Friction's third derivative, and rates of up to 1e4 that are rounded.
    EXPECT_LT((p.A.col(i) - slope).norm(), 1e-6 * slope.norm() + 1e-4) << p.process.state_name(i);
  }
}

TEST(ArmLinearisation, TakesMassesAndSlopesOfTheChainFromAStateShortlyBefore) {
  Point p(with_constants());
  const Eigen::VectorXd later = p.x + 5 * p.step.dt_s * p.f;
  Eigen::VectorXd f, f_near;
  Eigen::MatrixXd A, A_near;
  p.process.linearise(p.step, later, f, A);
  LinearisedPoint near;
  p.process.linearise(p.step, later, &p.found.chain, f_near, A_near, near);
  // Within 5 ms, M changes by less than 1e-3, and that times the change of the accelerations is missing.
  EXPECT_LT((f_near - f).norm(), 1e-3 * (f - p.f).norm());
  EXPECT_LT((A_near - A).norm(), 1e-3 * A.norm());
}

TEST(ArmCurvature, IsTheMeanOfWhatNarrowDeviationsAdd) {
  for (const ArmModel& model : {raven2(), with_constants(), with_one_signal_effects()}) {
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
    p.process.chain_curvature(p.found, p.x, p.f, p.A, kSpread, root);
    p.process.mean_curvature(p.step, p.x, p.found.chain, p.found, kSpread, root, mean);
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd d = kSpread * S.col(i);
      exact += (p.rates(p.x + d) - p.f + (p.rates(p.x - d) - p.f)) / (2 * n);
    }
    // Rates of states that are rounded.
    const Eigen::VectorXd rounding = std::numeric_limits<double>::epsilon() * p.A.cwiseAbs() * p.x.cwiseAbs();
    for (int i = 0; i < n; ++i)
      // Terms of fourth order: the spread's square times a few.
      EXPECT_NEAR(mean(i), exact(i), 1e-3 * std::abs(exact(i)) + rounding(i)) << i << " of " << n;
  }
}

/// The RAVEN-II with an effect that has a kink, one with a steep slope and one with an internal state.
ArmModel with_effects() {
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 0, {});
  add_effect(model, "torque_ripple", 1, {});
  add_effect(model, "backlash", 2, {});
  return model;
}

TEST(ArmChanges, AreThoseOfTheRatesAlsoBeyondAKink) {
  const Point p(with_effects());
  const int n = p.process.n_states(), first = p.process.layout().positions, rows = 11;  // more than a register holds
  ASSERT_FALSE(p.process.is_plain());
  LaneMatrix d, changes;
  d.set_zero(rows, n);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < rows; ++i)
    for (int c = 0; c < n; ++c) d.view()(i, c) = (c < first ? 1e-5 : 1e-4) * normal(random);
  d.view()(1, *p.process.layout().motor_angle[2]) += 0.1;  // out of the gap
  double force[3];
  p.process.changes(p.step, p.found.chain, {p.x.data(), p.f.data(), p.found.force}, d, changes, force);
  ASSERT_EQ(changes.columns(), n - first);
  for (int i = 0; i < rows; ++i) {
    const Eigen::VectorXd exact = p.rates(p.x + d.view().row(i).transpose()) - p.f;
    // The chain's forces of second order in 0.1 mrad; 3e-4 was observed. Rates of up to 1e4 are rounded.
    for (int c = first; c < n; ++c)
      EXPECT_NEAR(changes.view()(i, c - first), exact(c), 1e-3 * std::abs(exact(c)) + 1e-8) << i << ", " << c;
  }
  Eigen::VectorXd f;
  Eigen::MatrixXd A;
  LinearisedPoint there;
  p.process.linearise(p.step, p.x + d.view().row(0).transpose(), nullptr, f, A, there);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(force[k], there.force[k], 1e-9 * std::abs(there.force[k])) << k;
}

TEST(ArmLinearisation, TheJacobianBesideIsThatOfTheLinearisation) {
  const Point p(with_effects());
  const Eigen::VectorXd later = p.x + p.step.dt_s * p.f;
  Eigen::VectorXd f;
  Eigen::MatrixXd A, beside;
  LinearisedPoint there;
  p.process.linearise(p.step, later, &p.found.chain, f, A, there);
  p.process.jacobian_beside(p.step, later, p.found.chain, beside);
  EXPECT_EQ(beside, A);
  EXPECT_GT((A - p.A).norm(), 0);
}

/// A second stage of a point: where it would be after 1 ms, with D and the point there.
struct SecondStage {
  Step next{1e-3, 1e-3};
  Eigen::VectorXd x_2, D;
  LinearisedPoint end;

  explicit SecondStage(const Point& p) {
    x_2 = p.x + p.step.dt_s * p.f;
    p.process.second_stage(next, p.found, p.x, x_2, end, D);
  }
};

/// What follows holds for both.
class ArmSecondStages : public testing::TestWithParam<bool> {
 protected:
  const Point p{GetParam() ? with_one_signal_effects() : with_constants()};
  const SecondStage s{p};
  Eigen::VectorXd rates(const Eigen::VectorXd& at) const { return p.process.derivative(s.next, at); }
};
INSTANTIATE_TEST_SUITE_P(Plain, ArmSecondStages, testing::Bool(),
                         [](const auto& info) { return info.param ? "WithEffects" : "WithConstants"; });

TEST_P(ArmSecondStages, HasTheRatesThere) {
  const int first = p.process.layout().positions, moving = static_cast<int>(s.D.size());
  const Eigen::VectorXd linear = p.f + p.A * (s.x_2 - p.x);
  const Eigen::VectorXd exact = (rates(s.x_2) - linear).segment(first, moving);
  ASSERT_GT(exact.norm(), 0.01 * (linear - p.f).norm());  // D is not small here
  // M and the chain's slopes change by less than 1e-3 within 1 ms.
  EXPECT_LT((s.D - exact).norm(), 1e-3 * exact.norm());
}

TEST_P(ArmSecondStages, ExcessFollowsFrictionFarAndTheChainLinearly) {
  const StateLayout& l = p.process.layout();
  LaneMatrix D, excess;
  D.set_zero(6, p.process.n_states());
  for (int k = 0; k < 3; ++k) {
    D.view()(k, l.rate[k]) = 5e-3;  // as far as friction's smoothing speed
    D.view()(3 + k, *l.motor_rate[k]) = 0.5;
  }
  p.process.far_excess(s.next, p.found, s.end, s.x_2, 1, D, excess);
  const Eigen::VectorXd f_2 = rates(s.x_2);
  double farthest = 0;  // of the tangent from the model, relative
  for (int i = 0; i < D.rows(); ++i) {
    const Eigen::VectorXd d = D.view().row(i), exact = rates(s.x_2 + d) - f_2, linear = p.A * d;
    Eigen::VectorXd found = linear;
    found.segment(l.positions, excess.columns()) += excess.view().row(i).transpose();
    // The chain's forces of second order in 5 mrad/s, and what M and the chain's slopes change within 1 ms.
    EXPECT_LT((found - exact).norm(), 1e-4 * exact.norm()) << i;
    farthest = std::max(farthest, (linear - exact).norm() / exact.norm());
  }
  EXPECT_GT(farthest, 0.05);
}

TEST_P(ArmSecondStages, NearExcessIsTheChangeOfTheJacobian) {
  const int n = p.process.n_states(), first = p.process.layout().positions;
  Eigen::VectorXd f_2;
  Eigen::MatrixXd A_2;
  p.process.linearise(s.next, s.x_2, f_2, A_2);
  LaneMatrix units, excess;
  units.set_zero(n, n);
  units.view().diagonal().setOnes();
  p.process.near_excess(p.found, s.end, 1, units, excess);
  const Eigen::MatrixXd exact = (A_2 - p.A).middleRows(first, excess.columns());
  double most = 0;  // change of a column, relative
  for (int c = 0; c < n; ++c) {
    // M, and with it what all forces do to the joints, changes by less than 1e-3 within 1 ms.
    EXPECT_LT((excess.view().row(c).transpose() - exact.col(c)).norm(), 1e-3 * p.A.col(c).norm()) << c;
    most = std::max(most, exact.col(c).norm() / (1e-9 + p.A.col(c).norm()));
  }
  EXPECT_GT(most, 0.1);
}

TEST(ArmSecondStage, ItsExcessRateIsTheLargestChangeOfADampingRateOrOfACablesRate) {
  const Point p(raven2());
  const StateLayout& l = p.process.layout();
  const auto damping = [](double coulomb, double smoothing, double v) {  // slope of F_c tanh(v / v_s)
    return coulomb / smoothing * (1 - std::pow(std::tanh(v / smoothing), 2));
  };
  const auto excess_at = [&](int state, double change) {
    Eigen::VectorXd x_2 = p.x, D;
    x_2(state) += change;
    LinearisedPoint end;
    p.process.second_stage(p.step, p.found, p.x, x_2, end, D);
    return end.excess_rate;
  };
  for (int k = 0; k < 3; ++k) {
    const JointParameters<double>& j = p.process.arm().joint[k];
    for (const double change : {0.3, -2.0}) {
      const double motor = p.x(*l.motor_rate[k]), joint = p.x(l.rate[k]);
      const double of_motor = std::abs(damping(j.motor_coulomb, j.motor_smoothing, motor + change) -
                                       damping(j.motor_coulomb, j.motor_smoothing, motor)) /
                              j.rotor_inertia;
      EXPECT_NEAR(excess_at(*l.motor_rate[k], change), of_motor,
                  1e-12 * j.motor_coulomb / j.motor_smoothing / j.rotor_inertia)
          << k;
      const double mobility = p.found.chain.mobility[k * 4], slow = 0.01 * change;
      const double of_joint = mobility * std::abs(damping(j.joint_coulomb, j.joint_smoothing, joint + slow) -
                                                  damping(j.joint_coulomb, j.joint_smoothing, joint));
      // Where friction is saturated at both speeds, its slopes are the rests of 1 less 1.
      EXPECT_NEAR(excess_at(l.rate[k], slow), of_joint, 1e-12 * mobility * j.joint_coulomb / j.joint_smoothing) << k;
      // The paper's law has the slope 2 k cosh(x); here the stretch becomes some centimetres.
      const double x = 0.03 * change;
      const double of_cable =
          j.motor_travel() * std::sqrt(2 * j.stiffness / j.rotor_inertia) * (std::sqrt(std::cosh(x)) - 1);
      // At the start the cables are stretched by less than 0.1 mm.
      EXPECT_NEAR(excess_at(*l.motor_angle[k], x / j.motor_travel()), of_cable, 1e-2 * of_cable) << k;
    }
  }
}

TEST(PlainTransmission, HasNoEffectOfSeveralSignals) {
  ArmModel model = raven2();
  add_effect(model, "encoder_offset", 1, {});
  EXPECT_FALSE(ProcessModel(model).has_effects());
  add_effect(model, "backlash", 1, {});
  EXPECT_TRUE(ProcessModel(model).is_plain());
  EXPECT_TRUE(ProcessModel(model).has_effects());
  for (const char* name : {"hysteresis", "delay", "pulley_friction", "capstan_eccentricity"}) {
    ArmModel other = model;
    add_effect(other, name, 1, {});
    EXPECT_FALSE(ProcessModel(other).is_plain()) << name;
  }
}

TEST(PlainTransmission, ACableWithAnUnknownOffsetHasNoEffect) {
  ArmModel model = with_constants();
  add_effect(model, "backlash", 1, {});
  EXPECT_FALSE(ProcessModel(model).is_plain());
}

TEST(PlainTransmission, EffectsActByTheirRankWhereverTheyStand) {
  Eigen::VectorXd f[2];
  for (const bool turned : {false, true}) {
    ArmModel model = raven2();
    add_effect(model, "cable_slip", 1, {-2e-3, -1});
    add_effect(model, "backlash", 1, {1e-3, 1e-4});
    if (turned) std::swap(model.effects[0], model.effects[1]);
    const Point p(model);
    EXPECT_TRUE(p.process.is_plain());
    f[turned] = p.f;
    const Eigen::VectorXd exact = p.process.derivative(p.step, p.x);  // of the transmission with its effects
    EXPECT_TRUE(p.f.isApprox(exact, 1e-12));
  }
  EXPECT_EQ(f[0], f[1]);
}

TEST(PlainTransmission, SeesAKinkBetweenTwoStatesAndBesideThem) {
  ArmModel model = raven2();
  const double half_gap = 1e-3;
  add_effect(model, "backlash", 1, {half_gap, 0});
  Point p(model);
  const int n = p.process.n_states(), motor = *p.process.layout().motor_angle[1];
  const double travel = p.process.arm().joint[1].motor_travel();
  const auto has_kink = [&](double from, double to, double deviations) {
    Eigen::VectorXd x = p.x, x_2 = p.x;
    x(motor) += from / travel, x_2(motor) += to / travel;
    p.process.linearise(p.step, x, nullptr, p.f, p.A, p.found);
    LaneMatrix S;  // 0.1 mm of the cable, from two sources
    S.set_zero(n, n);
    S.view()(motor, 0) = 0.6e-4 / travel, S.view()(motor, 3) = -0.8e-4 / travel;
    return p.process.has_kink_near(p.step, x, p.found, x_2, deviations, S);
  };
  EXPECT_FALSE(has_kink(0, 0.9 * half_gap, 0));
  EXPECT_TRUE(has_kink(0, 1.1 * half_gap, 0));
  EXPECT_TRUE(has_kink(0, -1.1 * half_gap, 0));
  EXPECT_TRUE(has_kink(1.1 * half_gap, -1.1 * half_gap, 0));  // the same slope at both
  EXPECT_FALSE(has_kink(1.1 * half_gap, 1.5 * half_gap, 0.9));
  EXPECT_TRUE(has_kink(1.1 * half_gap, 1.5 * half_gap, 1.1));
  EXPECT_FALSE(has_kink(0.5 * half_gap, 0.6 * half_gap, 3.9));
  EXPECT_TRUE(has_kink(0.5 * half_gap, 0.6 * half_gap, 4.1));
}

}  // namespace
}  // namespace halyard
