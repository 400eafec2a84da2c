#include "diagnosis/motion/lane_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "diagnosis/prediction/start/driven_start.h"
#include "tests/support/random_arm.h"

namespace halyard {
namespace {

constexpr double kDt = 2e-3;
constexpr std::size_t kSamples = 50;

/// The first n joints of a random arm; joints beyond the third repeat the first.
ArmParameters<double> arm_of(int n) {
  ArmParameters<double> arm = random_arm(7, CableLaw::linear);
  for (int k = arm.n; k < n; ++k) {
    arm.joint[k] = arm.joint[0];
    arm.joint[k].coupling[0] = 0;
    arm.joint[k].coupling[k] = 1;
  }
  arm.n = n;
  return arm;
}

std::vector<DrivenInput> swinging_motors(int n) {
  std::vector<DrivenInput> all(kSamples, DrivenInput{});
  for (std::size_t i = 0; i < kSamples; ++i)
    for (int k = 0; k < n; ++k) {
      const double rate = 3.0 + k, phase = rate * kDt * static_cast<double>(i);
      all[i].motor_angle[k] = 0.2 * std::sin(phase);
      all[i].motor_rate[k] = 0.2 * rate * std::cos(phase);
      all[i].motor_acceleration[k] = -0.2 * rate * rate * std::sin(phase);
      all[i].torque[k] = 0.1 * k;
    }
  return all;
}

template <class T>
DrivenState<T> at_rest() {
  DrivenState<T> x;
  for (T& q : x.q) q = T(0.01);
  for (T& v : x.v) v = T(0.0);
  return x;
}

TEST(LaneDrive, EveryLaneMovesLikeASingleArmForAnyNumberOfJointsAndInstructionSet) {
  RungeKuttaChebyshev scheme = scheme_for({{{{-100.0, 0.0}}}}, kDt);
  scheme.steps = 2;  // a replay has no steps of its own
  for (int n = 1; n <= kMaxJoints; ++n) {
    const ArmParameters<double> arm = arm_of(n);
    const std::vector<DrivenInput> motors = swinging_motors(n);
    const std::size_t size = kSamples * 2 * static_cast<std::size_t>(n);

    std::vector<double> single(size);
    DrivenState<double> x = at_rest<double>();
    drive_record(lift_transmission<double>(arm, {}), motors.data(), kSamples, 0.0, kDt, scheme, nullptr, x,
                 single.data(), static_cast<double*>(nullptr));

    for (const LaneDrive& kernels : lane_drives()) {
      const Transmission<Lanes> lanes = lift_transmission<Lanes>(arm, {});
      std::vector<Lanes> driven(size), states(size), replayed(size);
      DrivenState<Lanes> y = at_rest<Lanes>();
      kernels.drive(lanes, motors.data(), kSamples, 0.0, kDt, scheme, nullptr, y, driven.data(), states.data());
      kernels.replay(lanes, motors.data(), kSamples, 0.0, kDt, nullptr, states.data(), replayed.data());

      constexpr double kRounding = 1e-12;  // of some hundred stages with numbers of the order of one
      for (std::size_t i = 0; i < size; ++i)
        for (const int lane : {0, kLaneWidth - 1}) {
          EXPECT_NEAR(driven[i][lane], single[i], kRounding) << n << " joints";
          EXPECT_NEAR(replayed[i][lane], single[i], kRounding) << n << " joints";
        }
    }
    EXPECT_GT(std::abs(x.q[n - 1] - 0.01), 1e-4) << "the arm does not move";
  }
}

/// The same motion with a chain that is renewed at each of many small steps.
DrivenState<double> moved_with_a_new_chain_each_step(const ArmParameters<double>& arm,
                                                     const std::vector<DrivenInput>& motors) {
  constexpr int kSteps = 20;
  const double h = kDt / kSteps;
  const Transmission<double> transmission = lift_transmission<double>(arm, {});
  DrivenState<double> x = at_rest<double>(), middle, rate;
  for (std::size_t i = 0; i < motors.size(); ++i)
    for (int s = 0; s < kSteps; ++s) {
      const auto rate_at = [&](double share, const DrivenState<double>& y) {
        DrivenInput u;
        interpolate(arm.n, motors[i], motors[std::min(i + 1, motors.size() - 1)], kDt, share, u);
        HeldChain<double> chain;
        chain_at(arm, y.q, y.v, chain);
        driven_derivative<double>(transmission, &chain, 0.0, nullptr, u, y, rate, nullptr, nullptr);
      };
      rate_at(static_cast<double>(s) / kSteps, x);
      axpy(arm.n, 0, 0.5 * h, x, rate, middle);
      rate_at((s + 0.5) / kSteps, middle);
      axpy(arm.n, 0, h, x, rate, x);
    }
  return x;
}

TEST(LaneDrive, AHeldChainMovesAnArmLikeOneThatIsAlwaysNew) {
  RungeKuttaChebyshev scheme = scheme_for({{{{-100.0, 0.0}}}}, kDt);
  scheme.steps = 20;
  const ArmParameters<double> arm = arm_of(3);
  const std::vector<DrivenInput> motors = swinging_motors(3);
  DrivenState<double> x = at_rest<double>();
  std::vector<double> out(kSamples * 6);
  drive_record(lift_transmission<double>(arm, {}), motors.data(), kSamples, 0.0, kDt, scheme, nullptr, x, out.data(),
               static_cast<double*>(nullptr));
  const DrivenState<double> exact = moved_with_a_new_chain_each_step(arm, motors);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(x.q[k], exact.q[k], 1e-7) << "a hundredth of what a joint's encoder resolves";
    EXPECT_GT(std::abs(exact.v[k]), 0.05) << "it moves";
  }
}

/// A wheel on a cable whose runs become stiffer under load, with its motor held: both have closed forms.
struct HeldWheel {
  static constexpr double kTravel = 0.005, kInertia = 0.05, kSmoothing = 0.01;
  Hypothesis wheel;
  Record record;

  HeldWheel() {
    ArmParameters<double>& arm = wheel.nominal;
    arm.n = 1;
    JointParameters<double>& j = arm.joint[0];
    j.law = CableLaw::exponential;
    j.mass = 1, j.inertia[2] = kInertia;
    j.capstan_radius = kTravel, j.pulley_radius = 0.1, j.coupling[0] = 1;
    j.stiffness = 1000, j.damping = 1, j.tension = 5;
    j.joint_coulomb = 0.3, j.joint_viscous = 0.02, j.joint_smoothing = kSmoothing;
    record.n = 1;
    // The cable pulls with twice the tension of a run, at most.
    record.torque = {{0.02, -2 * j.tension * kTravel, 0.01}};
  }
  /// At rest, then in motion under the largest load.
  std::vector<Eigenvalues> spectra() const {
    return eigenvalues_of(wheel, record, DrivenInput{}, DrivenState<double>{});
  }
  /// 2 k_e r² / I of the unloaded cable, 1/s².
  static constexpr double kStiffness = 2 * 1000 * 0.1 * 0.1 / kInertia;
};

TEST(DrivenStart, AtRestDryFrictionDampsBesideTheCable) {
  const std::vector<Eigenvalues> spectra = HeldWheel().spectra();
  ASSERT_EQ(spectra.size(), 2u);
  const Eigenvalues& rest = spectra[0];
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_NEAR((rest[0] * rest[1]).real(), HeldWheel::kStiffness, 1e-9 * HeldWheel::kStiffness);
  const double damping = 2 * 1 * 0.1 * 0.1 + 0.3 / HeldWheel::kSmoothing + 0.02;
  EXPECT_NEAR((rest[0] + rest[1]).real(), -damping / HeldWheel::kInertia, 1e-9 * damping / HeldWheel::kInertia);
}

TEST(DrivenStart, InMotionTheCablePullsAsHardAsItsMotorAndDryFrictionDoesNotDamp) {
  const std::vector<Eigenvalues> spectra = HeldWheel().spectra();
  ASSERT_EQ(spectra.size(), 2u);
  const Eigenvalues& moving = spectra[1];
  ASSERT_EQ(moving.size(), 2u);
  // Where 2 sinh(a x) = 2, the slope is cosh(a x) = √2 times as large, and at twice that stretch cosh(2 a x) = 3 times.
  const double stiffness = (moving[0] * moving[1]).real();
  EXPECT_GE(stiffness, std::sqrt(2.0) * HeldWheel::kStiffness);
  EXPECT_LE(stiffness, 3 * HeldWheel::kStiffness);
  EXPECT_NEAR((moving[0] + moving[1]).real(), -(2 * 1 * 0.1 * 0.1 + 0.02) / HeldWheel::kInertia, 1e-4);
}

}  // namespace
}  // namespace halyard
