// Forces on the joints that nobody told the filter of: what it says of them, and what it cannot tell from them.
#include "estimators/filters/disturbance_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "estimators/built_in.h"
#include "estimators/log_sample.h"
#include "estimators/process/standstill.h"
#include "model/input_error.h"
#include "plant/simulate.h"
#include "tests/support/arm_runs.h"
#include "tests/support/pendulum.h"

namespace halyard {
namespace {

constexpr double kForce = 1.5, kOnset = 0.8, kEnd = 2;  // N m, s

/// The RAVEN-II standing still or on slow sines, simulated.
Scenario scenario(bool moving) {
  Scenario s;
  s.robot = raven2();
  s.duration_s = kEnd;
  s.fade_in_s = 0.5;
  for (int k = 0; k < 3; ++k) {
    JointTrajectory t;
    t.kind = moving ? JointTrajectory::Kind::sines : JointTrajectory::Kind::hold;
    t.center = s.robot.home()(k);
    if (moving) t.sines = {{k < 2 ? 0.4 : 0.04, 0.4 + 0.05 * k, 0}};
    s.trajectory.push_back(t);
  }
  return s;
}

/// Calls judge(i, estimate) for each sample of the log after half a second.
void run(Estimator& estimator, const Log& log, const std::function<void(std::size_t, const Estimate&)>& judge) {
  estimator.reset(sample_of(log, 0));
  for (std::size_t i = 1; i < log.size(); ++i) {
    estimator.update(sample_of(log, i));
    if (log.time[i] >= 0.5) judge(i, estimator.estimate());
  }
}

enum ExtraOutput { force, force_std, cable_force };

class RootMeanSquare {
 public:
  void add(double x) { sum_ += x * x, ++count_; }
  double value() const { return std::sqrt(sum_ / count_); }

 private:
  double sum_ = 0, count_ = 0;
};

class UnknownForceOnAJoint : public testing::TestWithParam<std::tuple<int, bool>> {};

INSTANTIATE_TEST_SUITE_P(All, UnknownForceOnAJoint, testing::Combine(testing::Values(1, 2), testing::Bool()),
                         [](const auto& info) {
                           return "joint" + std::to_string(std::get<0>(info.param)) +
                                  (std::get<1>(info.param) ? "_moving" : "_standing");
                         });

TEST_P(UnknownForceOnAJoint, IsFollowedWithinATenthAndItsCableForceToo) {
  const auto [joint, moving] = GetParam();
  Scenario s = scenario(moving);
  add_effect(s.robot, "external_force", joint - 1, {kForce, kOnset, 10, 0, 0, 0});
  const SimulationResult log = simulate(s);
  const auto filter = make_disturbance_sr_ukf(raven2(), {}), unaware = make_sr_ukf(raven2(), {});

  const int k = joint - 1;
  const JointParameters<double>& j = s.robot.nominal.joint[k];
  RootMeanSquare error, cable_error, cable, position, unaware_position;
  run(*filter, log.measured, [&](std::size_t i, const Estimate& e) {
    error.add(e.extra_outputs(k, force) - (log.truth.time[i] >= kOnset ? kForce : 0));
    position.add(e.joint_position(k) - log.truth.joint_position[k][i]);
    double path = 0;
    for (int c = 0; c < 3; ++c) path += j.coupling[c] * log.truth.joint_position[c][i];
    const double stretch = j.motor_travel() * log.truth.motor_position[k][i] - j.pulley_radius * path;
    cable_error.add(e.extra_outputs(k, cable_force) - 2 * j.stiffness * stretch);  // less its damping
    cable.add(2 * j.stiffness * stretch);
  });
  run(*unaware, log.measured, [&](std::size_t i, const Estimate& e) {
    unaware_position.add(e.joint_position(k) - log.truth.joint_position[k][i]);
  });
  // The whole record counts, with the onset: a step that is followed with a lag of 20 ms is 9 % of itself.
  EXPECT_LT(error.value(), 0.1 * kForce);
  EXPECT_LT(cable_error.value(), 0.15 * cable.value());
  EXPECT_LT(position.value(), 0.8 * unaware_position.value());
}

TEST(DisturbanceFilter, ClaimsNoForceWhereThereIsNone) {
  const SimulationResult log = simulate(scenario(true));
  const auto filter = make_disturbance_sr_ukf(raven2(), {});
  RootMeanSquare over_std[3];
  run(*filter, log.measured, [&](std::size_t, const Estimate& e) {
    for (int k = 0; k < 3; ++k) over_std[k].add(e.extra_outputs(k, force) / e.extra_outputs(k, force_std));
  });
  for (int k = 0; k < 3; ++k) EXPECT_LT(over_std[k].value(), 1) << "joint " << k + 1;
}

// What the signals of the motors cannot tell: a friction that the model lacks is a force against the motion.
TEST(DisturbanceFilter, TakesUnknownFrictionForAForce) {
  Scenario s = scenario(true);
  s.robot.nominal.joint[0].joint_coulomb += 0.5;
  const SimulationResult log = simulate(s);
  const auto filter = make_disturbance_sr_ukf(raven2(), {});
  RootMeanSquare error;
  run(*filter, log.measured, [&](std::size_t i, const Estimate& e) {
    const double rate = log.truth.joint_velocity[0][i];
    if (std::abs(rate) > 0.1) error.add(e.extra_outputs(0, force) + (rate > 0 ? 0.5 : -0.5));
  });
  EXPECT_LT(error.value(), 0.1);
}

TEST(DisturbanceFilter, AJointWithoutMotorHasNeitherForceNorCable) {
  ArmModel model = raven2();
  model.nominal.gravity[0] = 0;
  model.nominal.joint[0].drive = Drive::rigid;
  model.nominal.joint[2].drive = Drive::none;
  const auto filter = make_disturbance_sr_ukf(model, {});
  Sample s = run_arm(raven2(), 0).samples[0];
  filter->reset(s);
  s.time_s = 1e-3;
  filter->update(s);
  const Eigen::MatrixXd extra_outputs = filter->estimate().extra_outputs;
  EXPECT_TRUE(extra_outputs.leftCols(2).topRows(2).allFinite());
  EXPECT_TRUE(extra_outputs.leftCols(2).row(2).array().isNaN().all());
  EXPECT_TRUE(std::isnan(extra_outputs(0, cable_force)));
  EXPECT_TRUE(std::isfinite(extra_outputs(1, cable_force)));
}

TEST(DisturbanceFilter, TheForcesLevelsAreThoseOfGravityAndFriction) {
  ArmModel model = pendulum();
  model.joints[0].lower = -0.5;
  model.joints[0].upper = 0.5;
  model.joints[0].home = 0;
  model.nominal.gravity[0] = -16;
  const double gravity = 8 * std::sin(0.5);  // 1 kg at 0.5 m
  const EstimatorOptions none, given = {{"force_start", "7"}, {"force_wander", "9"}};
  const auto levels = [&](const EstimatorOptions& options, double friction) {
    model.nominal.joint[0].joint_coulomb = friction;
    OptionReader reader("the test", options);
    return read_force_levels(reader, model);
  };
  const UnknownLevels light = levels(none, 0.25), rough = levels(none, 5), told = levels(given, 5);
  EXPECT_NEAR(light.start(0), gravity, 1e-12);
  EXPECT_NEAR(light.wander(0), gravity / 4, 1e-12);
  EXPECT_EQ(rough.start(0), 5);
  EXPECT_EQ(rough.wander(0), 10);
  EXPECT_EQ(told.start(0), 7);
  EXPECT_EQ(told.wander(0), 9);
}

TEST(DisturbanceFilter, WrongOptionsAreRefused) {
  const auto refusal = [](const EstimatorOptions& options) -> std::string {
    try {
      make_disturbance_sr_ukf(raven2(), options);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({{"force_wander", "-1"}}),
            "estimator disturbance_sr_ukf: option force_wander = '-1': expected one number, or one for each of the 3 "
            "joints with blanks between, of at least 0; correct it, or leave the option out");
  EXPECT_TRUE(
      refusal({{"force", "1"}})
          .starts_with(
              "estimator disturbance_sr_ukf: unknown option 'force'; known are force_start, force_wander, alpha, "));
  EXPECT_EQ(refusal({{"force_wander", "1 2 3"}, {"force_start", "0"}, {"gate", "0.999"}}), "accepted");
}

TEST(DisturbanceFilter, TheCablesForceIsThatAtItsTime) {
  ArmModel model = raven2();
  add_effect(model, "cable_slip", 2, {1e-3, 1, 0});  // 1 mm at 1 s
  const auto filter = make_disturbance_sr_ukf(model, {});
  Sample s{3, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
  // At rest the cable holds joint 3 against gravity.
  const auto missing = [&] {
    const Estimate e = filter->estimate();
    return gravity_force(model.nominal, e.joint_position)(2) -
           model.nominal.joint[2].pulley_radius * e.extra_outputs(2, cable_force);
  };
  filter->reset(s);
  EXPECT_NEAR(missing(), 0, 1e-3) << "the first sample, after the slip";
  s.time_s = 0;
  filter->reset(s);
  EXPECT_NEAR(missing(), 0, 1e-3) << "the first sample, before it";
  s.time_s = 2.5;  // after a gap, it starts anew
  filter->update(s);
  EXPECT_NEAR(missing(), 0, 1e-3) << "a later one";
}

}  // namespace
}  // namespace halyard
