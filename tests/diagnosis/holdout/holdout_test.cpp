#include "diagnosis/holdout/holdout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/record/resting.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/limits.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr std::size_t kSamples = 400;
constexpr double kSmoothing = 0.5;  // rad/s
// Sums of so many numbers of about one.
constexpr double kRounding = 4 * kSamples * kEps;

/// One joint with a sensor, and a torque, all zero. The motor turns at 10 rad/s in the first quarter and then rests.
Record small_record() {
  Record r;
  r.n = 1;
  r.dt = 0.01;
  r.size = kSamples;
  r.compare = {1};
  const Signals zero(1, std::vector<double>(kSamples, 0)), one(1, std::vector<double>(kSamples, 1));
  r.motor_rate = r.torque = r.joint = r.joint_raw = zero;
  r.joint_valid = r.torque_valid = one;
  for (std::size_t i = 0; i < kSamples / 4; ++i) r.motor_rate[0][i] = 10;
  return r;
}

/// A hold-out of that record with the errors error(i) of joint and torque.
template <class Error>
HoldOut holdout_with(const Record& record, const Error& error) {
  FullPrediction p{Signals(1), Signals(1)};
  for (std::size_t i = 0; i < kSamples; ++i) {
    p.joint_reading[0].push_back(-error(i));
    p.torque_residual[0].push_back(error(i));
  }
  return {{record}, {p}, {p}};
}

template <class Error>
PredictionError errors_with(const Record& record, const Error& error) {
  ArmParameters<double> arm;
  arm.n = 1;
  arm.joint[0].motor_smoothing = kSmoothing;
  const HoldOut view = holdout_with(record, error);
  return prediction_errors(view, view, arm, &HoldOut::after);
}

TEST(HoldOutError, IsTheBiasOfAKnownOffsetAndTheSpreadAboutIt) {
  const auto e = errors_with(small_record(), [](std::size_t i) { return i % 2 == 0 ? 0.5 : -0.1; });
  for (const ErrorParts& parts : {e.joint, e.torque}) {
    EXPECT_NEAR(parts.bias[0], 0.2, kRounding);
    EXPECT_NEAR(parts.spread[0], 0.3, kRounding);
  }
  EXPECT_NEAR(e.joint_rms[0], std::hypot(0.2, 0.3), kRounding);
  EXPECT_EQ(e.joint_peak[0], 0.5);
}

TEST(HoldOutError, IsCountedSeparatelyWhereTheMotorMovesAndRests) {
  const auto e = errors_with(small_record(), [](std::size_t i) { return i < kSamples / 4 ? 3.0 : -1.0; });
  for (const ErrorParts& parts : {e.joint, e.torque}) {
    EXPECT_NEAR(parts.moving_rms[0], 3, kRounding);
    EXPECT_NEAR(parts.resting_rms[0], 1, kRounding);
  }
  EXPECT_NEAR(e.torque_rms[0], std::sqrt((9 + 3 * 1) / 4.0), kRounding);
}

TEST(HoldOutError, OfAMotorThatNeverRestsHasNoRestingPart) {
  Record record = small_record();
  record.motor_rate[0].assign(kSamples, -10);
  const auto e = errors_with(record, [](std::size_t) { return 1.0; });
  EXPECT_TRUE(std::isnan(e.joint.resting_rms[0]));
  EXPECT_NEAR(e.joint.moving_rms[0], 1, kRounding);
}

TEST(HoldOutError, IgnoresSamplesThatAreNotCompared) {
  Record record = small_record();
  record.joint_valid[0][7] = record.torque_valid[0][7] = 0;
  const auto e = errors_with(record, [](std::size_t i) { return i == 7 ? 100.0 : 0.0; });
  EXPECT_EQ(e.joint_peak[0], 0);
  EXPECT_EQ(e.torque.bias[0], 0);
}

/// The training data have no joint sensor, the hold-out has one. A drive's ratio that is off within its tolerance moves
/// the joint's reading: nothing that the training data could tell, and no reason to give up what they told.
/// A hold-out with all sensors, and training data that lack the last joint's.
struct WithoutLastSensor {
  ArmModel model;
  Evidence evidence;
  HoldOut joints, torques;

  WithoutLastSensor(int n, double seconds)
      : model(first_joints(n)),
        evidence(make_records(training(model, seconds), model, {}), model),
        joints{make_records(simulate(motion(model, seconds, 1)).measured, model, kJointErrorBand), {}, {}},
        torques{make_records(simulate(motion(model, seconds, 1)).measured, model, {}), {}, {}} {}

  static Log training(const ArmModel& model, double seconds) {
    Log log = simulate(motion(model, seconds)).measured;
    log.joint_position.back().clear();
    return log;
  }
};

TEST(HoldOutFloors, AreThoseOfTheTrainingDataWhereTheyHaveTheChannel) {
  const WithoutLastSensor data(2, 2);
  const std::vector<double> floor = holdout_floors(data.evidence, data.model, data.joints, data.torques);
  for (const int c : {0, 1, 2}) EXPECT_EQ(floor[c], data.evidence.floor()[c]) << c;
  EXPECT_GT(floor[3], 1e-4) << "rad; tolerances of lengths of some percent";
}

TEST(HoldOutFloors, AllowTheTolerancesWhereNoTrainingDataAre) {
  WithoutLastSensor data(1, 4);
  const std::vector<double> floor = holdout_floors(data.evidence, data.model, data.joints, data.torques);
  const Hypothesis given{data.model.nominal, {}};
  for (HoldOut* view : {&data.joints, &data.torques}) view->before = view->after = predict_all(view->records, given);
  const auto worse_with = [&](double tolerances) {
    Hypothesis revised = given;
    revised.nominal.joint[0].capstan_radius *= 1 + tolerances * data.model.joints[0].tolerances.length;
    data.joints.after = predict_all(data.joints.records, revised);
    return worse_joints(data.model, data.joints, data.torques, floor);
  };
  EXPECT_TRUE(worse_with(0.5).empty());
  EXPECT_EQ(worse_with(5), std::vector<int>{0});
}

TEST(WorseJoints, DoNotCountTorquesOfMotorsAtRest) {
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_smoothing = kSmoothing;
  Record record = small_record();
  record.dt = 0.05;
  for (std::size_t i = 0; i < kSamples / 2; ++i) record.motor_rate[0][i] = 10;  // ten seconds, and ten at rest
  const auto worse = [&](double moving, double resting) {
    const auto size = [&](std::size_t i) { return (i < kSamples / 2 ? moving : resting) * (1 + 1e-3 * (i % 7)); };
    const HoldOut none = holdout_with(record, [](std::size_t) { return 0.0; });
    HoldOut torques = none;
    torques.after = holdout_with(record, size).after;
    return worse_joints(model, none, torques, {0.1, 0.1});
  };
  EXPECT_TRUE(worse(0, 1).empty());
  EXPECT_EQ(worse(1, 0), std::vector<int>{0});
}

TEST(Resting, IsMostOfWhatTheComparingKernelSees) {
  Record record = small_record();
  record.compare = {0.2, 0.2, 0.2, 0.2, 0.2};
  record.motor_rate[0].assign(kSamples, 10);
  record.motor_rate[0][100] = record.motor_rate[0][101] = 0;
  EXPECT_FALSE(rests(record, 0, 100, kSmoothing)) << "it reverses";
  record.motor_rate[0][102] = 0;
  EXPECT_TRUE(rests(record, 0, 101, kSmoothing));
  EXPECT_FALSE(rests(record, 0, 99, kSmoothing));
}

TEST(Resting, IsSlowerThanTwiceTheSmoothingOfFriction) {
  Record record = small_record();
  record.motor_rate[0].assign(kSamples, -1.99 * kSmoothing);
  EXPECT_TRUE(rests(record, 0, 50, kSmoothing));
  record.motor_rate[0].assign(kSamples, -2.01 * kSmoothing);
  EXPECT_FALSE(rests(record, 0, 50, kSmoothing));
}

TEST(SlowestSmoothing, IsTheLeastThatItsToleranceAdmits) {
  ArmModel model = first_joints(2);
  model.nominal.joint[1].motor_smoothing = 2;
  EXPECT_EQ(slowest_smoothing(model, 1), 2);
  model.joints[1].tolerances.smoothing = 0.75;
  EXPECT_EQ(slowest_smoothing(model, 1), 0.5);
  model.joints[1].tolerances.smoothing = 3;
  EXPECT_DOUBLE_EQ(slowest_smoothing(model, 1), 0.2);
}

/// worse_joints() of a moving motor whose torque residual of about 1 grows to this size. floor: of both channels.
std::vector<int> worse_after(double size, double floor, double seconds = 20) {
  Record record = small_record();
  record.dt = seconds / kSamples;
  record.motor_rate[0].assign(kSamples, 100);
  const auto about = [](double mean) {
    return [mean](std::size_t i) { return mean * (1 + 1e-3 * static_cast<double>(i % 7)); };
  };
  const HoldOut none = holdout_with(record, [](std::size_t) { return 0.0; });
  HoldOut torques = holdout_with(record, about(1));
  torques.after = holdout_with(record, about(size)).after;
  return worse_joints(first_joints(1), none, torques, {floor, floor});
}

TEST(WorseJoints, AreThoseWhoseSquaresGrowByAFortieth) {
  EXPECT_TRUE(worse_after(1.01, 0.01).empty()) << "by 2 %";
  EXPECT_EQ(worse_after(1.02, 0.01), std::vector<int>{0}) << "by 4 %";
  EXPECT_TRUE(worse_after(0.5, 0.01).empty());
}

TEST(WorseJoints, AreSeenInShortHoldOuts) {
  for (const double seconds : {1.5, 2.0, 2.5, 3.0, 9.01})
    EXPECT_EQ(worse_after(1.9, 0.01, seconds).size(), 1u) << seconds;
}

TEST(WorseJoints, AreSeenBySlowSensors) {
  // Ten readings in four seconds: eight blocks.
  Record record = small_record();
  for (std::size_t i = 0; i < kSamples; ++i) record.joint_valid[0][i] = i % 40 == 0;
  HoldOut joints = holdout_with(record, [](std::size_t) { return 1.0; });
  const auto larger = [](std::size_t i) { return 1.9 * (1 + 1e-3 * static_cast<double>(i % 7)); };
  joints.after = holdout_with(record, larger).after;
  EXPECT_EQ(worse_joints(first_joints(1), joints, {}, {0.01, 0.01}), std::vector<int>{0});
}

TEST(WorseJoints, AreThoseThatCannotBePredictedAnyMore) {
  const ArmModel model = first_joints(1);
  Record record = small_record();
  record.motor_rate[0].assign(kSamples, 100);
  HoldOut torques = holdout_with(record, [](std::size_t) { return 1.0; });
  for (double& e : torques.after[0].torque_residual[0]) e = std::numeric_limits<double>::quiet_NaN();
  const HoldOut none = holdout_with(record, [](std::size_t) { return 0.0; });
  EXPECT_EQ(worse_joints(model, none, torques, {0.01, 0.01}), std::vector<int>{0});
  EXPECT_EQ(error_over_floors(model, none, torques, &HoldOut::after, {0.01, 0.01}),
            std::numeric_limits<double>::infinity());
}

TEST(WorseJoints, AreNoneWhoseSquaresGrowByLessThanASquaredFloor) {
  EXPECT_TRUE(worse_after(1.7, 1.5).empty()) << "from 1 to 2.9; the squared floor is 2.25";
  EXPECT_EQ(worse_after(1.9, 1.5), std::vector<int>{0}) << "from 1 to 3.6";
}

TEST(Resting, SeesNothingBeyondTheEndOfARecord) {
  Record record = small_record();
  record.compare = {0.2, 0.2, 0.2, 0.2, 0.2};
  // The last sample moves; behind it the memory has zeros.
  record.motor_rate[0].assign(kSamples + 2, 0);
  record.motor_rate[0][kSamples - 1] = 10;
  record.motor_rate[0].resize(kSamples);
  EXPECT_FALSE(rests(record, 0, kSamples - 1, kSmoothing)) << "two fifths of the kernel see a rest";
  EXPECT_TRUE(rests(record, 0, kSamples - 2, kSmoothing)) << "three fifths";
}

TEST(WorseJoints, AreNoneThatASingleSecondMakesWorse) {
  const ArmModel model = first_joints(1);
  Record record = small_record();
  record.dt = 0.05;  // 20 s
  record.motor_rate[0].assign(kSamples, 100);
  const HoldOut none = holdout_with(record, [](std::size_t) { return 0.0; });
  HoldOut torques = none;
  // By Student's distribution a mean of one standard error is 17 % probable.
  torques.after = holdout_with(record, [](std::size_t i) { return i / 20 == 7 ? 10.0 : 0.0; }).after;
  EXPECT_TRUE(worse_joints(model, none, torques, {0.01, 0.01}).empty());
}

TEST(ErrorOverFloors, IsTheSumOfSquaresOfBothViewsWithoutTorquesAtRest) {
  ArmModel model = first_joints(1);
  model.nominal.joint[0].motor_smoothing = kSmoothing;
  // The motor moves in the first quarter.
  const HoldOut view = holdout_with(small_record(), [](std::size_t) { return 0.6; });
  EXPECT_NEAR(error_over_floors(model, view, view, &HoldOut::after, {0.3, 0.2}), (4 * 0.25 + 9) * kSamples, 1e-9);
  EXPECT_NEAR(error_over_floors(model, view, view, &HoldOut::after, {0.3, 0}), 4 * 0.25 * kSamples, 1e-9);
}

TEST(HoldOutData, IsTheLastThirdOfALogWhoseStartIsPredictedAndNotCompared) {
  const ArmModel model = first_joints(1);
  const std::vector<Log> logs = {log_along(9, 100, slow_swing)};
  const DiagnosisData data = diagnosis_data(model, logs, std::nullopt, model);
  ASSERT_EQ(data.training.size(), 1u);
  const Record& training = data.training[0];
  EXPECT_NEAR(training.time(training.size - 1), 6, 0.02);
  for (const HoldOut* view : {&data.joint_view, &data.torque_view}) {
    ASSERT_EQ(view->records.size(), 1u);
    const Record& r = view->records[0];
    EXPECT_EQ(r.start, 0);
    EXPECT_EQ(r.place, 0u) << "its past is that of the training record";
    const std::vector<double>& valid = r.joint_valid[0];
    const auto first = std::ranges::find(valid, 1.0);
    ASSERT_NE(first, valid.end());
    EXPECT_NEAR(r.time(static_cast<std::size_t>(first - valid.begin())), 6, 0.02);
  }
}

TEST(HoldOutData, ThatGapsLeaveTooShortToRefuseAModelAreAnError) {
  const ArmModel model = first_joints(1);
  // The last third begins at 8 s. Stretches of less than 1.5 s are left out, and the first half second of each.
  const auto message = [&](double gap_from, double gap_to) {
    const Log whole = log_along(12, 100, slow_swing);
    Log log(1);
    log.source = "some.csv";
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (whole.time[i] > gap_from && whole.time[i] < gap_to) continue;
      log.time.push_back(whole.time[i]);
      log.motor_position[0].push_back(whole.motor_position[0][i]);
      log.joint_position[0].push_back(whole.joint_position[0][i]);
    }
    return message_of([&] { diagnosis_data(model, {log}, std::nullopt, model); });
  };
  const std::string too_short =
      "some.csv: the last third of each log is held out, and its gaps leave 0 s of it to compare; expected at least "
      "0.7 s, or a hold-out log of its own";
  EXPECT_EQ(message(7.5, 10.8), too_short);
  EXPECT_EQ(message(7.5, 9), "no InputError");
}

TEST(HoldOutFloors, OfSeveralTolerancesAreTheRootOfTheSumOfTheirSquares) {
  WithoutLastSensor data(1, 2);
  const auto floor_with = [&](double length, double friction) {
    Tolerances t{0, 0, 0, 0, 0, 0, 0, 0, 0};
    t.length = length, t.friction = friction;
    data.model.joints[0].tolerances = t;
    return holdout_floors(data.evidence, data.model, data.joints, data.torques)[1];
  };
  const double of_ratio = floor_with(1e-4, 0), of_friction = floor_with(0, 2), of_both = floor_with(1e-4, 2);
  // Three lengths make the ratio of a drive. The joint is at 0.4 to 1.2 rad, mostly about its middle.
  EXPECT_GT(of_ratio, 3e-4 * 0.5);
  EXPECT_LT(of_ratio, 3e-4 * 1.2);
  EXPECT_GT(of_friction, 0.1 * of_ratio) << "the test shows nothing";
  EXPECT_NEAR(of_both, std::hypot(of_ratio, of_friction), 1e-3 * of_both);
}

TEST(WorseJoints, AreNoneThatTwoSecondsOfTwentyMakeWorse) {
  Record record = small_record();
  record.dt = 0.05;
  record.motor_rate[0].assign(kSamples, 100);
  const HoldOut none = holdout_with(record, [](std::size_t) { return 0.0; });
  HoldOut torques = none;
  const auto error = [](std::size_t i) { return i / 20 == 7 || i / 20 == 8 ? 10.0 : 0.0; };
  torques.after = holdout_with(record, error).after;
  // Over blocks of a second a mean of 1.45 standard errors, 8 % probable; over quarters of one it would be 0.2 %.
  EXPECT_TRUE(worse_joints(first_joints(1), none, torques, {0.01, 0.01}).empty());
}

TEST(HoldOutError, OfAJointWithoutReadingsIsNotToldAsNone) {
  Record record = small_record();
  record.joint_valid[0].assign(kSamples, 0);
  const auto e = errors_with(record, [](std::size_t) { return 1.0; });
  EXPECT_TRUE(std::isnan(e.joint_rms[0]));
  EXPECT_TRUE(std::isnan(e.joint_peak[0]));
  EXPECT_TRUE(std::isnan(e.joint.bias[0]));
  EXPECT_NEAR(e.torque_rms[0], 1, kRounding);
}

}  // namespace
}  // namespace halyard
