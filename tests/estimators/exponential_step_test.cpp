/// The exponential step against many small Runge-Kutta steps.

#include "estimators/process/exponential_step.h"

#include <gtest/gtest.h>

#include "tests/estimators/matrix/lane_matrices.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

constexpr double kStep = 1e-3;  // s

const Eigen::Vector3d kFast(0.5, -0.5, 0.05), kSlow(0.006, -0.006, 0.006);  // beyond friction's smoothing; within

/// A belief so wide that the guard accepts every mean, or so narrow that it accepts none.
LaneMatrix belief(double deviation) { return in_lanes(deviation * Eigen::MatrixXd::Identity(12, 12)); }

bool start(ExponentialStep& exponential, const Step& step, const Eigen::VectorXd& x, const LaneMatrix& S,
           const Eigen::MatrixXd& G = Eigen::MatrixXd(12, 0)) {
  exponential.linearise(step, x);
  return exponential.start(S, G);
}

struct Moved {
  Eigen::VectorXd exponential, exact;
};

Moved moved(const ProcessModel& process, const Eigen::VectorXd& x, double dt_s) {
  const Eigen::Vector3d torque(0.02, -0.02, 0.01);
  const Step step{0, dt_s, torque.data()};
  ExponentialStep exponential(process);
  EXPECT_TRUE(start(exponential, step, x, belief(1e6)));
  Moved m{x, x};
  LaneMatrix FS;
  FS.reshape(12, 12);
  EXPECT_TRUE(exponential.advance_root(m.exponential, FS));
  constexpr int kParts = 100;
  for (int i = 0; i < kParts; ++i) process.advance({0, dt_s / kParts, torque.data()}, m.exact.data());
  return m;
}

TEST(ExponentialStep, TheMeanIsOfSecondOrderAtLeast) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Eigen::VectorXd x = at_speed(model, process, kFast);
  const auto error = [&](double dt_s) {
    const Moved m = moved(process, x, dt_s);
    return (m.exponential - m.exact)(process.layout().rate[2]);
  };
  // A local error of h³ from the chain, which is taken as linear, a little more in stiff directions: 4 to 8 for half
  // the step. It is small: of the change of the speed, 1e-5 and less.
  EXPECT_GT(std::abs(error(2 * kStep)), 4 * std::abs(error(kStep)));
  const Moved m = moved(process, x, kStep);
  const int rate = process.layout().rate[2];
  EXPECT_LT(std::abs(error(kStep)), 1e-5 * std::abs(m.exact(rate) - x(rate)));
}

TEST(ExponentialStep, TheMeanIsExactEnoughWhereFrictionReverses) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Eigen::VectorXd x = at_speed(model, process, kSlow);
  const Moved m = moved(process, x, kStep);
  for (int k = 0; k < 3; ++k) {
    const int rate = process.layout().rate[k];
    EXPECT_NEAR(m.exponential(rate), m.exact(rate), 0.02 * std::abs(m.exact(rate) - x(rate))) << "joint " << k + 1;
  }
}

TEST(ExponentialStep, TheTransitionIsThatOfTheSubSteps) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  Eigen::VectorXd x = at_speed(model, process, kFast), y = x;
  const Eigen::Vector3d torque(0.02, -0.02, 0.01);
  const Step step{0, kStep, torque.data()};
  ExponentialStep exponential(process);
  LaneMatrix FS;
  FS.reshape(12, 12);
  Eigen::MatrixXd G(12, 12);
  ASSERT_TRUE(start(exponential, step, x, belief(1e6)));
  ASSERT_TRUE(exponential.advance_root(x, FS));
  process.advance_with_jacobian(step, y.data(), G);
  // A changes by about 1 % within a step at this speed.
  for (int c = 0; c < 12; ++c) EXPECT_LT((FS.view() / 1e6 - G).col(c).norm(), 0.02 * G.col(c).norm()) << c;
}

/// The mean of narrow sigma points less their centre, for one standard deviation.
Eigen::VectorXd curvature(const Eigen::MatrixXd& X, double spread) {
  const Eigen::Index pairs = (X.cols() - 1) / 2;
  return (X.rightCols(2 * pairs).colwise() - X.col(0)).rowwise().sum() / (2 * spread * spread);
}

TEST(ExponentialStep, TheCurvatureNearRestIsThatOfShortSteps) {
  // Joint 3 creeps under its weight, slower than its friction's smoothing speed; a deviation of its speed decays within
  // the step.
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const StateLayout& l = process.layout();
  const Eigen::Vector3d torque(0, 0, 0);
  Eigen::VectorXd x = at_speed(model, process, torque);
  for (int i = 0; i < 300; ++i) process.advance({0, kStep, torque.data()}, x.data());
  ASSERT_GT(std::abs(x(l.rate[2])), 2e-5);
  ASSERT_LT(std::abs(x(l.rate[2])), 5e-4);
  Eigen::MatrixXd S = 1e-6 * Eigen::MatrixXd::Identity(12, 12);
  S(l.rate[2], l.rate[2]) = 3e-4;
  S(*l.motor_rate[2], *l.motor_rate[2]) = 0.06;
  constexpr double kSpread = 1e-2;
  Eigen::MatrixXd Y(12, 25);
  Y << x, (kSpread * S).colwise() + x, (-kSpread * S).colwise() + x;
  ExponentialStep exponential(process);
  const Step step{0, kStep, torque.data()};
  ASSERT_TRUE(start(exponential, step, x, in_lanes(S)));
  LaneMatrix FS;
  FS.reshape(12, 12);
  Eigen::VectorXd shift;
  ASSERT_TRUE(exponential.advance_pairs(x, in_lanes(S), kSpread, FS, shift));
  constexpr int kParts = 20;
  for (int i = 0; i < kParts; ++i) process.advance_many({0, kStep / kParts, torque.data()}, Y);
  const double exact = curvature(Y, kSpread)(l.position[2]);
  // A straight line between the curvatures of both ends would give several times as much. 1 % was observed.
  EXPECT_NEAR(12 * shift(l.position[2]) / (kSpread * kSpread), exact, 0.05 * std::abs(exact));
}

TEST(ExponentialStep, PairsOfAnArmWithAnInternalStateMoveAsThoseOfShortSteps) {
  // As above; the effect is at another joint.
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 0, {});
  const ProcessModel process(model);
  ASSERT_FALSE(process.is_plain());
  const StateLayout& l = process.layout();
  Eigen::VectorXd x = at_speed(model, process, Eigen::Vector3d::Zero());
  for (int i = 0; i < 300; ++i) process.advance({0, kStep}, x.data());
  Eigen::MatrixXd S = 1e-6 * Eigen::MatrixXd::Identity(13, 13);
  S(l.rate[2], l.rate[2]) = 3e-4;
  S(*l.motor_rate[2], *l.motor_rate[2]) = 0.06;
  constexpr double kSpread = 1e-2;
  Eigen::MatrixXd Y(13, 27);
  Y << x, (kSpread * S).colwise() + x, (-kSpread * S).colwise() + x;
  ExponentialStep exponential(process);
  ASSERT_TRUE(start(exponential, {0, kStep}, x, in_lanes(S), Eigen::MatrixXd(13, 0)));
  LaneMatrix FS;
  FS.reshape(13, 13);
  Eigen::VectorXd shift;
  ASSERT_TRUE(exponential.advance_pairs(x, in_lanes(S), kSpread, FS, shift));
  constexpr int kParts = 20;
  for (int i = 0; i < kParts; ++i) process.advance_many({0, kStep / kParts}, Y);
  const double exact = curvature(Y, kSpread)(l.position[2]);
  EXPECT_NEAR(13 * shift(l.position[2]) / (kSpread * kSpread), exact, 0.05 * std::abs(exact));
  const Eigen::MatrixXd moved = (Y.middleCols(1, 13) - Y.rightCols(13)) / (2 * kSpread);
  // What changes within the step; 6e-5 was observed.
  for (int c = 0; c < 13; ++c) EXPECT_LT((FS.view() - moved).col(c).norm(), 1e-3 * moved.col(c).norm()) << c;
}

TEST(ExponentialStep, AHeldForceMovesTheArmAsTheModelMovesIt) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Eigen::VectorXd x = at_speed(model, process, kFast);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  ExponentialStep exponential(process);
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(12, 3), Gamma(12, 3);
  const auto torque_of = [&](int k) { return 0.01 * process.arm().joint[k].motor_coulomb; };
  for (int k = 0; k < 3; ++k)
    G(*process.layout().motor_rate[k], k) = torque_of(k) / process.arm().joint[k].rotor_inertia * kStep;
  ASSERT_TRUE(start(exponential, {0, kStep, none.data(), none.data()}, x, belief(1e6), G));
  ASSERT_TRUE(exponential.respond(Gamma));
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d torque = none;
    torque(k) = torque_of(k);
    Eigen::VectorXd free = x, forced = x;
    process.advance({0, kStep, none.data(), none.data()}, free.data());
    process.advance({0, kStep, torque.data(), none.data()}, forced.data());
    const int rate = *process.layout().motor_rate[k];
    EXPECT_NEAR(Gamma(rate, k), (forced - free)(rate), 0.03 * std::abs((forced - free)(rate))) << "joint " << k + 1;
  }
}

TEST(ExponentialStep, AHeldForceMovesAnArmWithAnInternalStateAsTheModelMovesIt) {
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 2, {});
  const ProcessModel process(model);
  ASSERT_FALSE(process.is_plain());
  const Eigen::VectorXd x = at_speed(model, process, kFast);
  constexpr int kCopies = 4;  // of three forces: more than a register holds
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(13, 3), Gamma(13, 3 * kCopies);
  const auto torque_of = [&](int k) { return 0.01 * process.arm().joint[k].motor_coulomb; };
  for (int k = 0; k < 3; ++k)
    G(*process.layout().motor_rate[k], k) = torque_of(k) / process.arm().joint[k].rotor_inertia * kStep;
  ExponentialStep exponential(process);
  ASSERT_TRUE(
      start(exponential, {0, kStep}, x, in_lanes(1e6 * Eigen::MatrixXd::Identity(13, 13)), G.replicate(1, kCopies)));
  ASSERT_TRUE(exponential.respond(Gamma));
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    torque(k) = torque_of(k);
    Eigen::VectorXd free = x, forced = x;
    process.advance({0, kStep}, free.data());
    process.advance({0, kStep, torque.data()}, forced.data());
    const Eigen::VectorXd moved = forced - free;
    for (int c = k; c < 3 * kCopies; c += 3)
      EXPECT_LT((Gamma.col(c) - moved).norm(), 0.03 * moved.norm()) << c;  // as without the effect
  }
}

TEST(ExponentialStep, ImpulsesBeyondFrictionsSmoothingMoveTheArmAsTheModelMovesIt) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  Eigen::VectorXd x = at_speed(model, process, Eigen::Vector3d::Zero());
  for (int i = 0; i < 300; ++i) process.advance({0, kStep}, x.data());  // until it creeps under its weight
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(12, 6), Gamma(12, 6);
  for (int k = 0; k < 3; ++k) {
    G(*process.layout().motor_rate[k], k) = 2 * process.arm().joint[k].motor_smoothing;
    G(process.layout().rate[k], 3 + k) = 2 * process.arm().joint[k].joint_smoothing;
  }
  ExponentialStep exponential(process);
  ASSERT_TRUE(start(exponential, {0, kStep}, x, belief(1e6), G));
  ASSERT_TRUE(exponential.respond(Gamma));
  for (int i = 0; i < 6; ++i) {
    Eigen::VectorXd free = x, forced = x + G.col(i), exact = G.col(i) / 6;
    for (const int half : {0, 1}) {
      const Step step{half * kStep / 2, kStep / 2};
      process.advance(step, free.data());
      process.advance(step, forced.data());
      exact += (half == 0 ? 4 : 1) / 6.0 * (forced - free);
    }
    // The mean does not move quite straight.
    EXPECT_LT((Gamma.col(i) - exact).norm(), 0.02 * exact.norm()) << i;
  }
}

TEST(ExponentialStep, AForceAndTheMeanMoveAlikeBesideMoreForcesThanARegisterHolds) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Eigen::VectorXd x = at_speed(model, process, kFast);
  const Eigen::Vector3d torque(0.02, -0.02, 0.01);
  const Step step{0, kStep, torque.data()};
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(12, 3);
  for (int k = 0; k < 3; ++k) G(*process.layout().motor_rate[k], k) = 1e-3 * (k + 1);
  const auto forced = [&](const Eigen::MatrixXd& forces, Eigen::VectorXd& mean) {
    ExponentialStep exponential(process);
    EXPECT_TRUE(start(exponential, step, x, belief(1e6), forces));
    Eigen::MatrixXd Gamma(12, forces.cols());
    EXPECT_TRUE(exponential.respond(Gamma));
    LaneMatrix FS;
    FS.reshape(12, 12);
    EXPECT_TRUE(exponential.advance_root(mean, FS));
    return Gamma;
  };
  Eigen::VectorXd mean(12), mean_beside_many(12);
  const Eigen::MatrixXd alone = forced(G, mean), many = forced(G.replicate(1, 3 * kLaneWidth), mean_beside_many);
  // Rounding, in products of 12 terms in another order.
  EXPECT_LT((mean_beside_many - mean).cwiseAbs().maxCoeff(), 100 * kEps * mean.cwiseAbs().maxCoeff());
  EXPECT_LT((many - alone.replicate(1, 3 * kLaneWidth)).cwiseAbs().maxCoeff(),
            100 * kEps * alone.cwiseAbs().maxCoeff());
}

TEST(ExponentialStep, TheGuardRefusesAMeanThatIsNotSureEnough) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  Eigen::VectorXd x = at_speed(model, process, kSlow);
  const Eigen::Vector3d torque(0.02, -0.02, 0.01);
  ExponentialStep exponential(process);
  EXPECT_FALSE(start(exponential, {0, kStep, torque.data()}, x, belief(1e-9)));
  LaneMatrix FS;
  FS.reshape(12, 12);
  Eigen::VectorXd shift;
  EXPECT_FALSE(exponential.advance_root(x, FS));
  EXPECT_FALSE(exponential.advance_pairs(x, belief(1e-9), 1e-3, FS, shift));
}

TEST(ExponentialStep, AMeanThatTheGuardAcceptsIsSureEnoughWithEffects) {
  ArmModel model = raven2();
  add_effect(model, "torque_ripple", 1, {});
  add_effect(model, "backlash", 2, {});
  const ProcessModel process(model);
  const Eigen::Vector3d torque(0.02, -0.02, 0.01);
  int accepted = 0, refused = 0;
  for (const double angle : {0.0, 0.02, 0.04, 0.06})  // of motor 3, within its gap and beyond
    for (const Eigen::Vector3d& speed : {kFast, kSlow}) {
      Eigen::VectorXd x = at_speed(model, process, speed);
      x(*process.layout().motor_angle[2]) += angle;
      const Moved m = moved(process, x, kStep);
      for (double deviation = 1; deviation > 1e-8; deviation /= 2) {
        ExponentialStep exponential(process);
        if (!start(exponential, {0, kStep, torque.data()}, x, belief(deviation))) {
          ++refused;
          continue;
        }
        ++accepted;
        Eigen::VectorXd after = x;
        LaneMatrix FS;
        FS.reshape(12, 12);
        ASSERT_TRUE(exponential.advance_root(after, FS));
        for (int i = 0; i < 12; ++i)
          EXPECT_LT(std::abs(after(i) - m.exact(i)), 0.05 * FS.view().row(i).norm())
              << i << " at " << angle << ", deviation " << deviation;
      }
    }
  EXPECT_GT(accepted, 20);
  EXPECT_GT(refused, 20);
}

TEST(ExponentialStep, TheGuardRefusesWhatIsNotFinite) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  Eigen::VectorXd x = at_speed(model, process, kFast);
  x(3) = kNan;
  ExponentialStep exponential(process);
  EXPECT_FALSE(start(exponential, {0, kStep}, x, belief(1)));
}

}  // namespace
}  // namespace halyard
