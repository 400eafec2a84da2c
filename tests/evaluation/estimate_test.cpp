/// A run of an estimator over a log: what its first sample has, whose failures are its own; and joint sensors as truth.

#include "evaluation/run/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>

#include "evaluation/comparison/compare.h"
#include "evaluation/run/sensor_readings.h"
#include "plant/simulate.h"
#include "tests/support/limits.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Keeps its first sample.
class Probe : public Estimator {
 public:
  void reset(const Sample& sample) override { first = sample; }
  Innovation update(const Sample&) override { return {}; }
  EstimatorReport report() const override { return {}; }
  Estimate estimate() const override {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(first.motor_position.size());
    return {zero, zero, zero};
  }
  Sample first;
};

TEST(RunEstimator, StartsWithTheLastReadingsTorquesAndLoads) {
  Log log(2);
  log.time = {0, 1e-3, 2e-3, 3e-3};
  log.motor_position[0] = {1, 2, kNan, 3};
  log.motor_position[1] = {kNan, kNan, 5, 6};
  log.motor_torque[0] = {0.1, 0.2, kNan, kNan};
  log.motor_torque[1] = {kNan, kNan, kNan, 0.7};
  log.joint_torque = {{4, kNan, kNan, kNan}, {}};
  Probe probe;
  run_estimator(probe, "probe", log, {.use_joint_torque = true});
  EXPECT_EQ(probe.first.time_s, 2e-3);
  EXPECT_EQ(probe.first.motor_position, Eigen::Vector2d(2, 5));
  EXPECT_EQ(probe.first.motor_torque, Eigen::Vector2d(0.2, 0)) << "the second has none yet";
  EXPECT_EQ(probe.first.joint_torque, Eigen::Vector2d(4, 0));
}

TEST(RunEstimator, MemoryThatRunsOutIsNoFailureOfTheEstimator) {
  class Hungry : public Probe {
    Innovation update(const Sample&) override { throw std::bad_alloc(); }
  };
  Log log(1);
  log.time = {0, 1e-3};
  log.motor_position[0] = log.motor_torque[0] = {0, 0};
  Hungry hungry;
  EXPECT_THROW(run_estimator(hungry, "hungry", log), std::bad_alloc);
}

class SensorReadings : public testing::TestWithParam<double> {};

TEST_P(SensorReadings, LagTheEstimateToSecondOrder) {
  ArmModel model = first_joints(1);
  PlacedEffect delay = place_neutral_effect(*find_effect("delay"), model.nominal, 0);
  const double lag = 0.02, acceleration = 3;
  delay.p[1] = lag;
  model.effects = {delay};
  Log log(1);
  for (int i = 0; i < 100; ++i) log.time.push_back(GetParam() * i);
  EstimatorRun run = no_run("test", log);
  for (std::size_t i = 10; i < 100; ++i) {
    const double t = log.time[i];
    run.estimates.joint_position[0][i] = acceleration * t * t / 2;
    run.estimates.joint_velocity[0][i] = acceleration * t;
  }
  const Signals readings = sensor_readings(model, run);
  EXPECT_TRUE(std::isnan(readings[0][9])) << "before the start";
  for (std::size_t i = 10; i < 100; ++i)
    EXPECT_NEAR(readings[0][i], acceleration * std::pow(log.time[i] - lag, 2) / 2, 1e-12) << i;
}

INSTANTIATE_TEST_SUITE_P(Periods, SensorReadings, testing::Values(1e-3, 5e-3, 10e-3));

TEST(CompareWithJointSensors, TheirResolutionIsNoErrorOfTheEstimate) {
  Scenario scenario = motion(first_joints(1), 2);
  scenario.quantise = true;
  const SimulationResult data = simulate(scenario);
  ArmModel coarse = scenario.robot;
  const auto nees = [&](const ArmModel& model) {
    return compare_estimators(model, {"sr_ukf"}, data.measured, data.measured,
                              {.truth_is_sensed = true, .containment = {.in_process = true}})
        .judgements.at(0)
        .nees.at(0)
        .mean;
  };
  const double fine = nees(coarse);
  coarse.nominal.joint[0].joint_encoder_resolution *= 100;
  // The sensor's variance dominates: a hundred times the resolution, a ten thousandth of the NEES.
  EXPECT_LT(nees(coarse), 1e-2 * fine);
}

}  // namespace
}  // namespace halyard
