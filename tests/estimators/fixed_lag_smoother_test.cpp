// The fixed-lag smoother: against the textbook's where that is exact, and against the filter on the arm.
#include "estimators/filters/fixed_lag_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "estimators/built_in.h"
#include "estimators/filters/ekf.h"
#include "model/input_error.h"
#include "plant/simulate.h"
#include "tests/support/arm_runs.h"
#include "tests/support/linear_gaussian.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

/// Largest differences of smoothed means and covariances from those of the textbook's recursion in long double.
double largest_difference_smoothed(GaussianFilter& filter, const LinearGaussian& p) {
  RecyclingQueue<FilteredBelief> window;
  RecyclingQueue<BackwardStep> steps;
  std::vector<KalmanFilter> textbook;
  KalmanFilter kalman(p);
  filter.reset(p.x_0, initial_root());
  for (const Eigen::VectorXd& z : p.z) {
    const Eigen::VectorXd x_0 = filter.x();
    const LaneMatrix S_0 = filter.root();
    filter.predict(LinearProcess(p.F), p.Q_root);
    FilteredBelief& belief = window.append();
    filter.backward_step(x_0, S_0, steps.append());
    filter.update(LinearReadings(p.H, true), z, p.R_root, kNoGate);
    belief.x = filter.x();
    belief.S = filter.root();
    kalman.step(p, z);
    textbook.push_back(kalman);
  }
  const KalmanFilter::Matrix F = p.F.cast<long double>(), Q = KalmanFilter::squared(p.Q_root);
  for (std::size_t i = textbook.size() - 1; i-- > 0;) {
    KalmanFilter& now = textbook[i];
    const KalmanFilter& next = textbook[i + 1];
    const KalmanFilter::Matrix P = F * now.P * F.transpose() + Q, G = P.llt().solve(F * now.P).transpose();
    now.x += G * (next.x - F * now.x);
    now.P = (now.P + G * (next.P - P) * G.transpose()).eval();
  }
  double largest = 0;
  BackwardPass pass;
  pass.start(window.back());
  for (std::size_t i = window.size(); i-- > 0;) {
    largest = std::max(largest, textbook[i].difference(pass.x(), pass.S()));
    pass.go_back_before(steps[i]);
  }
  return largest;
}

TEST(FixedLagSmoother, IsTheRauchTungStriebelSmootherOnALinearProblem) {
  const LinearGaussian problem(200);
  ExtendedKalmanFilter ekf;
  SquareRootUkf wide({.alpha = 1});
  // Roundings of numbers up to 10, 2e-15 each, forgotten within a few steps. Observed: 1e-15.
  EXPECT_LT(largest_difference_smoothed(ekf, problem), 1e-14);
  EXPECT_LT(largest_difference_smoothed(wide, problem), 1e-14);
}

/// The smoothed estimates of a run by the time that they belong to.
std::map<double, Estimate> smoothed(Estimator& estimator, const std::vector<Sample>& samples) {
  std::map<double, Estimate> all;
  const auto take = [&](bool at_end) {
    while (const auto revision = estimator.revise(at_end)) {
      EXPECT_FALSE(all.contains(revision->time_s)) << "told twice: " << revision->time_s;
      all[revision->time_s] = revision->estimate;
    }
  };
  estimator.reset(samples[0]);
  take(false);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    estimator.update(samples[i]);
    take(i + 1 == samples.size());
  }
  return all;
}

/// The RAVEN-II on sines, with the noise that the filters assume.
ArmRun noisy_run(std::uint64_t seed) {
  Scenario s;
  s.robot = raven2();
  s.duration_s = 1.5;
  s.fade_in_s = 0.3;
  s.quantise = false;
  s.seed = seed;
  const ProcessModel process(s.robot);
  const EstimatorOptions none;
  OptionReader options("test", none);
  const NoiseLevels levels = read_noise(options, s.robot, process);
  const double held = std::sqrt(2 * levels.correlation_time / s.control_period_s);
  for (int k = 0; k < 3; ++k) {
    JointTrajectory t;
    t.kind = JointTrajectory::Kind::sines;
    t.center = s.robot.home()(k);
    t.sines = {{k < 2 ? 0.4 : 0.04, 0.4 + 0.05 * k, 0}};
    s.trajectory.push_back(t);
    s.noise.motor_torque.push_back(held * levels.torque(k));
    s.noise.joint_force.push_back(held * levels.joint_force(k));
    s.noise.motor_reading.push_back(levels.encoder(k));
  }
  const SimulationResult log = simulate(s);
  ArmRun run;
  for (std::size_t i = 0; i < log.measured.size(); ++i) {
    Sample sample{log.measured.time[i], Eigen::VectorXd(3), Eigen::VectorXd(3), Eigen::VectorXd()};
    Eigen::VectorXd q(3);
    for (int k = 0; k < 3; ++k) {
      sample.motor_torque(k) = log.measured.motor_torque[k][i];
      sample.motor_position(k) = log.measured.motor_position[k][i];
      q(k) = log.truth.joint_position[k][i];
    }
    run.samples.push_back(sample);
    run.joint_position.push_back(q);
  }
  return run;
}

TEST(FixedLagSmoother, IsCloserToTheJointsThanItsFilterAndAsSureAsItShouldBe) {
  Eigen::Vector3d filter_squares = Eigen::Vector3d::Zero(), squares = filter_squares, nees = filter_squares;
  long count = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const ArmRun run = noisy_run(seed);
    const auto smoother = make_smoother(raven2(), {}), filter = make_sr_ukf(raven2(), {});
    const std::map<double, Estimate> estimates = smoothed(*smoother, run.samples);
    ASSERT_EQ(estimates.size(), run.samples.size());
    filter->reset(run.samples[0]);
    for (std::size_t i = 1; i < run.samples.size(); ++i) {
      filter->update(run.samples[i]);
      if (run.samples[i].time_s < 0.5) continue;
      const Estimate& e = estimates.at(run.samples[i].time_s);
      const Eigen::Vector3d error = e.joint_position - run.joint_position[i];
      squares += error.cwiseAbs2();
      filter_squares += (filter->estimate().joint_position - run.joint_position[i]).cwiseAbs2();
      nees += error.cwiseQuotient(e.joint_position_std).cwiseAbs2();
      ++count;
    }
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_LT(squares(k), 0.9 * filter_squares(k)) << "joint " << k + 1;  // observed: 0.6
    // Errors are correlated over some 20 ms, so that 3 s are 150 squares, mean 1 ± 0.12; four of them.
    EXPECT_NEAR(nees(k) / double(count), 1, 0.5) << "joint " << k + 1;
  }
  // Friction makes the errors of joint 3 slow: there is little to gain, and both are too cautious.
  EXPECT_LT(squares(2), filter_squares(2));
  EXPECT_LT(nees(2) / double(count), 1.5);
}

TEST(FixedLagSmoother, EverySampleIsToldOnceInOrderAndNotBeforeItsLag) {
  const ArmRun run = run_arm(raven2(), 0.5);
  const auto smoother = make_smoother(raven2(), {{"lag", "0.05"}});
  smoother->reset(run.samples[0]);
  double last = -1, longest = 0;
  std::size_t told = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    smoother->update(run.samples[i]);
    while (const auto revision = smoother->revise(i + 1 == run.samples.size())) {
      EXPECT_GT(revision->time_s, last);
      last = revision->time_s;
      const double waited = run.samples[i].time_s - last;
      longest = std::max(longest, waited);
      if (i + 1 < run.samples.size()) {
        EXPECT_GE(waited, 0.05 - 1e-9);
      }
      ++told;
    }
  }
  EXPECT_EQ(told, run.samples.size());
  EXPECT_NEAR(longest, 0.1, 2e-3);
}

TEST(FixedLagSmoother, AGapPartsTheRecord) {
  ArmRun run = run_arm(raven2(), 0.2);
  std::vector<Sample> torn(run.samples.begin(), run.samples.begin() + 100), alone = torn;
  for (std::size_t i = 100; i < run.samples.size(); ++i) {
    torn.push_back(run.samples[i]);
    torn.back().time_s += 5;
  }
  const auto smoother = make_smoother(raven2(), {});
  const auto parted = smoothed(*smoother, torn), first_part = smoothed(*smoother, alone);
  EXPECT_EQ(parted.size(), torn.size());
  for (const auto& [time, estimate] : first_part)
    ASSERT_EQ(parted.at(time).joint_position, estimate.joint_position) << time;
}

TEST(FixedLagSmoother, AResetForgetsWhatWasNotYetTold) {
  const ArmRun run = run_arm(raven2(), 0.05);
  const auto smoother = make_smoother(raven2(), {{"lag", "0.01"}});
  smoother->reset(run.samples[0]);
  for (std::size_t i = 1; i < run.samples.size(); ++i) smoother->update(run.samples[i]);
  smoother->reset(run.samples[0]);
  EXPECT_FALSE(smoother->revise(false).has_value());
  const std::optional<Revision> only = smoother->revise(true);
  ASSERT_TRUE(only.has_value());
  EXPECT_EQ(only->time_s, run.samples[0].time_s);
  EXPECT_FALSE(smoother->revise(true).has_value());
}

TEST(FixedLagSmoother, WrongOptionsAreRefused) {
  const auto refusal = [](const EstimatorOptions& options) -> std::string {
    try {
      make_smoother(raven2(), options);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(
      refusal({{"lag", "0"}}),
      "estimator smoother: option lag = '0': expected a number from 0.001 to 10; correct it, or leave the option out");
  EXPECT_EQ(refusal({{"beta", "0"}}),
            "estimator smoother: option beta is smaller than alpha squared: a down-date cannot be smoothed; give a "
            "larger beta or a smaller alpha");
  EXPECT_EQ(refusal({{"lag", "0.5"}}), "accepted");
}

TEST(FixedLagSmoother, ABetaOfAlphaSquaredIsEnough) {
  const auto answer = [](const std::string& beta) {
    return message_of([&] { make_smoother(raven2(), {{"alpha", "0.5"}, {"beta", beta}}); });
  };
  EXPECT_EQ(answer("0.25"), "no InputError");
  EXPECT_NE(answer("0.2499"), "no InputError");
}

TEST(FixedLagSmoother, ByDefaultTellsAfterTwiceAFifthOfASecond) {
  ArmModel model = raven2();
  model.nominal.gravity[0] = 0;  // it stays where it is
  const auto smoother = make_smoother(model, {});
  Sample s{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
  smoother->reset(s);
  for (int i = 1; i <= 41; ++i) {
    s.time_s = 0.01 * i;
    smoother->update(s);
    if (i < 40) {
      EXPECT_FALSE(smoother->revise(false)) << i;
    }
  }
  const auto first = smoother->revise(false);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->time_s, 0);
}

}  // namespace
}  // namespace halyard
