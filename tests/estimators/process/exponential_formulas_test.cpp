/// The exponential step by the formulas of its header, on a slide whose numbers are of the order of one. The chain of a
/// single slide is linear: nothing of it is neglected.

#include "estimators/process/exponential_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/estimators/matrix/lane_matrices.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

constexpr double kFormulaStep = 0.02, kFormulaTime = 0.3;  // s
constexpr double kFormulaTorque[1] = {0.3}, kFormulaLoad[1] = {0.5};
constexpr double kFormulaTolerance = 1e-8;                    // roundings of rates of up to 20, and of products
constexpr int kMotorRate = 2, kJointRate = 3, kSources = 11;  // more sources than a register holds
constexpr PhiShape kSlideShape{4, 2, 4};
const Eigen::Vector4d kFormulaState(0.8, 0.25, -0.5, 0.3);  // q_m, q and their rates; a stretch of 0.2 m

/// A slide on a cable that is curved, with friction that is far from saturated.
ArmModel curved_slide() {
  ArmModel model;
  model.nominal.n = 1;
  JointParameters<double>& j = model.nominal.joint[0];
  j.type = JointType::prismatic;
  j.mass = 1.5;
  j.rotor_inertia = 0.2;
  j.motor_coulomb = 0.3;
  j.motor_viscous = 0.07;
  j.motor_smoothing = 0.5;
  j.gear_ratio = 2;
  j.capstan_radius = 1;
  j.pulley_radius = 0.8;
  j.coupling[0] = 1;
  j.stiffness = 20;
  j.damping = 1;
  j.joint_coulomb = 0.4;
  j.joint_viscous = 0.1;
  j.joint_smoothing = 0.4;
  model.joints.resize(1);
  model.joints[0] = {.name = "slide", .lower = -1, .upper = 1, .home = 0, .controller = {}, .tolerances = {}};
  return model;
}

/// Without effects; with friction that depends on the time; and with an effect, idle here, that makes it not plain.
std::vector<ArmModel> formula_slides() {
  const ArmModel bare = curved_slide();
  ArmModel drifting = bare;
  add_effect(drifting, "friction_drift", 0, {2, 0.2, 1, 1});
  ArmModel not_plain = drifting;
  add_effect(not_plain, "delay", 0, {});
  return {bare, drifting, not_plain};
}

Step formula_step(double time_s, double dt_s = kFormulaStep) {
  return {time_s, dt_s, kFormulaTorque, kFormulaLoad, nullptr};
}

Eigen::MatrixXd deviation_root() {
  Eigen::MatrixXd S(4, 4);
  S << 0.5, 0, 0, 0, 0.1, 0.4, 0, 0, -0.2, 0.3, 1, 0, 0.2, -0.1, 0.3, 0.8;
  return S;
}

Eigen::MatrixXd rate_impulses() {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(4, kSources);
  for (int i = 0; i < kSources; ++i) {
    G(kMotorRate, i) = 0.02 * std::cos(0.7 * i);
    G(kJointRate, i) = 0.02 * std::sin(0.7 * i);
  }
  return G;
}

struct FormulaFunctions {
  Eigen::MatrixXd E, phi_1, phi_2, phi_3;
};

/// Of the step times A, without the form of a mechanical system.
FormulaFunctions functions_by_formula(const Eigen::MatrixXd& A) {
  PhiFunctions phi;
  const int n = static_cast<int>(A.rows());
  EXPECT_TRUE(phi.compute(kFormulaStep, A, {n, 0, n}));
  const PhiFunctions::Level& whole = phi.level(0);
  return {whole.E.view(), whole.phi_1.view(), whole.phi_2.view(), whole.phi_3.view()};
}

/// Those that an exponential step has, with all its levels.
void compute_balanced(PhiFunctions& phi, const ProcessModel& process, double dt_s, const Eigen::MatrixXd& A) {
  Eigen::VectorXd f;
  Eigen::MatrixXd at_zero;
  process.linearise(Step{.dt_s = 1e-3}, Eigen::VectorXd::Zero(4), f, at_zero);
  phi.balance(1e-3 * at_zero);
  ASSERT_TRUE(phi.compute(dt_s, A, kSlideShape));
}

/// A step from x by the formulas.
struct ByFormula {
  const ProcessModel& process;
  Step step, end;
  Eigen::VectorXd x, f, x_2, f_2;
  Eigen::MatrixXd A, B, A_2;  ///< B: what the slopes at x are more than A
  FormulaFunctions of;

  /// kept: the Jacobian of an earlier step; null: that at x.
  ByFormula(const ProcessModel& model, double time_s, const Eigen::VectorXd& from,
            const Eigen::MatrixXd* kept = nullptr)
      : process(model), step(formula_step(time_s)), end(formula_step(time_s + kFormulaStep)), x(from) {
    Eigen::MatrixXd own;
    f = process.derivative(step, x, &own);
    A = own;
    if (kept) A = *kept;
    B = own - A;
    of = functions_by_formula(A);
    x_2 = x + kFormulaStep * of.phi_1 * f;
    f_2 = process.derivative(end, x_2, &A_2);
  }

  Eigen::VectorXd mean(bool follows = true) const {
    const Eigen::VectorXd u = x_2 - x, D = f_2 - f - A * u;
    Eigen::VectorXd L = Eigen::VectorXd::Zero(4);
    if (follows) L = B * u;
    return x_2 + 2 * kFormulaStep * of.phi_3 * (D - L) + kFormulaStep * of.phi_2 * L;
  }
  Eigen::MatrixXd transition() const {
    const Eigen::MatrixXd change = (A_2 - A) * of.E - B;
    return of.E + kFormulaStep * of.phi_1 * B + kFormulaStep * of.phi_2 * change;
  }
  Eigen::MatrixXd response(const Eigen::MatrixXd& G) const {
    const Eigen::MatrixXd middle = functions_by_formula(A / 2).E * G, last = of.E * G;
    const Eigen::MatrixXd linear = (G + 4 * middle + last) / 6;
    Eigen::MatrixXd N(4, G.cols());
    for (int i = 0; i < G.cols(); ++i)
      N.col(i) = process.derivative(end, x_2 + linear.col(i)) - f_2 - A * linear.col(i);
    return linear + kFormulaStep * of.phi_2 * N;
  }
  /// N°, the odd part of what the rates are more than linear.
  Eigen::VectorXd odd(const Step& at, const Eigen::VectorXd& about, const Eigen::VectorXd& d) const {
    return 0.5 * (process.derivative(at, about + d) - process.derivative(at, about - d)) - A * d;
  }
  Eigen::VectorXd even(const Step& at, const Eigen::VectorXd& about, const Eigen::VectorXd& rates,
                       const Eigen::VectorXd& d) const {
    return 0.5 * (process.derivative(at, about + d) + process.derivative(at, about - d)) - rates;
  }
};

void expect_step(ExponentialStep& exponential, const ByFormula& expected) {
  Eigen::VectorXd x = expected.x;
  LaneMatrix FS = in_lanes(Eigen::MatrixXd::Zero(4, 4)), F;
  Eigen::MatrixXd Gamma(4, kSources);
  ASSERT_TRUE(exponential.respond(Gamma));
  ASSERT_TRUE(exponential.advance_root(x, FS));
  ASSERT_TRUE(exponential.transition(F));
  EXPECT_LT((x - expected.mean()).norm(), kFormulaTolerance * (x - expected.x).norm());
  const Eigen::MatrixXd transition = expected.transition(), moved = transition * deviation_root(),
                        response = expected.response(rate_impulses());
  EXPECT_LT((FS.view() - moved).norm(), kFormulaTolerance * moved.norm());
  EXPECT_LT((F.view() - transition).norm(), kFormulaTolerance * transition.norm());
  EXPECT_LT((Gamma - response).norm(), kFormulaTolerance * response.norm());
}

/// kFormulaState with another rate of the motor, by which a slope has changed by so much of the step's rate.
Eigen::VectorXd state_where_off(const ProcessModel& process, double off) {
  const auto slope_at = [&](double rate) {
    Eigen::VectorXd x = kFormulaState;
    x(kMotorRate) = rate;
    Eigen::MatrixXd A;
    process.derivative(formula_step(kFormulaTime), x, &A);
    return A(kMotorRate, kMotorRate);
  };
  double low = kFormulaState(kMotorRate), high = -0.2;  // up to an off of 0.026
  const double start = slope_at(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (kFormulaStep * std::abs(slope_at(middle) - start) < off ? low : high) = middle;
  }
  Eigen::VectorXd x = kFormulaState;
  x(kMotorRate) = high;
  return x;
}

/// Starts the first step, and then the second, which keeps the Jacobian of the first.
void start_beside(ExponentialStep& exponential, const ByFormula& first, const ByFormula& second) {
  for (const ByFormula* each : {&first, &second}) {
    exponential.linearise(each->step, each->x);
    ASSERT_TRUE(exponential.start(in_lanes(deviation_root()), rate_impulses()));
  }
  ExponentialStep::Kept kept;
  exponential.save(kept);
  ASSERT_EQ(kept.A, first.A) << "it was not kept";
}

using Expect = void (*)(ExponentialStep&, const ByFormula&);

/// Calls expect(step, formulas) for the first step of each slide.
void expect_of_first_steps(Expect expect) {
  for (const ArmModel& model : formula_slides()) {
    SCOPED_TRACE(model.effects.size());
    const ProcessModel process(model);
    const ByFormula expected(process, kFormulaTime, kFormulaState);
    ExponentialStep exponential(process);
    exponential.linearise(expected.step, expected.x);
    ASSERT_TRUE(exponential.start(in_lanes(deviation_root()), rate_impulses()));
    expect(exponential, expected);
  }
}

/// The same for a step of each slide that keeps the Jacobian of the step before.
void expect_of_kept_jacobians(Expect expect) {
  for (const ArmModel& model : formula_slides()) {
    SCOPED_TRACE(model.effects.size());
    const ProcessModel process(model);
    const ByFormula first(process, kFormulaTime, kFormulaState);
    const ByFormula expected(process, kFormulaTime + 5e-3, state_where_off(process, 3e-3), &first.A);
    ExponentialStep exponential(process);
    start_beside(exponential, first, expected);
    expect(exponential, expected);
  }
}

TEST(ExponentialFormulas, AStepIsThatOfTheHeader) { expect_of_first_steps(expect_step); }

TEST(ExponentialFormulas, AStepThatKeepsAJacobianFollowsWhatTheSlopesAreMore) { expect_of_kept_jacobians(expect_step); }

/// Checks the pairs x ± gamma S_i of a step that has been started.
void expect_pairs(ExponentialStep& exponential, const ByFormula& e) {
  constexpr double kGamma = 1e-3;
  const bool smooth = e.process.is_plain();
  const Eigen::MatrixXd S = deviation_root();
  Eigen::MatrixXd expected_FS(4, 4);
  Eigen::VectorXd first = Eigen::VectorXd::Zero(4), last = first;
  for (int i = 0; i < 4; ++i) {
    const Eigen::VectorXd d = kGamma * S.col(i), odd = e.odd(e.step, e.x, d);
    Eigen::VectorXd d_2 = e.of.E * d;
    if (!smooth) d_2 += kFormulaStep * e.of.phi_1 * odd;
    first += kFormulaStep / 4 * e.even(e.step, e.x, e.f, d);
    last += kFormulaStep / 4 * e.even(e.end, e.x_2, e.f_2, d_2);
    expected_FS.col(i) = (d_2 + kFormulaStep * e.of.phi_2 * (e.odd(e.end, e.x_2, d_2) - odd)) / kGamma;
  }
  if (smooth) expected_FS = e.transition() * S;
  PhiFunctions phi;
  compute_balanced(phi, e.process, kFormulaStep, e.A);
  LaneMatrix expected_shift;
  const Eigen::VectorXd end_squares = (phi.level(0).E.view() * S).rowwise().squaredNorm();
  MeanShift(kSlideShape).compute(phi, 0, in_lanes(S.transpose()), end_squares, first, last, expected_shift);

  Eigen::VectorXd x = e.x, shift;
  LaneMatrix FS = in_lanes(Eigen::MatrixXd::Zero(4, 4));
  ASSERT_TRUE(exponential.advance_pairs(x, in_lanes(S), kGamma, FS, shift));
  EXPECT_LT((x - e.mean()).norm(), kFormulaTolerance * (x - e.x).norm());
  EXPECT_LT((FS.view() - expected_FS).norm(), kFormulaTolerance * expected_FS.norm());
  const double largest = expected_shift.view().cwiseAbs().maxCoeff();
  // Of fourth order in the points: 1e-5 of it.
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(shift(i), expected_shift.view()(i, 0), 1e-4 * std::abs(expected_shift.view()(i, 0)) + 1e-6 * largest)
        << i;
}

TEST(ExponentialFormulas, PairsAreThoseOfTheHeader) { expect_of_first_steps(expect_pairs); }

TEST(ExponentialFormulas, PairsFollowWhatTheSlopesAreMoreThanAKeptJacobian) { expect_of_kept_jacobians(expect_pairs); }

/// The least deviation of all states at which the guard is to accept a step.
double least_deviation(const ByFormula& e) {
  const Eigen::VectorXd u = e.x_2 - e.x, D = e.f_2 - e.f - e.A * u, uneven = D - 0.5 * ((e.A_2 - e.A) * u);
  const Eigen::VectorXd of_E = e.of.E.rowwise().norm();
  const auto deviation_for = [&](const Eigen::VectorXd& rates, double tolerance) {
    const Eigen::VectorXd c = 2 * kFormulaStep * e.of.phi_3 * rates;
    return c.cwiseAbs().cwiseQuotient(of_E).maxCoeff() / tolerance;
  };
  const double usual = deviation_for(D, 0.05);
  if (!e.process.has_effects()) return usual;
  return std::min(usual, std::max(deviation_for(D, 0.2), deviation_for(uneven, 0.05)));
}

TEST(ExponentialFormulas, TheGuardAsksForATwentiethOfADeviationOrAFifthWhereTheRatesAreCurvedEvenly) {
  for (const ArmModel& model : formula_slides()) {
    const ProcessModel process(model);
    // With effects: evenly curved, reversing, and in between.
    for (const double rate : {-0.5, 0.15, 0.2}) {
      Eigen::VectorXd x = kFormulaState;
      x(kMotorRate) = rate;
      const double least = least_deviation(ByFormula(process, kFormulaTime, x));
      for (const double share : {0.99, 1.01}) {
        ExponentialStep exponential(process);
        exponential.linearise(formula_step(kFormulaTime), x);
        const LaneMatrix S = in_lanes(share * least * Eigen::MatrixXd::Identity(4, 4));
        EXPECT_EQ(exponential.start(S, Eigen::MatrixXd(4, 0)), share > 1) << model.effects.size() << ", " << rate;
      }
    }
  }
}

TEST(ExponentialFormulas, AJacobianIsKeptUntilASlopeHasChangedByAHundredthOfTheStepsRate) {
  for (const ArmModel& model : formula_slides()) {
    const ProcessModel process(model);
    for (const double off : {0.99e-2, 1.01e-2}) {
      ExponentialStep exponential(process);
      ExponentialStep::Kept first, second;
      exponential.linearise(formula_step(kFormulaTime), kFormulaState);
      exponential.save(first);
      exponential.linearise(formula_step(kFormulaTime), state_where_off(process, off));
      exponential.save(second);
      EXPECT_EQ(second.A == first.A, off < 1e-2) << model.effects.size() << ", " << off;
    }
  }
}

TEST(ExponentialFormulas, AChangeOfSlopesIsFollowedFromAThousandthOfTheStepsRateOn) {
  for (const ArmModel& model : formula_slides()) {
    const ProcessModel process(model);
    const ByFormula first(process, kFormulaTime, kFormulaState);
    for (const double off : {0.99e-3, 1.01e-3}) {
      const ByFormula expected(process, kFormulaTime, state_where_off(process, off), &first.A);
      ExponentialStep exponential(process);
      start_beside(exponential, first, expected);
      Eigen::VectorXd x = expected.x;
      LaneMatrix FS = in_lanes(Eigen::MatrixXd::Zero(4, 4));
      ASSERT_TRUE(exponential.advance_root(x, FS));
      const double tolerance = kFormulaTolerance * (x - expected.x).norm();
      EXPECT_LT((x - expected.mean(off > 1e-3)).norm(), tolerance) << model.effects.size() << ", " << off;
      EXPECT_GT((x - expected.mean(off < 1e-3)).norm(), 100 * tolerance) << model.effects.size() << ", " << off;
    }
  }
}

TEST(ExponentialFormulas, AJacobianServesHalvesOfItsStepAsFarAsItsFunctionsWereHalved) {
  constexpr double kLong = 1;  // s
  const ProcessModel process(curved_slide());
  Eigen::MatrixXd A;
  process.derivative(formula_step(kFormulaTime, kLong), kFormulaState, &A);
  PhiFunctions phi;
  compute_balanced(phi, process, kLong, A);
  ASSERT_GE(phi.doublings(), 2);
  for (int k = 0; k <= phi.doublings(); ++k) {
    const double part = std::ldexp(kLong, -k);
    ExponentialStep exponential(process);
    exponential.linearise(formula_step(kFormulaTime, kLong), kFormulaState);
    exponential.linearise(formula_step(kFormulaTime, part), kFormulaState);  // it was refused, and is halved
    ExponentialStep::Kept kept;
    exponential.save(kept);
    EXPECT_EQ(kept.phi_dt_s, k < phi.doublings() ? kLong : part) << k;
  }
}

TEST(ExponentialFormulas, StepsWhoseLengthsDifferByABillionthAreAsLong) {
  const ProcessModel process(curved_slide());
  for (const double relative : {0.9e-9, -0.9e-9, 1.1e-9, -1.1e-9}) {
    ExponentialStep exponential(process);
    exponential.linearise(formula_step(kFormulaTime), kFormulaState);
    exponential.linearise(formula_step(kFormulaTime, kFormulaStep * (1 + relative)), kFormulaState);
    ExponentialStep::Kept kept;
    exponential.save(kept);
    EXPECT_EQ(kept.phi_dt_s == kFormulaStep, std::abs(relative) < 1e-9) << relative;
  }
}

}  // namespace
}  // namespace halyard
