/// Arms of one structure in lanes, against each arm alone.

#include "estimators/identification/arm_family.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/estimators/process/lively_arm.h"

namespace halyard {
namespace {

constexpr int kMembers = 11;  // more than a register holds
const std::vector<std::string> kFamilyKeys = {"joint1.motor.inertia", "joint2.cable.stiffness", "joint3.motor.zero"};
constexpr double kFamilyTorque[3] = {0.3, -0.2, 0.1}, kFamilyLoad[3] = {0.5, 0.4, -0.3};
const Step kFamilyStep{0.25, 1e-3, kFamilyTorque, kFamilyLoad, nullptr};

/// Eleven arms, each at a state of its own.
class ArmFamilyOfEleven : public testing::Test {
 protected:
  ArmFamilyOfEleven()
      : model_(lively_arm()), process_(model_), family_(model_, process_, kFamilyKeys, kMembers), theta_(3, kMembers) {
    for (int i = 0; i < kMembers; ++i) {
      theta_.col(i) << 0.2 + 0.01 * i, 30 + i, 0.1 - 0.02 * i;
      X_.col(i) = lively_state(process_) + Eigen::VectorXd::Constant(12, 0.01 * i);
    }
    family_.set(theta_);
  }
  ArmModel member(int i) const {
    ArmModel own = model_;
    own.nominal.joint[0].rotor_inertia = theta_(0, i);
    own.nominal.joint[1].stiffness = theta_(1, i);
    own.nominal.joint[2].motor_encoder_offset = theta_(2, i);
    return own;
  }

  ArmModel model_;
  ProcessModel process_;
  ArmFamily family_;
  Eigen::MatrixXd theta_, X_{12, kMembers};
};

TEST_F(ArmFamilyOfEleven, EachMovesAsItsOwnModelDoes) {
  constexpr int kSubsteps = 2;
  Eigen::MatrixXd X = X_;
  family_.advance(kFamilyStep, kSubsteps, X);
  for (int i = 0; i < kMembers; ++i) {
    const ProcessModel own(member(i));
    Eigen::VectorXd x = X_.col(i);
    for (int part = 0; part < kSubsteps; ++part)
      runge_kutta_4(own.transmission(), own.layout(), 0.0, kFamilyStep.dt_s / kSubsteps, nullptr, kFamilyTorque,
                    kFamilyLoad, x.data());
    EXPECT_LT((X.col(i) - x).cwiseAbs().maxCoeff(), 1e-13) << i;  // rounding of numbers below 10
    EXPECT_GT((X.col(i) - X_.col(i)).cwiseAbs().minCoeff(), 1e-5) << i;
  }
}

TEST_F(ArmFamilyOfEleven, EachReadsItsOwnEncoders) {
  const Eigen::MatrixXd z = family_.readings(0.25, X_);
  ASSERT_EQ(z.rows(), 6);
  ASSERT_EQ(z.cols(), kMembers);
  const StateLayout& l = process_.layout();
  for (int i = 0; i < kMembers; ++i) {
    const ArmModel own = member(i);
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = own.nominal.joint[k];
      EXPECT_DOUBLE_EQ(z(k, i), X_(*l.motor_angle[k], i) + j.motor_encoder_offset) << k << " of " << i;
      EXPECT_DOUBLE_EQ(z(3 + k, i), X_(l.position[k], i) + j.joint_encoder_offset) << k << " of " << i;
    }
  }
}

TEST_F(ArmFamilyOfEleven, AResultThatIsNotFiniteIsToldWithStateAndTime) {
  Eigen::MatrixXd X = X_;
  X(process_.layout().rate[1], kMembers - 1) = std::numeric_limits<double>::infinity();
  try {
    family_.advance(kFamilyStep, 1, X);
    FAIL() << "accepted";
  } catch (const std::runtime_error& e) {
    const std::string text = e.what();
    EXPECT_TRUE(text.starts_with("process model: ")) << text;
    EXPECT_NE(text.find(" is not finite at 0.251 s; check"), std::string::npos) << text;
  }
}

TEST_F(ArmFamilyOfEleven, AStepWithoutTorquesAndForcesIsOneOfNone) {
  constexpr double kNone[3] = {};
  Eigen::MatrixXd given = X_, absent = X_;
  family_.advance({0.25, 1e-3, kNone, kNone, nullptr}, 1, given);
  family_.advance({0.25, 1e-3}, 1, absent);
  EXPECT_EQ(absent, given);
}

TEST(ArmFamily, OneMemberTakesAnyNumberOfStates) {
  const ArmModel model = lively_arm();
  const ProcessModel process(model);
  ArmFamily one(model, process, {}, 1);
  one.set(Eigen::MatrixXd(0, 1));
  Eigen::MatrixXd X(12, kMembers);
  for (int i = 0; i < kMembers; ++i) X.col(i) = lively_state(process) * (1 - 0.02 * i);
  const Eigen::MatrixXd z = one.readings(0, X);
  Eigen::MatrixXd moved = X;
  one.advance(kFamilyStep, 1, moved);
  for (int i = 0; i < kMembers; ++i) {
    Eigen::MatrixXd alone = X.col(i);
    EXPECT_EQ(one.readings(0, alone), z.col(i)) << i;
    one.advance(kFamilyStep, 1, alone);
    EXPECT_EQ(alone, moved.col(i)) << i;
  }
}

TEST(ArmFamily, AJointWithoutMotorReadsZeroThere) {
  ArmModel model = lively_arm();
  model.nominal.joint[1].drive = Drive::none;
  const ProcessModel process(model);
  const StateLayout& l = process.layout();
  ArmFamily one(model, process, {}, 1);
  one.set(Eigen::MatrixXd(0, 1));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(process.n_states(), 1, 2);
  Eigen::MatrixXd H;
  const Eigen::VectorXd z = one.readings(0, x, H);
  EXPECT_EQ(z(1), 0);
  EXPECT_EQ(z, Eigen::VectorXd(one.readings(0, Eigen::MatrixXd(x)).col(0)));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, process.n_states());
  for (int k = 0; k < 3; ++k) {
    if (k != 1) expected(k, *l.motor_angle[k]) = 1;
    expected(3 + k, l.position[k]) = 1;
  }
  EXPECT_EQ(H, expected);
}

TEST(ArmFamily, AnUnknownKeyIsRefused) {
  ArmParameters<double> arm = lively_arm().nominal;
  EXPECT_EQ(find_number(arm, "joint2.motor.zero").get(), arm.joint[1].motor_encoder_offset);
  EXPECT_THROW(find_number(arm, "joint4.motor.zero"), std::invalid_argument);
  EXPECT_THROW(find_number(arm, "joint1.motor.zer"), std::invalid_argument);
}

TEST(ArmFamily, ASensorThatLagsIsReadToSecondOrder) {
  ArmModel model = lively_arm();
  PlacedEffect delay = place_neutral_effect(*find_effect("delay"), model.nominal, 1);
  const double lag = 0.01, slow = 0.4, slope = 50;
  delay.p[1] = lag;
  model.effects = {delay};
  const ProcessModel process(model);
  ArmFamily one(model, process, {}, 1);
  one.set(Eigen::MatrixXd(0, 1));
  const Eigen::VectorXd x = lively_state(process);
  LaggedRates lagged;
  lagged.slow[1] = slow;
  lagged.slope[1] = slope;
  const double v = x(process.layout().rate[1]);
  Eigen::MatrixXd H;
  const double read = one.readings(0, x, H, lagged)(4), without = one.readings(0, x, H)(4);
  EXPECT_NEAR(read - without, lag * lag / 2 * slope * (v - slow), 1e-14);
  one.readings(0, x, H, lagged);
  EXPECT_NEAR(H(4, process.layout().rate[1]), -lag + lag * lag / 2 * slope, 1e-14);
  EXPECT_EQ(one.readings(0, Eigen::MatrixXd(x), lagged)(4, 0), read);
}

}  // namespace
}  // namespace halyard
