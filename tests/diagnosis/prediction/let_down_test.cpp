// Where a prediction starts: on its cables, and in motion if the motors move.
#include "diagnosis/prediction/start/let_down.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr int kElbow = 1;

/// Two joints that swing on their cables for half a second, because neither friction nor damping stops them.
ArmModel swinging_arm() {
  ArmModel model = first_joints(2);
  for (int k = 0; k < 2; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j.damping /= 20;
    j.joint_coulomb = 0;
    j.joint_viscous = 0.05;
  }
  return model;
}

Record whole_record(const Log& log, const ArmModel& model) {
  RecordOptions options;
  options.motion_hz = 500;  // as good as no filter
  options.compare_hz = options.settle_s = 0;
  return make_records(log, model, options).at(0);
}

TEST(LetDown, AnArmThatIsHeldDoesNotSwing) {
  const ArmModel model = swinging_arm();
  Log log(2);
  for (int i = 0; i <= 2000; ++i) {
    log.time.push_back(1e-3 * i);
    for (int k = 0; k < 2; ++k) log.motor_position[k].push_back(100), log.joint_position[k].push_back(0.5);
  }
  const Record record = whole_record(log, model);
  std::vector<double> reading = predict_fully(record, {model.nominal, {}}).joint_reading[kElbow];
  std::erase_if(reading, [](double q) { return std::isnan(q); });  // the last one is not compared
  ASSERT_GT(reading.size(), 500u);
  const auto [least, most] = std::ranges::minmax(reading);
  const double unstretched = unstretched_joints(model.nominal, Eigen::Vector2d(100, 100), model.home())(kElbow);
  const double sag = std::abs(reading.back() - unstretched);
  EXPECT_GT(sag, 1e-4) << "nothing hangs on the cable: the test shows nothing";
  EXPECT_LT(most - least, 0.02 * sag);
}

/// Largest error of the prediction from `from` to `to` seconds after its start, of a log that begins at `cut`.
double error_of(const Log& whole, double cut, double from, double to, const ArmModel& model) {
  const auto first = std::ranges::lower_bound(whole.time, cut) - whole.time.begin();
  Log log(2);
  log.time.assign(whole.time.begin() + first, whole.time.end());
  for (int k = 0; k < 2; ++k) {
    log.motor_position[k].assign(whole.motor_position[k].begin() + first, whole.motor_position[k].end());
    log.joint_position[k].assign(whole.joint_position[k].begin() + first, whole.joint_position[k].end());
  }
  const Record record = whole_record(log, model);
  const std::vector<double> reading = predict_fully(record, {model.nominal, {}}).joint_reading[kElbow];
  double most = 0;
  for (auto i = static_cast<std::size_t>(from / record.dt); i < static_cast<std::size_t>(to / record.dt); ++i)
    most = std::max(most, std::abs(reading[i] - record.joint_raw[kElbow][i]));
  return most;
}

TEST(RunIn, ARecordThatStartsInMotionIsPredictedAsOneThatStartedBefore) {
  const ArmModel model = swinging_arm();
  Scenario s = motion(model, 4);
  s.quantise = false;
  const Log log = simulate(s).measured;
  const double long_ago = error_of(log, 0, 2.5, 3, model);
  EXPECT_LT(error_of(log, 2, 0.5, 1, model), long_ago + 2e-5);
}

}  // namespace
}  // namespace halyard
