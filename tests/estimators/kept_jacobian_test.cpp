/// Steps that keep the Jacobian and the φ functions of an earlier one, against steps with their own.

#include <gtest/gtest.h>

#include "estimators/process/exponential_step.h"
#include "tests/estimators/matrix/lane_matrices.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

constexpr double kLength = 1e-3;  // s

struct Belief {
  Eigen::VectorXd x;
  LaneMatrix FS;
};

class KeptJacobian : public testing::Test {
 protected:
  explicit KeptJacobian(const ArmModel& model = raven2()) : model_(model), process_(model) {}
  /// At home with joint speeds of `speed` times what is typical.
  Eigen::VectorXd moving(double speed) const {
    return at_speed(model_, process_, speed * Eigen::Vector3d(0.5, -0.5, 0.05));
  }
  Belief step(ExponentialStep& exponential, const Eigen::VectorXd& x, double time_s, double dt_s = kLength) const {
    Belief after{x, in_lanes(Eigen::MatrixXd::Zero(12, 12))};
    exponential.linearise({time_s, dt_s, torque_.data()}, x);
    EXPECT_TRUE(exponential.start(in_lanes(Eigen::MatrixXd::Identity(12, 12)), Eigen::MatrixXd(12, 0)));
    EXPECT_TRUE(exponential.advance_root(after.x, after.FS));
    return after;
  }
  /// A step that follows one from `before`, less one that follows none.
  Belief difference(const Eigen::VectorXd& before, const Eigen::VectorXd& x, double dt_s = kLength) const {
    ExponentialStep after(process_), alone(process_);
    step(after, before, 0);
    Belief b = step(after, x, kLength, dt_s);
    const Belief own = step(alone, x, kLength, dt_s);
    b.x -= own.x;
    b.FS.view() -= own.FS.view();
    return b;
  }
  double of_root(const Belief& b) const { return b.FS.view().cwiseAbs().maxCoeff(); }

  const ArmModel model_;
  const ProcessModel process_;
  const Eigen::Vector3d torque_{0.02, -0.02, 0.01};
};

TEST_F(KeptJacobian, MovesTheArmAsItsOwnDoes) {
  const Eigen::VectorXd before = moving(1);
  ExponentialStep exponential(process_);
  const Eigen::VectorXd x = step(exponential, before, 0).x;
  const Belief b = difference(before, x);
  EXPECT_GT(of_root(b), 0) << "the Jacobian was not kept";
  // Changes of the cables' and friction's rates below 1e-3 of 1/h, and the chain as it was a millisecond before.
  const Belief own = step(exponential, x, 1);
  for (int i = 0; i < 12; ++i) {
    EXPECT_LT(std::abs(b.x(i)), 3e-4 * std::abs(own.x(i) - x(i))) << i;
    EXPECT_LT(b.FS.view().row(i).norm(), 3e-3 * own.FS.view().row(i).norm()) << i;
  }
}

TEST_F(KeptJacobian, IsNewWhereFrictionHasChanged) {
  // From speeds beyond friction's smoothing to speeds within it, only the chain is kept. Friction's old slopes would be
  // wrong by more than a half.
  const Belief kept_chain = difference(moving(1), moving(0.01));
  ExponentialStep exponential(process_);
  const Belief own = step(exponential, moving(0.01), 0);
  for (int i = 0; i < 12; ++i) EXPECT_LT(kept_chain.FS.view().row(i).norm(), 5e-3 * own.FS.view().row(i).norm()) << i;
}

TEST_F(KeptJacobian, IsNewForAnotherLengthOfTheStep) {
  // A kept one would be wrong by a third.
  const Belief b = difference(moving(1), moving(1), 0.7 * kLength);
  ExponentialStep exponential(process_);
  const Belief own = step(exponential, moving(1), 0, 0.7 * kLength);
  for (int i = 0; i < 12; ++i) EXPECT_LT(b.FS.view().row(i).norm(), 1e-9 * own.FS.view().row(i).norm()) << i;
}

TEST_F(KeptJacobian, ServesAHalfAndAQuarterOfTheStep) {
  for (const double part : {0.5, 0.25}) {
    const Belief b = difference(moving(1), moving(1.0001), part * kLength);
    EXPECT_GT(of_root(b), 0) << "the Jacobian was not kept";
    ExponentialStep exponential(process_);
    const Belief own = step(exponential, moving(1.0001), 0, part * kLength);
    // Changes of the rates of a ten-thousandth.
    for (int i = 0; i < 12; ++i) {
      EXPECT_LT(b.FS.view().row(i).norm(), 1e-4 * own.FS.view().row(i).norm()) << i << ", " << part;
      EXPECT_LT(std::abs(b.x(i)), 1e-4 * std::abs(own.x(i) - moving(1.0001)(i))) << i << ", " << part;
    }
  }
}

TEST_F(KeptJacobian, IsKeptWhereLengthsDifferByRounding) {
  const Eigen::VectorXd before = moving(1);
  ExponentialStep exponential(process_);
  const Eigen::VectorXd x = step(exponential, before, 0).x;
  EXPECT_GT(of_root(difference(before, x, kLength * (1 + 1e-12))), 1e-9);
}

TEST_F(KeptJacobian, IsForgottenWithTheChain) {
  ExponentialStep after(process_), alone(process_);
  step(after, moving(1), 0);
  after.forget();
  const Eigen::VectorXd x = moving(0.99);
  const Belief b = step(after, x, kLength), own = step(alone, x, kLength);
  EXPECT_EQ(b.x, own.x);
  EXPECT_EQ(Eigen::MatrixXd(b.FS.view()), Eigen::MatrixXd(own.FS.view()));
}

TEST_F(KeptJacobian, IsRestored) {
  ExponentialStep exponential(process_);
  step(exponential, moving(1), 0);
  ExponentialStep::Kept kept;
  exponential.save(kept);
  const Eigen::VectorXd x = moving(1.0001);
  const Belief before = step(exponential, x, kLength);
  step(exponential, moving(0.01), 2 * kLength);  // has one of its own
  exponential.restore(kept);
  const Belief again = step(exponential, x, kLength);
  EXPECT_EQ(again.x, before.x);
  EXPECT_EQ(Eigen::MatrixXd(again.FS.view()), Eigen::MatrixXd(before.FS.view()));
}

TEST_F(KeptJacobian, ForcesAreAnsweredAnewWhenTheyChange) {
  const Eigen::VectorXd x = moving(1);
  const auto answer = [&](ExponentialStep& exponential, double size, double time_s) {
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(12, 1), Gamma(12, 1);
    G(process_.layout().rate[0]) = size;
    exponential.linearise({time_s, kLength, torque_.data()}, x);
    EXPECT_TRUE(exponential.start(in_lanes(Eigen::MatrixXd::Identity(12, 12)), G));
    EXPECT_TRUE(exponential.respond(Gamma));
    return Gamma;
  };
  ExponentialStep exponential(process_);
  const Eigen::MatrixXd once = answer(exponential, 1e-6, 0), same = answer(exponential, 1e-6, kLength),
                        twice = answer(exponential, 2e-6, kLength);
  EXPECT_LT((same - once).norm(), 1e-6 * once.norm());
  EXPECT_LT((twice - 2 * once).norm(), 1e-3 * twice.norm());
}

TEST_F(KeptJacobian, ForcesAreAnsweredAnewWhenTheLengthChanges) {
  const Eigen::VectorXd x = moving(1);
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(12, 1);
  G(process_.layout().rate[0]) = 1e-6;
  const auto answer = [&](ExponentialStep& exponential, double time_s, double dt_s) {
    Eigen::MatrixXd Gamma(12, 1);
    exponential.linearise({time_s, dt_s, torque_.data()}, x);
    EXPECT_TRUE(exponential.start(in_lanes(Eigen::MatrixXd::Identity(12, 12)), G));
    EXPECT_TRUE(exponential.respond(Gamma));
    return Gamma;
  };
  ExponentialStep exponential(process_), fresh(process_);
  const Eigen::MatrixXd whole = answer(exponential, 0, kLength), half = answer(exponential, kLength, kLength / 2),
                        own = answer(fresh, kLength, kLength / 2);
  EXPECT_GT((whole - own).norm(), 0.1 * own.norm());
  EXPECT_LT((half - own).norm(), 1e-6 * own.norm());
}

TEST_F(KeptJacobian, IsFollowedByTheSlopesOfFrictionThatAreNew) {
  // A motor's friction was saturated, and now has a slope of less than 1e-2 of 1/h.
  Eigen::VectorXd x = moving(1);
  x(*process_.layout().motor_rate[0]) = 3 * process_.arm().joint[0].motor_smoothing;
  const Belief b = difference(moving(1), x);
  ExponentialStep exponential(process_);
  const Belief own = step(exponential, x, 0);
  // Half of it was observed, in the root from the slopes of the chain; 9e-4 and 3e-3 if the new slope is neglected.
  EXPECT_LT(b.x.norm(), 1e-4 * (own.x - x).norm());
  EXPECT_LT(b.FS.view().norm(), 1e-3 * own.FS.view().norm());
}

ArmModel with_some_effects() {
  ArmModel model = raven2();
  add_effect(model, "motor_friction", 0, {});
  add_effect(model, "torque_ripple", 1, {});
  add_effect(model, "backlash", 2, {});
  return model;
}

class KeptJacobianWithEffects : public KeptJacobian {
 protected:
  KeptJacobianWithEffects() : KeptJacobian(with_some_effects()) {}
  /// The difference of a step from `x` after one from moving(1), relative to what it changes, state by state.
  void expect_near(const Eigen::VectorXd& x, double tolerance) const {
    const Belief b = difference(moving(1), x);
    ExponentialStep exponential(process_);
    const Belief own = step(exponential, x, 0);
    EXPECT_GT(of_root(b), 0);
    for (int i = 0; i < 12; ++i) {
      EXPECT_LT(std::abs(b.x(i)), tolerance * std::abs(own.x(i) - x(i))) << i;
      EXPECT_LT(b.FS.view().row(i).norm(), tolerance * own.FS.view().row(i).norm()) << i;
    }
  }
};

TEST_F(KeptJacobianWithEffects, IsFollowedByTheSlopesThatAreNew) {
  // The ripple's slope changes: by 1e-3 to 1e-2 of 1/h. What is neglected is of second order in this.
  Eigen::VectorXd x = moving(1);
  x(*process_.layout().motor_angle[1]) += 0.02;
  expect_near(x, 3e-4);
}

TEST_F(KeptJacobianWithEffects, IsNewBeyondAKink) {
  Eigen::VectorXd x = moving(1);
  const double half_gap = process_.transmission().effects()[2].p[0];
  x(*process_.layout().motor_angle[2]) += 1.1 * half_gap / process_.arm().joint[2].motor_travel();
  expect_near(x, 3e-3);  // the chain is kept
}

TEST_F(KeptJacobian, IsKeptForTenMillisecondsAndNotForEarlierSteps) {
  const Eigen::VectorXd x = moving(1.0001);
  for (const double later : {-1e-3, 9e-3, 11e-3}) {
    ExponentialStep after(process_), alone(process_);
    step(after, moving(1), 0);
    const Belief b = step(after, x, later), own = step(alone, x, later);
    const bool is_kept = later > 0 && later < 1e-2;
    EXPECT_EQ(Eigen::MatrixXd(b.FS.view()) != Eigen::MatrixXd(own.FS.view()), is_kept) << later;
  }
}

/// Checks F of a step from x, which follows one from `before`, by what the step makes of a root.
void expect_transition(const ProcessModel& process, const Eigen::Vector3d& torque, const Eigen::VectorXd& before,
                       const Eigen::VectorXd& x) {
  const int n = process.n_states();
  const Eigen::MatrixXd S = Eigen::VectorXd::LinSpaced(n, 1, 2).asDiagonal();
  ExponentialStep exponential(process);
  LaneMatrix FS = in_lanes(Eigen::MatrixXd::Zero(n, n)), F;
  for (const bool is_second : {false, true}) {
    Eigen::VectorXd moved = is_second ? x : before;
    exponential.linearise({is_second ? kLength : 0, kLength, torque.data()}, moved);
    ASSERT_TRUE(exponential.start(in_lanes(S), Eigen::MatrixXd(n, 0)));
    ASSERT_TRUE(exponential.advance_root(moved, FS));
  }
  ASSERT_TRUE(exponential.transition(F));
  const Eigen::MatrixXd expected = FS.view(), found = F.view() * S;
  for (int c = 0; c < n; ++c) EXPECT_LT((found - expected).col(c).norm(), 1e-12 * expected.col(c).norm()) << c;
}

TEST_F(KeptJacobian, TheTransitionMovesARootAsTheStepDoes) {
  Eigen::VectorXd followed = moving(1);  // by the new slopes of friction, as above
  followed(*process_.layout().motor_rate[0]) = 3 * process_.arm().joint[0].motor_smoothing;
  for (const Eigen::VectorXd& x : {moving(1.0001), followed, moving(0.01)})
    expect_transition(process_, torque_, moving(1), x);
}

TEST_F(KeptJacobianWithEffects, TheTransitionMovesARootAsTheStepDoes) {
  Eigen::VectorXd followed = moving(1);  // by the new slope of the ripple, as above
  followed(*process_.layout().motor_angle[1]) += 0.02;
  for (const Eigen::VectorXd& x : {moving(1.0001), followed, moving(0.01)})
    expect_transition(process_, torque_, moving(1), x);
}

TEST_F(KeptJacobian, IsRestoredAfterAStepOfAnotherLengthAtAnotherTime) {
  ExponentialStep exponential(process_);
  const Eigen::VectorXd x = step(exponential, moving(1), 0).x;  // with cables of other slopes
  ExponentialStep::Kept kept;
  exponential.save(kept);
  const Belief before = step(exponential, x, kLength);
  step(exponential, moving(1), 1, 0.7 * kLength);  // a second later: with a chain of its own
  exponential.restore(kept);
  const Belief again = step(exponential, x, kLength);
  EXPECT_EQ(again.x, before.x);
  EXPECT_EQ(Eigen::MatrixXd(again.FS.view()), Eigen::MatrixXd(before.FS.view()));
}

TEST_F(KeptJacobian, TheCurvatureOfTheChainIsRestoredWithIt) {
  const LaneMatrix S = in_lanes(Eigen::MatrixXd::Identity(12, 12));
  ExponentialStep exponential(process_);
  const auto shift_at = [&](double speed, double time_s) {
    Belief after{moving(speed), in_lanes(Eigen::MatrixXd::Zero(12, 12))};
    Eigen::VectorXd shift;
    exponential.linearise({time_s, kLength, torque_.data()}, after.x);
    EXPECT_TRUE(exponential.start(S, Eigen::MatrixXd(12, 0)));
    EXPECT_TRUE(exponential.advance_pairs(after.x, S, 1e-3, after.FS, shift));
    return shift;
  };
  step(exponential, moving(1), 0);  // which needs no curvature
  ExponentialStep::Kept without, with;
  exponential.save(without);
  const Eigen::VectorXd found = shift_at(1.0001, kLength);
  exponential.save(with);
  EXPECT_FALSE(without.has_curvature);
  EXPECT_TRUE(with.has_curvature);
  const Eigen::VectorXd kept = shift_at(1.0002, 2 * kLength);
  exponential.restore(without);
  EXPECT_EQ(shift_at(1.0001, kLength), found);
  exponential.restore(with);
  EXPECT_EQ(shift_at(1.0002, 2 * kLength), kept);
}

}  // namespace
}  // namespace halyard
