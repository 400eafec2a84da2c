// The dual filter's derivatives, and numbers that are found again within their intervals.
#include "estimators/identification/identify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/input_error.h"
#include "plant/simulate.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

const std::string kCoupling = "joint2.coupling.joint1";

ArmModel with(ArmModel model, const std::string& key, double factor) {
  const ArmNumber number = find_number(model.nominal, key);
  number.set(factor * number.get());
  return model;
}

/// A log of the robot that a controller moves which knows the model alone.
Log log_of(const ArmModel& robot, const ArmModel& model, double seconds, int variant = 0) {
  Scenario s = motion(robot, seconds, variant);
  s.assumed = model;
  s.noise.motor_torque.assign(robot.n(), 1e-4);
  s.seed = 1 + variant;
  Log log = simulate(s).measured;
  log.source = "test.csv";
  return log;
}

/// Innovations of all samples by weights that are held, and their derivatives.
struct Innovations {
  std::vector<Eigen::VectorXd> nu;
  std::vector<Eigen::MatrixXd> S_root, Y;
};
Innovations innovations(const ArmModel& model, const std::vector<Weight>& weights, const Eigen::VectorXd& w,
                        const Log& log) {
  DualUkf filter(model, weights, {.learn = false});
  filter.set_weights(w, Eigen::MatrixXd::Identity(w.size(), w.size()));
  Innovations all;
  for (std::size_t i = 0; i < log.size(); ++i) {
    EncoderSample sample;
    sample.time_s = log.time[i];
    sample.motor_torque = Eigen::Vector2d(log.motor_torque[0][i], log.motor_torque[1][i]);
    sample.motor_position = Eigen::Vector2d(log.motor_position[0][i], log.motor_position[1][i]);
    sample.joint_position = Eigen::Vector2d(log.joint_position[0][i], log.joint_position[1][i]);
    const DualStep step = filter.update(sample);
    if (step.nu.size() == 0) continue;
    all.nu.push_back(step.nu);
    all.S_root.push_back(step.S_root);
    all.Y.push_back(step.Y);
  }
  return all;
}

/// ‖dν/dw + Y‖ over ‖Y‖, each in deviations of the innovation, by innovations `h` of the weight to either side.
double derivative_error(const ArmModel& model, const Weight& weight, const Log& log, double h) {
  const auto at = [&](double w) { return innovations(model, {weight}, Eigen::VectorXd::Constant(1, w), log); };
  const Innovations here = at(0), above = at(h), below = at(-h);
  double error = 0, size = 0;
  for (std::size_t k = 0; k < here.nu.size(); ++k) {
    const auto S = here.S_root[k].triangularView<Eigen::Lower>();
    error += S.solve((above.nu[k] - below.nu[k]) / (2 * h) + here.Y[k].col(0)).squaredNorm();
    size += S.solve(here.Y[k].col(0)).squaredNorm();
  }
  return std::sqrt(error / size);
}

TEST(DualUkf, DerivativesAreThoseOfItsInnovations) {
  const ArmModel model = first_joints(2);
  const Log log = log_of(model, model, 1.5);
  const std::vector<std::string> keys = {kCoupling, "joint2.cable.stiffness", "joint1.friction.coulomb"};
  for (const std::string& key : keys) {
    ArmParameters<double> arm = model.nominal;
    const Weight weight = {key, find_number(arm, key).get(), key == kCoupling ? 0.01 : 0.1, key != kCoupling};
    // What is left out is the gain's derivative.
    EXPECT_LT(derivative_error(model, weight, log, 0.02), 0.1) << key;
  }
}

TEST(DualUkf, DerivativesAreThoseOfItsInnovationsInADwell) {
  const ArmModel model = first_joints(2);
  const double home = model.joints[1].home, c01 = model.nominal.joint[1].coupling[0];
  Scenario s = motion(model, 1.5);
  s.trajectory[1].kind = JointTrajectory::Kind::point_to_point;
  s.trajectory[1].points = {home, home + 0.2};
  s.trajectory[1].move_s = 0.5;
  // A weight of the deviation that identify() gives it, and steps that friction does not turn round in. Observed 0.026;
  // 0.24 with points 0.03 deviations apart.
  EXPECT_LT(derivative_error(model, {kCoupling, c01, 0.3 * c01, false}, simulate(s).measured, 1e-3), 0.1);
}

TEST(Identify, FindsACouplingWithinItsInterval) {
  const ArmModel model = first_joints(2);
  int held = 0;
  for (int variant = 0; variant < 3; ++variant) {
    const double factor = 0.9 + 0.1 * variant;
    const Identification found =
        identify(model, {log_of(with(model, kCoupling, factor), model, 3, variant)}, {kCoupling});
    ASSERT_EQ(found.numbers.size(), 1u);
    const IdentifiedNumber& n = found.numbers[0];
    const double truth = factor * n.nominal;
    held += n.lower <= truth && truth <= n.upper;
    // A fiftieth of the tolerance that the model states of a coupling.
    EXPECT_NEAR(n.value, truth, 4e-4 * truth);
    EXPECT_LT(n.upper - n.lower, 4e-3 * truth);
    EXPECT_EQ(n.convergence, Convergence::converged);
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(found.model.nominal.joint[1].coupling[0], n.value);
    EXPECT_EQ(found.model.nominal.joint[1].stiffness, model.nominal.joint[1].stiffness);
    EXPECT_TRUE(found.deviating.empty());
  }
  // Fewer by a chance of 0.7 %.
  EXPECT_GE(held, 2);
}

TEST(Identify, FindsANumberWhoseSignTheModelHasWrong) {
  const std::string key = "joint1.link.com.y";
  const ArmModel arm = first_joints(1), robot = with(arm, key, 0.5), model = with(arm, key, -0.2);
  const Identification found = identify(model, {log_of(robot, robot, 3)}, {key});
  ASSERT_EQ(found.numbers.size(), 1u);
  const IdentifiedNumber& n = found.numbers[0];
  EXPECT_LT(n.nominal, 0);
  EXPECT_GT(n.lower, 0);
  EXPECT_LT(n.lower, n.upper);
}

TEST(Identify, AStiffnessThatIsOffSpoilsNoCouplingAndIsTold) {
  const ArmModel model = first_joints(2);
  const ArmModel robot = with(with(model, kCoupling, 1.06), "joint2.cable.stiffness", 0.7);
  const Identification found = identify(model, {log_of(robot, model, 3)}, {kCoupling});
  const double truth = robot.nominal.joint[1].coupling[0];
  EXPECT_LE(found.numbers[0].lower, truth);
  EXPECT_GE(found.numbers[0].upper, truth);
  ASSERT_EQ(found.deviating.size(), 1u);
  EXPECT_EQ(found.deviating[0].name, "joint 2 cable stiffness");
  EXPECT_NEAR(found.deviating[0].tolerances, -3, 0.5);
}

TEST(Identify, SaysWhatTheLogDoesNotExciteAndWhatDrifts) {
  const ArmModel model = first_joints(2);
  ArmModel robot = model;
  PlacedEffect drift = place_effect(*find_effect("friction_drift"), model.nominal, 1);
  drift.p[0] = 0.3;  // 1/s: two and a half times as much at the end
  robot.effects.push_back(drift);
  const Identification found =
      identify(model, {log_of(robot, model, 5)},
               {"joint1.friction.coulomb", "joint1.friction.viscous", "joint2.friction.coulomb"});
  const auto number = [&](const std::string& key) {
    return *std::ranges::find(found.numbers, key, &IdentifiedNumber::key);
  };
  EXPECT_EQ(number("joint2.friction.coulomb").convergence, Convergence::drifting);
  EXPECT_EQ(number("joint1.friction.coulomb").convergence, Convergence::converged);
  // A hundredth of the Coulomb friction at the speed of this motion.
  EXPECT_EQ(number("joint1.friction.viscous").convergence, Convergence::not_excited);
}

TEST(Identify, LogsOneAfterTheOtherTellMoreThanOne) {
  const ArmModel model = first_joints(2), robot = with(model, kCoupling, 1.05);
  const Log first = log_of(robot, model, 3, 0), second = log_of(robot, model, 3, 1);
  const Identification one = identify(model, {first}, {kCoupling}),
                       both = identify(model, {first, second}, {kCoupling});
  EXPECT_LT(both.numbers[0].upper - both.numbers[0].lower, one.numbers[0].upper - one.numbers[0].lower);
  EXPECT_NEAR(both.time.back(), 6, 0.02);
}

TEST(Identify, AZeroThatALogHasOfItsOwnIsFoundAlong) {
  ArmModel model = first_joints(2);
  model.nominal.joint[1].motor_zero_known = false;
  const ArmModel robot = with(model, kCoupling, 1.05);
  Log log = log_of(robot, model, 3);
  // As homing leaves it: right at the start by the model's coupling, which is not the robot's.
  const JointParameters<double>& j = model.nominal.joint[1];
  const double wrong = (robot.nominal.joint[1].coupling[0] - j.coupling[0]) * model.joints[0].home;
  for (double& reading : log.motor_position[1]) reading -= wrong * j.pulley_radius / j.motor_travel();
  const IdentifiedNumber n = identify(model, {log}, {kCoupling}).numbers.at(0);
  EXPECT_LE(n.lower, robot.nominal.joint[1].coupling[0]);
  EXPECT_GE(n.upper, robot.nominal.joint[1].coupling[0]);
  EXPECT_THROW(identify(model, {log, log}, {kCoupling}), InputError);
}

TEST(IdentifiedKeys, AreKindsAndSingleNumbers) {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  using Keys = std::vector<std::string>;
  EXPECT_EQ(identified_keys(model, "coupling"),
            (Keys{"joint2.coupling.joint1", "joint3.coupling.joint1", "joint3.coupling.joint2"}));
  EXPECT_EQ(identified_keys(model, "joint1.cable.damping,joint1.cable.damping, stiffness").size(), 4u);
  EXPECT_EQ(identified_keys(model, "motor_friction,joint_friction").size(), 12u);
  model.nominal.joint[1].coupling[0] = 0;
  EXPECT_EQ(identified_keys(model, "coupling").size(), 2u);
  EXPECT_EQ(identified_keys(model, "joint2.coupling.joint1").size(), 1u);
  model.nominal.joint[0].law = CableLaw::exponential;
  EXPECT_EQ(identified_keys(model, "tension"), Keys{"joint1.cable.tension"});
}

TEST(IdentifiedKeys, ThatCannotBeIdentifiedAreRefusedWithTheReason) {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  model.source = "arm.xml";
  const auto refusal = [&](const std::string& text) { return message_of([&] { identified_keys(model, text); }); };
  EXPECT_EQ(refusal("tension"),
            "parameter 'tension': arm.xml has no cable law that takes tension; write law=\"exponential\" in its "
            "<cable>");
  EXPECT_TRUE(refusal("coupling,").starts_with("parameter '': ")) << refusal("coupling,");
  model.nominal.joint[0].stiffness = 0;
  EXPECT_EQ(refusal("joint1.cable.stiffness"),
            "parameter 'joint1.cable.stiffness': is 0 in arm.xml, which gives no scale to look for it; write a guess "
            "into the model");
  EXPECT_EQ(refusal("joint2.cable.pulley_radius,joint1.motor.gear_ratio,joint1.cable.pulley_radius"),
            "parameters joint1.motor.gear_ratio and joint1.cable.pulley_radius: a log tells only the ratio of a drive, "
            "in which both are; ask for one of them");
  for (int k = 0; k < 3; ++k) model.nominal.joint[k].joint_coulomb = model.nominal.joint[k].joint_viscous = 0;
  EXPECT_EQ(refusal("joint_friction"),
            "parameter 'joint_friction': arm.xml has no such number, or only numbers of 0; ask for others, or name a "
            "coupling of 0 by its key, such as joint2.coupling.joint1");
  model.nominal.n = 1;
  model.joints.resize(1);
  EXPECT_EQ(refusal("coupling"),
            "parameter 'coupling': arm.xml has one joint, and a joint is coupled with inboard ones; ask for another "
            "number");
}

TEST(IdentifiedKeys, AnUnknownOneIsRefusedWithTheKindsAndTheKeysOfItsJoint) {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  model.source = "arm.xml";
  const auto refusal = [&](const std::string& text) { return message_of([&] { identified_keys(model, text); }); };
  const std::string start =
      ": arm.xml has none of that name; expected some of coupling, stiffness, damping, tension, motor_friction, "
      "joint_friction, or of the keys ";
  const auto check = [&](const std::string& word, const std::string& first_key, const std::string& joint, bool other) {
    const std::string message = refusal(word), others = " (the other joints have the like)";
    EXPECT_TRUE(message.starts_with("parameter '" + word + "'" + start + first_key + ", ")) << message;
    EXPECT_NE(message.find(", " + joint + ".cable.stiffness, "), std::string::npos) << message;
    for (const std::string k : {"joint1", "joint2", "joint3"})
      EXPECT_EQ(message.find(k + ".cable.stiffness") != std::string::npos, k == joint) << message;
    EXPECT_EQ(message.find(others) != std::string::npos, other) << message;
  };
  check("joint2.cable.stifness", "joint2.link.mass", "joint2", false);
  check("joint4.cable.stiffness", "joint1.link.mass", "joint1", true);
  check("stifness", "joint1.link.mass", "joint1", true);
}

TEST(IdentifiedLogs, NeedTheSensorOfTheJointAndALogThatIsLongEnough) {
  const ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  Log log(3);
  log.source = "log.csv";
  log.time = {0, 1, 2};
  for (auto* signals : {&log.motor_torque, &log.motor_position, &log.joint_position})
    for (auto& column : *signals) column = {0, 0, 0};
  const auto refusal = [&] { return message_of([&] { identify(model, {log}, {"joint2.coupling.joint1"}); }); };
  EXPECT_EQ(refusal(),
            "log.csv: 2 s of it are for the estimation, without what is held out; expected at least 3 s, and more is "
            "better: give a longer log, or one of its own to hold out");
  log.joint_position[1].clear();
  EXPECT_TRUE(refusal().starts_with("log.csv: column joint_position_2 is missing, or empty; ")) << refusal();
}

}  // namespace
}  // namespace halyard
