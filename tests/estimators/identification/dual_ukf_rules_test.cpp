/// The rules of the dual filter: what it forgets, when it starts, which readings it takes, and how far it steps.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/estimators/identification/linear_slide.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

DualUkf filter_with(double scale, const DualUkfOptions& options) {
  return DualUkf(slide(), {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = scale}}, options);
}

TEST(DualUkfRules, AWeightThatNothingTellsOfIsForgottenAtARateThatFalls) {
  constexpr double kMemory = 0.5, kGrowth = 0.4, kSettle = 0.1;  // s
  constexpr double kNothing = 1e-15;                             // N m
  DualUkf filter = filter_with(kNothing, {.memory = kMemory, .memory_growth = kGrowth, .settle = kSettle});
  const std::vector<EncoderSample> record = record_of_slide(slide(), 501, 1);
  for (const EncoderSample& sample : record) {
    filter.update(sample);
    const double learnt = std::max(0.0, sample.time_s - kSettle);
    // P = exp(∫ dt / T) with T = T_0 exp(t / τ); the integral is a sum over the steps, of rates of up to 1 / T_0.
    const double exponent = kGrowth / kMemory * (1 - std::exp(-learnt / kGrowth));
    EXPECT_NEAR(2 * std::log(filter.S_w()(0, 0)), exponent, 2 * kSlideStep / kMemory) << sample.time_s;
  }
}

TEST(DualUkfRules, StepsAreToldAfterItHasSettledAndOfTheEncodersThatWereRead) {
  DualUkf filter = filter_with(0.01, {.settle = 0.1});
  std::vector<EncoderSample> record = record_of_slide(slide(), 101, 1);
  for (std::size_t i = 0; i < record.size(); ++i) {
    if (i % 4 == 1) record[i].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
    if (i % 4 >= 2) record[i].joint_position(0) = std::numeric_limits<double>::quiet_NaN();
    if (i % 4 == 3) record[i].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
    const DualStep step = filter.update(record[i]);
    const Eigen::Index readings[] = {2, 1, 1, 0};
    EXPECT_EQ(step.nu.size(), record[i].time_s > 0.1 + 1e-9 ? readings[i % 4] : 0) << i;
    EXPECT_EQ(step.Y.rows(), step.nu.size()) << i;
    EXPECT_EQ(step.S_root.rows(), step.nu.size()) << i;
  }
}

TEST(DualUkfRules, StartsAnewAfterAGapAndKeepsTheWeights) {
  const std::vector<EncoderSample> record = record_of_slide(slide(), 201, 1);
  for (const double gap : {0.25, 0.35}) {
    DualUkf filter = filter_with(0.01, {.settle = 0.05, .restart_gap = 0.3});
    for (const EncoderSample& sample : record) filter.update(sample);
    const Eigen::VectorXd learnt = filter.w();
    EncoderSample later = record.back();
    later.time_s += gap;
    const bool starts = gap > 0.3;
    EXPECT_EQ(filter.update(later).nu.size(), starts ? 0 : 2) << gap;
    if (starts) {
      EXPECT_EQ(filter.w(), learnt);
    }
    later.time_s += 0.01;
    EXPECT_EQ(filter.update(later).nu.size(), starts ? 0 : 2) << "it settles";
  }
}

TEST(DualUkfRules, AGapOfASecondIsLongUnlessToldOtherwise) {
  const std::vector<EncoderSample> record = record_of_slide(slide(), 2, 1);
  for (const double gap : {0.9, 1.1}) {
    DualUkf filter = filter_with(0.01, {.settle = 0});
    for (const EncoderSample& sample : record) filter.update(sample);
    EncoderSample later = record.back();
    later.time_s += gap;
    EXPECT_EQ(filter.update(later).nu.size(), gap > 1 ? 0 : 2) << gap;
  }
}

TEST(DualUkfRules, NoSampleMovesAWeightByMoreThanAFiftiethOfItsPrior) {
  ArmModel robot = slide();
  robot.nominal.joint[0].torque_bias = 0.2;  // 20 deviations
  DualUkf filter = filter_with(0.01, {.settle = 0.05});
  double before = 0, most = 0;
  for (const EncoderSample& sample : record_of_slide(robot, 1001, 1)) {
    filter.update(sample);
    most = std::max(most, std::abs(filter.w()(0) - before));
    before = filter.w()(0);
  }
  EXPECT_LE(most, 0.02);
  EXPECT_GT(most, 0.01);  // a step that is halved once too often would be shorter
  EXPECT_GT(before, 5);   // it goes there nevertheless
}

TEST(DualUkfRules, ALongStepGoesThroughTheSameInstantsAsSamplesWithoutReadings) {
  constexpr int kPieces = 4;
  DualUkf pieces = filter_with(0.01, {.learn = false, .settle = 0, .max_step = kSlideStep}),
          walked = filter_with(0.01, {.learn = false, .settle = 0, .max_step = 1});
  const std::vector<EncoderSample> record = record_of_slide(slide(), 201, 1);
  for (std::size_t i = 0; i < record.size(); i += kPieces) {
    const DualStep step = pieces.update(record[i]), same = walked.update(record[i]);
    for (int k = 1; k < kPieces; ++k) {
      EncoderSample blind = record[i];
      blind.time_s += k * kSlideStep;
      blind.motor_position(0) = blind.joint_position(0) = std::numeric_limits<double>::quiet_NaN();
      EXPECT_EQ(walked.update(blind).nu.size(), 0);
    }
    ASSERT_EQ(step.nu.size(), same.nu.size());
    if (step.nu.size() == 0) continue;
    // Readings of up to 1e3 rad, of which Y is a difference over 1e-3. An innovation has a deviation of 5e-4 rad.
    EXPECT_LT((step.nu - same.nu).norm(), 1e-5 * step.S_root.norm()) << record[i].time_s;
    EXPECT_LT((step.S_root - same.S_root).norm(), 1e-9 * step.S_root.norm()) << record[i].time_s;
    EXPECT_LT((step.Y - same.Y).norm(), 1e-6 * (step.Y.norm() + 1e-3)) << record[i].time_s;
  }
}

TEST(DualUkfRules, TimeThatDoesNotIncreaseIsRefusedButInANewRecord) {
  const std::vector<EncoderSample> record = record_of_slide(slide(), 3, 1);
  DualUkf filter = filter_with(0.01, {});
  filter.update(record[0]);
  filter.update(record[1]);
  EXPECT_THROW(filter.update(record[1]), std::invalid_argument);
  EXPECT_THROW(filter.update(record[0]), std::invalid_argument);
  filter.start_record();
  EXPECT_NO_THROW(filter.update(record[0]));
}

TEST(DualUkfRules, WaitsForAMotorThatHasNotBeenRead) {
  std::vector<EncoderSample> record = record_of_slide(slide(), 4, 1);
  for (const int i : {0, 1}) record[i].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
  DualUkf filter = filter_with(0.01, {.settle = 0});
  for (const int i : {0, 1, 2}) EXPECT_EQ(filter.update(record[i]).nu.size(), 0) << i;
  EXPECT_EQ(filter.update(record[3]).nu.size(), 2);
}

TEST(DualUkfRules, AReadingFromBeforeAGapIsNoStart) {
  std::vector<EncoderSample> record = record_of_slide(slide(), 5, 1);
  for (const int i : {2, 3, 4}) record[i].time_s += 2;
  record[2].motor_position(0) = std::numeric_limits<double>::quiet_NaN();
  DualUkf filter = filter_with(0.01, {.settle = 0});
  for (const int i : {0, 1, 2, 3}) EXPECT_EQ(filter.update(record[i]).nu.size(), i == 1 ? 2 : 0) << i;
  EXPECT_EQ(filter.update(record[4]).nu.size(), 2);
}

TEST(DualUkfRules, AnOffsetOfAMotorIsNoMotionOfAJointThatHasNoSensor) {
  ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2_exponential.xml");
  model.nominal.joint[0].motor_encoder_offset = 100;
  DualUkf filter(model, {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = 1e-6}}, {.settle = 0});
  EncoderSample sample;
  sample.motor_torque = Eigen::Vector3d::Zero();
  sample.motor_position = unstretched_motors(model.nominal, model.home()) + Eigen::Vector3d(100, 0, 0);
  sample.joint_position = model.home();
  sample.joint_position(0) = std::numeric_limits<double>::quiet_NaN();
  filter.update(sample);
  sample.time_s = 1e-3;
  const DualStep step = filter.update(sample);
  ASSERT_EQ(step.nu.size(), 5);
  // Gravity moves joints and motors by some micrometres and microradians within a millisecond.
  EXPECT_LT(step.nu.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(DualUkfRules, StartsWhereTheEncodersOfAllJointsSayThatTheArmIs) {
  ArmModel model = raven2();
  for (int k = 0; k < 3; ++k) {
    model.nominal.joint[k].motor_encoder_offset = 0.3 - k;
    model.nominal.joint[k].joint_encoder_offset = 0.05 * (k + 1);
  }
  DualUkf filter(model, {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = 1e-6}}, {.settle = 0});
  const Eigen::Vector3d q = model.home() + Eigen::Vector3d(0.1, -0.2, 0.03);
  EncoderSample sample;
  sample.motor_torque = Eigen::Vector3d::Zero();
  sample.motor_position = unstretched_motors(model.nominal, q) + Eigen::Vector3d(0.3, -0.7, -1.7);
  sample.joint_position = q + Eigen::Vector3d(0.05, 0.1, 0.15);
  EXPECT_EQ(filter.update(sample).nu.size(), 0);
  sample.time_s = 1e-3;
  const DualStep step = filter.update(sample);
  ASSERT_EQ(step.nu.size(), 6);
  // Gravity moves joints and motors by some micrometres and microradians within a millisecond.
  EXPECT_LT(step.nu.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(DualUkfRules, TakesTheSubStepsOfTheArmThatItBelievesIn) {
  ArmModel model = slide();
  model.nominal.joint[0].motor_viscous = 5.5;
  const std::vector<EncoderSample> record = record_of_slide(model, 2, 1);
  DualUkf filter(model, {{.key = "joint1.motor.viscous", .nominal = 5.5, .scale = 0.5, .logarithmic = true}},
                 {.learn = false});
  const auto go = [&](double w) {
    filter.set_weights(Eigen::VectorXd::Constant(1, w), Eigen::MatrixXd::Identity(1, 1));
    filter.start_record();
    for (const EncoderSample& sample : record) filter.update(sample);
  };
  EXPECT_NO_THROW(go(0));
  try {  // 4.5 times as stiff
    go(3);
    FAIL() << "took too few";
  } catch (const std::runtime_error& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("process model: a step of 0.002 s would need")) << e.what();
  }
}

TEST(DualUkfRules, AStateThatIsNotFiniteIsToldWithItsTime) {
  std::vector<EncoderSample> record = record_of_slide(slide(), 3, 1);
  for (EncoderSample& sample : record) sample.time_s += 5;
  DualUkf filter = filter_with(0.01, {});
  record[1].motor_torque(0) = 1e308;
  filter.update(record[0]);
  filter.update(record[1]);
  try {
    filter.update(record[2]);
    FAIL() << "went on";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(" is not finite at 5.004 s"), std::string::npos) << e.what();
  }
}

TEST(DualUkfRules, ALogarithmicWeightKeepsItsSign) {
  const Weight w{.key = "", .nominal = -3, .scale = 0.5, .logarithmic = true}, linear{"", -3, 0.5, false};
  EXPECT_EQ(w.value(0), -3);
  EXPECT_NEAR(w.value(2) / w.value(1), std::exp(0.5), 1e-15);
  EXPECT_NEAR(w.slope(1), (w.value(1 + 1e-6) - w.value(1 - 1e-6)) / 2e-6, 1e-8);
  EXPECT_EQ(linear.value(2), -2);
  EXPECT_EQ(linear.slope(2), 0.5);
}

TEST(DualUkfRules, AJointEncoderThatDoesNotRoundErrsByTenMicroradiansOrOneMicrometre) {
  for (const JointType type : {JointType::revolute, JointType::prismatic}) {
    ArmModel model = slide();
    model.estimators.at("sr_ukf") = {{"torque_noise", "0"}, {"joint_force_noise", "0"}};
    JointParameters<double>& j = model.nominal.joint[0];
    j.type = type;
    j.inertia[2] = j.mass;  // so that it turns as it slides
    j.joint_encoder_resolution = 0;
    DualUkf filter(model, {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = 1e-15}},
                   {.learn = false, .settle = 0});
    EncoderSample sample;
    sample.motor_torque = sample.motor_position = sample.joint_position = Eigen::VectorXd::Zero(1);
    DualStep last;
    for (int i = 0; i < 200; ++i) {
      sample.time_s = i * kSlideStep;
      last = filter.update(sample);
    }
    // Its motion is certain by now, so that the encoder's error is left of the innovation.
    ASSERT_EQ(last.nu.size(), 2);
    const double expected = type == JointType::revolute ? 1e-5 : 1e-6;
    EXPECT_NEAR(last.S_root.row(1).norm(), expected, 0.05 * expected);
  }
}

TEST(DualUkfRules, AMeasuredLoadMovesWhatItPredicts) {
  const ArmModel model = slide();
  const double torque = 0, load = 40;
  const auto predicted = [&](bool is_loaded) {
    DualUkf filter = filter_with(1e-15, {.learn = false, .settle = 0});
    EncoderSample sample;
    sample.motor_torque = sample.motor_position = sample.joint_position = Eigen::VectorXd::Zero(1);
    if (is_loaded) sample.joint_torque = Eigen::VectorXd::Constant(1, load);
    filter.update(sample);
    sample.time_s = kSlideStep;
    return Eigen::VectorXd(-filter.update(sample).nu);  // of readings of zero
  };
  const ProcessModel process(model);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  process.advance({0, kSlideStep, &torque, &load}, x.data());
  const Eigen::Vector2d moved(x(*process.layout().motor_angle[0]), x(process.layout().position[0]));
  ASSERT_GT(moved.norm(), 1e-5);
  // Sigma points of rates of 2e3 rad/s, a thousandth of a deviation apart, round to some 1e-12 rad.
  EXPECT_LT((predicted(true) - predicted(false) - moved).norm(), 1e-6 * moved.norm());
}

TEST(DualUkfRules, ANewRecordForgetsTorquesLoadsAndReadingsOfTheOneBefore) {
  ArmModel model = slide();
  add_effect(model, "delay", 0, {3e-3});
  const std::vector<Weight> weights = {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = 0.01}};
  const DualUkfOptions options{.learn = false, .settle = 0};
  DualUkf used(model, weights, options), fresh(model, weights, options);
  for (EncoderSample& sample : record_of_slide(slide(), 20, 1)) {
    sample.joint_torque = Eigen::VectorXd::Constant(1, 30);
    used.update(sample);
  }
  used.start_record();
  std::vector<EncoderSample> record = record_of_slide(slide(), 20, 2);
  record[0].motor_torque(0) = record[0].motor_position(0) = record[0].joint_position(0) =
      std::numeric_limits<double>::quiet_NaN();
  for (const EncoderSample& sample : record) {
    const DualStep a = used.update(sample), b = fresh.update(sample);
    ASSERT_EQ(a.nu.size(), b.nu.size()) << sample.time_s;
    EXPECT_EQ(a.nu, b.nu) << sample.time_s;
    EXPECT_EQ(a.S_root, b.S_root) << sample.time_s;
  }
}

TEST(DualUkfRules, ByDefaultItSettlesForHalfASecondAndForgetsInTwo) {
  DualUkf filter = filter_with(1e-15, {});
  for (const EncoderSample& sample : record_of_slide(slide(), 501, 1)) filter.update(sample);
  // As above: T = 2 s exp(t / 2 s), over the half second that is left of one.
  EXPECT_NEAR(2 * std::log(filter.S_w()(0, 0)), 1 - std::exp(-0.25), kSlideStep);
}

TEST(DualUkfRules, SmallerDisturbancesAreThoseOfTorquesAndOfForces) {
  const ArmModel model = slide();
  ArmModel halved = model;
  halved.estimators.at("sr_ukf") = {{"torque_noise", "0.01"}, {"joint_force_noise", "2.5"}};
  const std::vector<Weight> weights = {{.key = "joint1.motor.torque_bias", .nominal = 0, .scale = 0.01}};
  DualUkf scaled(model, weights, {.learn = false, .disturbances = 0.5, .settle = 0}),
      told(halved, weights, {.learn = false, .settle = 0});
  for (const EncoderSample& sample : record_of_slide(model, 20, 1)) {
    const DualStep a = scaled.update(sample), b = told.update(sample);
    ASSERT_EQ(a.nu.size(), b.nu.size()) << sample.time_s;
    EXPECT_EQ(a.S_root, b.S_root) << sample.time_s << ": halves are exact";
  }
}

TEST(DualUkfRules, AStepIsOfTenMillisecondsAtMostUnlessToldOtherwise) {
  DualUkf standard = filter_with(0.01, {.learn = false, .settle = 0}),
          told = filter_with(0.01, {.learn = false, .settle = 0, .max_step = 0.01});
  const std::vector<EncoderSample> record = record_of_slide(slide(), 201, 1);
  for (std::size_t i = 0; i < record.size(); i += 20) {  // 40 ms
    const DualStep a = standard.update(record[i]), b = told.update(record[i]);
    ASSERT_EQ(a.nu.size(), b.nu.size()) << i;
    EXPECT_EQ(a.nu, b.nu) << i;
    EXPECT_EQ(a.S_root, b.S_root) << i;
  }
}

}  // namespace
}  // namespace halyard
