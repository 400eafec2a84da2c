/// Noise levels that a model gives by itself, and the first belief, in closed form.

#include <gtest/gtest.h>

#include <limits>

#include "estimators/process/standstill.h"
#include "tests/estimators/process/held_force.h"
#include "tests/support/arm_runs.h"
#include "tests/support/message_of.h"
#include "tests/support/pendulum.h"

namespace halyard {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

Eigen::MatrixXd first_root(const ArmModel& model, const Eigen::VectorXd& x, double dt_s) {
  const ProcessModel process(model);
  return ArmNoise(model, process, levels_of(model, process)).initial_root(x, dt_s);
}

TEST(NoiseLevels, AreResolutionsAndTolerancesOfFrictionAndGravity) {
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 2, {});
  for (int k = 0; k < 3; ++k) {
    model.joints[k].tolerances.friction = 0.1 * (k + 1);
    model.joints[k].tolerances.mass = 0.03 * (k + 1);
  }
  model.nominal.joint[1].motor_encoder_resolution = 1e-7;
  const ProcessModel process(model);
  const NoiseLevels levels = levels_of(model, process);
  const Eigen::VectorXd gravity = largest_gravity_force(process.arm(), model);
  for (int k = 0; k < 3; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    // A reading that is rounded is uniform over its resolution; finer than 1e-5 rad is not believed.
    EXPECT_DOUBLE_EQ(levels.encoder(k), k == 1 ? 1e-5 : j.motor_encoder_resolution / std::sqrt(12.0)) << k;
    EXPECT_DOUBLE_EQ(levels.torque(k), 0.1 * (k + 1) * j.motor_coulomb) << k;
    EXPECT_DOUBLE_EQ(levels.joint_force(k), 0.1 * (k + 1) * j.joint_coulomb + 0.03 * (k + 1) * gravity(k)) << k;
  }
  // An effect's state wanders by its own size in 1e4 s, and by ten times as much in a hundredth of that.
  ASSERT_EQ(levels.wander.size(), 1);
  const PlacedEffect& e = model.effects[0];
  const double scale = e.effect->state_scale(process.arm(), e.joint, e.p)[0];
  EXPECT_DOUBLE_EQ(levels.wander(0), scale / 100);
  EXPECT_DOUBLE_EQ(levels_of(model, process, {{"effect_noise_time", "100"}}).wander(0), scale / 10);
}

TEST(NoiseLevels, OfAnEncoderAreThoseOfItsRoundingAndItsNoise) {
  ArmModel model = raven2();
  model.nominal.joint[1].motor_encoder_noise = 3e-3;
  const ProcessModel process(model);
  const double rounding = model.nominal.joint[1].motor_encoder_resolution / std::sqrt(12.0);
  EXPECT_DOUBLE_EQ(levels_of(model, process).encoder(1), std::hypot(rounding, 3e-3));
}

TEST(NoiseLevels, OptionsReplaceThem) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  EXPECT_EQ(levels_of(model, process).correlation_time, 1e-3);
  EXPECT_EQ(levels_of(model, process).adaptation_time, 0);
  const NoiseLevels levels = levels_of(model, process,
                                       {{"encoder_noise", "1e-9"},
                                        {"torque_noise", "0 0.5 0.25"},
                                        {"joint_force_noise", "0.125"},
                                        {"noise_time", "0.0625"},
                                        {"adaptation_time", "0.75"}});
  EXPECT_EQ(levels.encoder, Eigen::Vector3d::Constant(1e-9));
  EXPECT_EQ(levels.torque, Eigen::Vector3d(0, 0.5, 0.25));
  EXPECT_EQ(levels.joint_force, Eigen::Vector3d::Constant(0.125));
  EXPECT_EQ(levels.correlation_time, 0.0625);
  EXPECT_EQ(levels.adaptation_time, 0.75);
  EXPECT_EQ(levels_of(model, process, {{"noise_time", "0"}}).correlation_time, 0);
}

TEST(NoiseLevels, NegativeOnesAreRefused) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  for (const char* name :
       {"encoder_noise", "torque_noise", "joint_force_noise", "noise_time", "effect_noise_time", "adaptation_time"})
    EXPECT_NE(message_of([&] { levels_of(model, process, {{name, "-1e-3"}}); }), "no InputError") << name;
}

TEST(NoiseLevels, AnEffectsStateWandersAsTheSquareRootOfTime) {
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 2, {});
  const ProcessModel process(model);
  const NoiseLevels levels = levels_of(model, process);
  ArmNoise noise(model, process, levels);
  const Eigen::VectorXd x = at_speed(model, process, Eigen::Vector3d(0.5, -0.5, 0.05));
  for (const double dt : {1e-3, 4e-3}) {
    const Eigen::MatrixXd Q_root = noise.process_root({0, dt}, x);
    ASSERT_EQ(Q_root.cols(), 7);
    EXPECT_DOUBLE_EQ(Q_root(12, 6), levels.wander(0) * std::sqrt(dt));
    EXPECT_EQ(Q_root.col(6).head(12).norm(), 0);
  }
}

TEST(InitialRoot, OfCableDrivesIsTheEncoderTheStretchAndTheFrictionThatHoldsIt) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const StateLayout& l = process.layout();
  const ArmParameters<double>& arm = process.arm();
  const NoiseLevels levels = levels_of(model, process);
  Eigen::VectorXd x = at_speed(model, process, Eigen::Vector3d::Zero());
  const Eigen::Vector3d stretch(1e-4, -2e-4, 3e-4);
  for (int k = 0; k < 3; ++k) x(*l.motor_angle[k]) += stretch(k) / arm.joint[k].motor_travel();
  constexpr double kStep = 1e-3;
  const Eigen::MatrixXd S = first_root(model, x, kStep), at_rest = first_root(model, x, kForever);
  Eigen::Matrix3d of_joints;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) of_joints(r, c) = S(l.position[r], l.position[c]);
  const Eigen::Matrix3d of_paths = path_matrix(arm) * of_joints;
  for (int k = 0; k < 3; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const double encoder = levels.encoder(k), travel = j.motor_travel(), radius = std::abs(j.pulley_radius);
    // What the joint's friction holds of a stretch is uniform between its limits.
    const double held = j.joint_coulomb / radius / (2 * j.stiffness) / std::sqrt(3.0);
    const double path = travel * encoder + model.joints[k].tolerances.stiffness * std::abs(stretch(k)) + held;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(of_paths(k, c), c == k ? path : 0, 1e-9 * path) << k << ", " << c;
    EXPECT_DOUBLE_EQ(S(*l.motor_angle[k], *l.motor_angle[k]), encoder);
    // The difference of two readings, over the step; at rest the speed over which friction is smoothed.
    EXPECT_DOUBLE_EQ(S(*l.motor_rate[k], *l.motor_rate[k]),
                     std::max(j.motor_smoothing, std::sqrt(2.0) * encoder / kStep));
    EXPECT_DOUBLE_EQ(S(l.rate[k], l.rate[k]),
                     std::max(j.joint_smoothing, std::sqrt(2.0) * encoder * travel / radius / kStep));
    EXPECT_DOUBLE_EQ(at_rest(*l.motor_rate[k], *l.motor_rate[k]), j.motor_smoothing);
    EXPECT_DOUBLE_EQ(at_rest(l.rate[k], l.rate[k]), j.joint_smoothing);
    const double short_step = 1e-7;
    EXPECT_NEAR(first_root(model, x, short_step)(l.rate[k], l.rate[k]),
                std::sqrt(2.0) * encoder * travel / radius / short_step, 1e-9 * encoder / short_step);
  }
}

TEST(InitialRoot, OfARigidDriveIsItsEncoderAndOfAJointWithoutMotorATenthOfItsRange) {
  ArmModel model = raven2();
  model.nominal.joint[1].drive = Drive::rigid;
  const ProcessModel process(model);
  const NoiseLevels levels = levels_of(model, process);
  const Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home());
  const Eigen::MatrixXd S = first_root(model, x, kForever);
  Eigen::Matrix3d of_joints;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) of_joints(r, c) = S(process.layout().position[r], process.layout().position[c]);
  const double encoder = process.arm().joint[1].motor_travel() * levels.encoder(1);
  EXPECT_NEAR((path_matrix(process.arm()) * of_joints)(1, 1), encoder, 1e-9 * encoder);

  ArmModel hanging = pendulum();
  hanging.joints[0].lower = -0.5;
  hanging.joints[0].upper = 1;
  const Eigen::MatrixXd S_hanging = first_root(hanging, Eigen::VectorXd::Zero(2), 1e-3);
  EXPECT_DOUBLE_EQ(S_hanging(0, 0), 0.15);
  EXPECT_DOUBLE_EQ(S_hanging(1, 1), hanging.nominal.joint[0].joint_smoothing);
}

TEST(InitialRoot, OfEffectsIsTheTypicalSizeOfTheirStates) {
  ArmModel model = raven2();
  for (const int k : {0, 2}) add_effect(model, "hysteresis", k, {});
  const ProcessModel process(model);
  const Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home());
  const Eigen::MatrixXd S = first_root(model, x, kForever);
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 2; ++i) {
    const PlacedEffect& e = model.effects[i];
    expected(i, i) = e.effect->state_scale(process.arm(), e.joint, e.p)[0];
  }
  EXPECT_EQ(S.bottomRightCorner(2, 2), expected);
  EXPECT_EQ(S.bottomLeftCorner(2, 12).norm() + S.topRightCorner(12, 2).norm(), 0);
}

TEST(ProcessNoise, OfARigidDriveTurnsItsJointByTheTorqueAtTheMotor) {
  ArmModel model = raven2();
  for (int k = 0; k < 3; ++k) model.nominal.joint[k].drive = Drive::rigid;
  const ProcessModel process(model);
  const NoiseLevels levels = levels_of(model, process);
  ArmNoise noise(model, process, levels);
  Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home());
  for (int k = 0; k < 3; ++k) x(process.layout().rate[k]) = k < 2 ? 0.5 : 0.05;
  constexpr double kStep = 1e-3;
  const Eigen::MatrixXd Q_root = noise.process_root({0, kStep}, x);
  for (int source = 0; source < 6; ++source) {
    const Eigen::VectorXd moved = moved_by_held_force(process, levels, x, kStep, source);
    ASSERT_GT(moved.norm(), 0) << source;
    EXPECT_LT((Q_root.col(source) - moved).norm(), 0.02 * moved.norm()) << source;  // as a held force does
  }
}

TEST(ProcessNoise, AdaptationGoesWithTheSquareOfWhatIsExpectedAndCountsAnOutlierAsThree) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  NoiseLevels levels = levels_of(model, process, {{"adaptation_time", "0.5"}});
  ArmNoise noise(model, process, levels);
  noise.reset(Eigen::Vector3d::Ones());
  constexpr double kStep = 1e-3;
  const auto innovation = [](double deviations) {
    Innovation i;
    i.S_root = 0.3 * Eigen::MatrixXd::Identity(2, 2);
    i.nu = Eigen::Vector2d(0.3 * deviations, 0.3);
    return i;
  };
  // d ln(c) / dt = (ν² / S - 1) / (2 T): nothing for one deviation, and for more than three no more than for three.
  for (const double deviations : {0.0, 1.0, 2.0, 3.0, 100.0}) {
    noise.reset(Eigen::Vector3d::Ones());
    noise.adapt({2, 0}, innovation(deviations), ReadingVector::Constant(2, kStep));
    const double square = std::min(deviations * deviations, 9.0);
    EXPECT_NEAR(std::log(noise.adapted()(2)), (square - 1) * kStep / (2 * 0.5), 1e-12) << deviations;
    EXPECT_NEAR(noise.adapted()(0), 1, 1e-12) << deviations;
    EXPECT_EQ(noise.adapted()(1), 1) << "not read";
  }
  // Never by more than thirty times, either way.
  for (const double deviations : {0.0, 100.0}) {
    for (int i = 0; i < 20000; ++i) noise.adapt({2, 0}, innovation(deviations), ReadingVector::Constant(2, kStep));
    EXPECT_DOUBLE_EQ(noise.adapted()(2), deviations > 0 ? 30 : 1.0 / 30);
  }
}

TEST(ProcessNoise, IsSimpsonsMeanOfWhatImpulsesDoAtTheTimesOfTheStep) {
  ArmModel model = raven2();
  add_effect(model, "friction_drift", 0, {200, 0, 1, 1});  // by a fifth within a millisecond
  const ProcessModel process(model);
  ArmNoise noise(model, process, levels_of(model, process));
  const Eigen::VectorXd x = at_speed(model, process, Eigen::Vector3d(2e-3, -2e-3, 2e-4));  // within the smoothing
  const Step step{0, 1e-3};
  Eigen::VectorXd f;
  Eigen::MatrixXd A;
  LinearisedPoint found;
  process.linearise(step, x, nullptr, f, A, found);
  const Eigen::MatrixXd G = noise.impulses(step, Eigen::Map<const Eigen::Matrix3d>(found.chain.mobility));
  const Eigen::MatrixXd Q_root = noise.process_root(step, x);
  for (int source = 0; source < 6; ++source) {
    Eigen::VectorXd free = x, forced = x + G.col(source), exact = G.col(source) / 6;
    Step half = step;
    half.dt_s /= 2;
    for (const double weight : {4.0 / 6, 1.0 / 6}) {
      process.advance(half, free.data());
      process.advance(half, forced.data());
      half.time_s += half.dt_s;
      exact += weight * (forced - free);
    }
    // Motor angles of some 100 rad that are rounded.
    EXPECT_LT((Q_root.col(source) - exact).norm(), 1e-5 * exact.norm()) << source;
  }
}

}  // namespace
}  // namespace halyard
