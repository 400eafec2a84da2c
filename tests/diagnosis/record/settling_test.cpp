// What of a record's start is not compared, and whether it starts in motion.
#include "diagnosis/record/settling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/record/start_of_motion.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(SettlingTime, IsTwoTimeConstantsOfTheSlowestSwing) {
  // One joint: J q'' + d q' + c q = 0 swings with the time constant 2 J / d.
  ArmModel model = first_joints(1);
  JointParameters<double>& j = model.nominal.joint[0];
  j.joint_viscous = 0;
  const auto time_at = [&](double damping) {
    j.damping = damping;
    return settling_time(model, 1e-3);
  };
  EXPECT_NEAR(time_at(50) / time_at(100), 2, 0.02);
  const double once = time_at(50);
  EXPECT_EQ(settling_time(model, 2 * once), 2 * once);
  EXPECT_EQ(time_at(1e-6), 3) << "a record is not given up";
}

TEST(SettlingTime, OfTheRavenIsTheUsualOne) { EXPECT_EQ(settling_time(first_joints(3), 0.5), 0.5); }

Log cut_at(const Log& whole, double time) {
  Log log(whole.n_joints);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole.time[i] < time) continue;
    log.time.push_back(whole.time[i]);
    for (int k = 0; k < log.n_joints; ++k) {
      log.motor_position[k].push_back(whole.motor_position[k][i]);
      if (whole.has_joint_position(k)) log.joint_position[k].push_back(whole.joint_position[k][i]);
    }
  }
  return log;
}

StartOfMotion start_of(const Log& log, const ArmModel& model) {
  return make_records(log, model, {}).at(0).first_motion;
}

TEST(StartOfMotion, IsThatOfTheMotorsWhereARecordBeginsInMotion) {
  const ArmModel model = first_joints(2);
  Log log = simulate(motion(model, 4)).measured;
  EXPECT_FALSE(start_of(log, model).is_there()) << "at rest";
  const StartOfMotion start = start_of(cut_at(log, 2), model);
  ASSERT_TRUE(start.is_there());
  const auto at = [&](int k, double t) {
    return log.motor_position[k][static_cast<std::size_t>(std::lround(1e3 * t))];
  };
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(start.angle[k], at(k, 2), 0.01);
    const double rate = (at(k, 2.02) - at(k, 1.98)) / 0.04;
    EXPECT_NEAR(start.rate[k], rate, 0.05 * std::abs(rate) + 0.5) << k;
  }
}

TEST(StartOfMotion, IsNoneIfTheJointsDoNotMoveWithTheMotors) {
  const ArmModel model = first_joints(1);
  Log log(1);
  for (int i = 0; i <= 3000; ++i) {
    const double t = 1e-3 * i;
    log.time.push_back(t);
    log.motor_position[0].push_back(107 - 60 * t * std::exp(-10 * t));  // falls into its cable
    log.joint_position[0].push_back(0.8 + 1e-4 * (i % 2));
  }
  EXPECT_FALSE(start_of(log, model).is_there());
}

}  // namespace
}  // namespace halyard
