/// Signals that a residual may depend on, of a right model and of one whose errors are known.

#include "diagnosis/explanation/residual_signals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimators/process/standstill.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// Records of two joints in motion, with the model's own predictions.
struct Observed {
  ArmModel model = first_joints(2);
  std::vector<Record> records;
  std::vector<FullPrediction> predictions;

  explicit Observed(const Scenario& scenario) {
    records = make_records(simulate(scenario).measured, model, {});
    for (const Record& r : records) predictions.push_back(predict_fully(r, hypothesis()));
  }
  Hypothesis hypothesis() const { return {model.nominal, {}}; }
  ResidualSignals signals(int joint) const { return residual_signals(records, predictions, hypothesis(), joint); }
};

Scenario fine_motion() {
  Scenario s = motion(first_joints(2), 6);
  s.quantise = false;
  return s;
}

const Observed& in_motion() {
  static const Observed observed(fine_motion());
  return observed;
}

double rms(const std::vector<double>& x) {
  double square = 0, n = 0;
  for (const double v : x)
    if (std::isfinite(v)) square += v * v, n += 1;
  return std::sqrt(square / n);
}

TEST(ResidualSignals, AreAHundredOfEachASecond) {
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals s = in_motion().signals(k);
    EXPECT_NEAR(s.dt, 0.01, 1e-9);
    const std::size_t n = s.time.size();
    EXPECT_NEAR(static_cast<double>(n), 600, 2);
    for (std::size_t i = 1; i < n; ++i) ASSERT_NEAR(s.time[i] - s.time[i - 1], s.dt, 1e-9);
    for (const std::vector<double>* x : {&s.joint_position, &s.joint_rate, &s.motor_rate, &s.joint_direction,
                                         &s.motor_direction, &s.load, &s.stretch, &s.motor_angle, &s.capstan_angle})
      EXPECT_EQ(x->size(), n);
    for (const ResidualKind kind : kResidualKinds) EXPECT_EQ(s.of(kind).size(), n);
  }
}

TEST(ResidualSignals, TheTimeIsThatOfTheClockOfAllLogs) {
  Observed o = in_motion();
  o.records[0].clock_shift = 7;
  const ResidualSignals own = in_motion().signals(0), shifted = o.signals(0);
  ASSERT_EQ(shifted.time.size(), own.time.size());
  for (std::size_t i = 0; i < own.time.size(); ++i) ASSERT_NEAR(shifted.time[i], own.time[i] + 7, 1e-9);
}

TEST(ResidualSignals, TheMotionIsThatOfTheMotorsWithoutStretch) {
  const Observed& o = in_motion();
  const Record& r = o.records[0];
  const int stride = static_cast<int>(std::lround(0.01 / r.dt));
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals s = o.signals(k);
    for (std::size_t i = 0; i < s.time.size(); i += 7) {
      const std::size_t at = i * stride;
      const Eigen::Vector2d angle(r.motor_angle[0][at], r.motor_angle[1][at]),
          rate(r.motor_rate[0][at], r.motor_rate[1][at]), none = Eigen::Vector2d::Zero();
      EXPECT_NEAR(s.joint_position[i], unstretched_joints(o.model.nominal, angle, none)(k), 1e-12);
      EXPECT_NEAR(s.joint_rate[i], unstretched_joints(o.model.nominal, rate, none)(k), 1e-12);
      EXPECT_EQ(s.motor_angle[i], r.motor_angle[k][at]);
      EXPECT_EQ(s.motor_rate[i], r.motor_rate[k][at]);
      EXPECT_NEAR(s.capstan_angle[i] * o.model.nominal.joint[k].gear_ratio, s.motor_angle[i], 1e-9);
      EXPECT_NEAR(s.time[i], r.time(at), 1e-12);
    }
  }
}

TEST(ResidualSignals, AJointWithoutMotorMovesAsItsSensorSays) {
  Log log = simulate(fine_motion()).measured;
  log.motor_position[0].clear(), log.motor_torque[0].clear();
  ArmModel model = first_joints(2);
  model.nominal.joint[0].drive = Drive::none;
  const std::vector<Record> records = make_records(log, model, {});
  const Record& r = records[0];
  const Hypothesis h{model.nominal, {}};
  const std::vector<FullPrediction> predictions = {predict_fully(r, h)};
  const ResidualSignals shoulder = residual_signals(records, predictions, h, 0),
                        elbow = residual_signals(records, predictions, h, 1), driven = in_motion().signals(1);
  const int stride = static_cast<int>(std::lround(0.01 / r.dt));
  double error = 0, n = 0;
  for (std::size_t i = 0; i < shoulder.time.size(); ++i) {
    EXPECT_NEAR(shoulder.joint_position[i], r.motor_angle[0][i * stride], 1e-12);
    EXPECT_NEAR(shoulder.joint_rate[i], r.motor_rate[0][i * stride], 1e-12);
    const double e = elbow.load[i] - driven.load[i];
    if (std::isfinite(e)) error += e * e, n += 1;
  }
  // Where the shoulder's own cable stretches, the load of the elbow differs from that by the motors alone.
  EXPECT_LT(std::sqrt(error / n), 0.02 * rms(driven.load));
}

TEST(ResidualSignals, ADirectionIsThatOfTheLastMotionAboveRest) {
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals s = in_motion().signals(k);
    double last = 0;
    int turns = 0;
    for (std::size_t i = 0; i < s.time.size(); ++i) {
      ASSERT_EQ(std::abs(s.joint_direction[i]), 1);
      ASSERT_EQ(std::abs(s.motor_direction[i]), 1);
      // A tenth of the usual rate is certainly a motion.
      if (std::abs(s.joint_rate[i]) > 0.1 * rms(s.joint_rate)) {
        EXPECT_EQ(s.joint_direction[i], s.joint_rate[i] > 0 ? 1 : -1) << s.time[i];
      }
      if (std::abs(s.motor_rate[i]) > 0.1 * rms(s.motor_rate)) {
        EXPECT_EQ(s.motor_direction[i], s.motor_rate[i] > 0 ? 1 : -1) << s.time[i];
      }
      turns += last != 0 && last != s.joint_direction[i];
      last = s.joint_direction[i];
    }
    EXPECT_GT(turns, 3);
  }
}

TEST(ResidualSignals, BeforeTheFirstMotionTheDirectionIsThatOfTheFirst) {
  // The arm stands for a second, goes up, and comes back: its last motion is down.
  Scenario there_and_back = fine_motion();
  there_and_back.fade_in_s = 0;
  for (JointTrajectory& t : there_and_back.trajectory) {
    t.kind = JointTrajectory::Kind::point_to_point;
    t.points = {t.center, t.center, t.center + 0.2, t.center};
    t.move_s = 1;
  }
  const Observed o(there_and_back);
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals s = o.signals(k);
    EXPECT_EQ(s.joint_direction.front(), 1) << "joint " << k + 1;
    EXPECT_EQ(s.joint_direction.back(), -1) << "joint " << k + 1;
  }
}

TEST(ResidualSignals, OfARightModelTheTransmissionsIsTheStretchAndTheOthersVanish) {
  const Observed& o = in_motion();
  const ResidualSignals of_each[] = {o.signals(0), o.signals(1)};
  const Eigen::MatrixXd per_path = path_matrix(o.model.nominal).inverse();
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals& s = of_each[k];
    const JointParameters<double>& j = o.model.nominal.joint[k];
    const std::vector<double>& seen = s.of(ResidualKind::transmission);
    EXPECT_LT(rms(s.of(ResidualKind::joint_position)), 0.05 * rms(seen));
    EXPECT_LT(rms(s.of(ResidualKind::motor_torque)), 0.1 * rms(s.load) * j.motor_travel());
    // What cables, friction and load leave of the force beside what the motion needs.
    EXPECT_LT(rms(s.of(ResidualKind::joint_torque)), 0.15 * rms(s.load) * std::abs(j.pulley_radius));
    std::vector<double> off;
    for (std::size_t i = 0; i < s.time.size(); ++i)
      off.push_back(seen[i] - per_path(k, 0) * of_each[0].stretch[i] - per_path(k, 1) * of_each[1].stretch[i]);
    EXPECT_LT(rms(off), 0.1 * rms(seen)) << "joint " << k + 1;
  }
}

TEST(ResidualSignals, AnOffsetOfTheModelIsTheirMeanAndTheOpposite) {
  Observed o(fine_motion());
  // A reading that is 0.1 too large, which the model does not know: the sensor is above, the motors below.
  for (Record& r : o.records)
    for (double& q : r.joint[1]) q += 0.1;
  const ResidualSignals s = o.signals(1), right = in_motion().signals(1);
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    if (!std::isfinite(s.of(ResidualKind::joint_position)[i])) continue;
    EXPECT_NEAR(s.of(ResidualKind::joint_position)[i] - right.of(ResidualKind::joint_position)[i], 0.1, 1e-9);
    EXPECT_NEAR(s.of(ResidualKind::transmission)[i] - right.of(ResidualKind::transmission)[i], -0.1, 1e-9);
  }
}

TEST(ResidualSignals, TheLoadOfAnArmAtRestIsGravity) {
  Scenario still = fine_motion();
  for (JointTrajectory& t : still.trajectory) t.kind = JointTrajectory::Kind::hold;
  const Observed o(still);
  for (int k = 0; k < 2; ++k) {
    const ResidualSignals s = o.signals(k);
    const std::size_t i = s.time.size() / 2;
    Eigen::Vector2d q;
    for (int j = 0; j < 2; ++j) q(j) = o.signals(j).joint_position[i];
    const Eigen::VectorXd gravity = gravity_force(o.model.nominal, q);
    const Eigen::VectorXd cables = path_matrix(o.model.nominal).transpose().inverse() * gravity;
    // It stands but for a creep under its controller.
    EXPECT_NEAR(s.load[i], cables(k), 0.01 * cables.norm()) << "joint " << k + 1;
  }
}

TEST(ResidualSignals, AMeasuredLoadIsTakenOffTheCables) {
  Observed o(fine_motion());
  const ResidualSignals before = o.signals(1);
  for (Record& r : o.records) r.external[1].assign(r.size, 0.3);  // N m, helps
  const ResidualSignals after = o.signals(1);
  const double per_force = path_matrix(o.model.nominal).transpose().inverse()(1, 1);
  for (std::size_t i = 0; i < after.time.size(); ++i)
    EXPECT_NEAR(after.load[i] - before.load[i], -0.3 * per_force, 1e-9 * std::abs(before.load[i]) + 1e-12);
}

TEST(ResidualSignals, WhatOneRecordLacksIsUnknown) {
  Observed o(fine_motion());
  Observed without = o;
  for (Record& r : without.records) r.torque[1].clear();
  o.records.push_back(without.records[0]);
  o.predictions.push_back(without.predictions[0]);
  const ResidualSignals s = o.signals(1);
  EXPECT_TRUE(s.of(ResidualKind::motor_torque).empty());
  EXPECT_EQ(s.of(ResidualKind::joint_position).size(), s.time.size());
  EXPECT_EQ(s.time.size(), 2 * in_motion().signals(1).time.size());
  o.records[1].joint[0].clear();
  EXPECT_TRUE(o.signals(1).of(ResidualKind::joint_torque).empty()) << "the force on a joint needs all sensors";
}

TEST(ResidualSignals, ATorqueCountsOnlyWhereItIsValidAndItsMotorMoves) {
  Observed o = in_motion();
  Record& r = o.records[0];
  const auto torques = [&] { return o.signals(1).of(ResidualKind::motor_torque); };
  const std::vector<double> all = torques();
  const auto counted = std::find_if(all.begin() + 200, all.end(), [](double t) { return std::isfinite(t); });
  ASSERT_NE(counted, all.end());
  const auto i = static_cast<std::size_t>(counted - all.begin()), at = i * std::lround(0.01 / r.dt);
  r.torque_valid[1][at] = 0;
  EXPECT_TRUE(std::isnan(torques()[i])) << "not measured";
  r.torque_valid[1][at] = 1;
  r.motor_rate[1][at] = 0;
  EXPECT_TRUE(std::isnan(torques()[i])) << "friction has any value at rest";
}

}  // namespace
}  // namespace halyard
