/// What a filter on the arm takes for the speed when it starts anew after a gap.

#include <gtest/gtest.h>

#include "estimators/built_in.h"
#include "estimators/filters/arm_filter.h"
#include "estimators/filters/sr_ukf.h"
#include "tests/estimators/process/held_force.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

class Restart : public testing::Test {
 protected:
  explicit Restart(const ArmModel& model = raven2())
      : model_(model),
        process_(std::make_shared<const ProcessModel>(model_)),
        filter_(model_, process_, {.noise = levels_of(model_, *process_)}, std::make_unique<SquareRootUkf>()) {
    // A record at home, and after a gap the first reading.
    filter_.reset(sample_at(0, model_.home()));
    filter_.update(sample_at(1e-3, model_.home()));
    read(kAgain, model_.home());
  }
  Sample sample_at(double time_s, const Eigen::VectorXd& q) const {
    return {time_s, Eigen::VectorXd::Zero(3), unstretched_motors(process_->arm(), q), {}};
  }
  void read(double time_s, const Eigen::VectorXd& q) { filter_.update(sample_at(time_s, q)); }
  /// Reads the joints at home + v dt, dt after the gap.
  void read_moved(const Eigen::Vector3d& v, double dt_s) { read(kAgain + dt_s, model_.home() + dt_s * v); }
  Eigen::Vector3d velocity() const { return filter_.estimate().joint_velocity; }

  static constexpr double kAgain = 3;  // s
  ArmModel model_;
  std::shared_ptr<const ProcessModel> process_;
  ArmFilter filter_;
};

TEST_F(Restart, TwoReadingsGiveTheSpeedOfMotorsAndJoints) {
  EXPECT_EQ(velocity(), Eigen::Vector3d::Zero());
  const Eigen::Vector3d v(0.5, -0.2, 0.04);
  read_moved(v, 2e-3);
  // Differences of motor angles of some 100 rad over 2 ms.
  EXPECT_LT((velocity() - v).norm(), 1e-10);
  const Eigen::VectorXd rates = unstretched_motors(process_->arm(), v);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(filter_.filter().x()(*process_->layout().motor_rate[k]), rates(k), 1e-9) << k;
}

TEST_F(Restart, ReadingsFartherApartThanAStepGiveASpeedThatMayHaveChangedSince) {
  const Eigen::Vector3d v(0.5, -0.2, 0.04);
  double start = kAgain;
  for (const double apart : {9e-3, 11e-3}) {
    read(start += 10, model_.home());
    read(start + apart, model_.home() + apart * v);
    EXPECT_LT((velocity() - v).norm(), 1e-10);
    for (int k = 0; k < 3; ++k) {
      const double deviation = filter_.filter().S().row(process_->layout().rate[k]).norm();
      const double range = model_.joints[k].upper - model_.joints[k].lower;
      if (apart > 10e-3) EXPECT_GE(deviation, range) << k;
      else EXPECT_LT(deviation, 0.02 * range) << k;
    }
  }
}

TEST_F(Restart, ASpeedThatCrossesTheRangeInLessThan50MsIsNotBelieved) {
  constexpr double kStep = 2e-3;
  double start = kAgain;
  for (int k = 0; k < 3; ++k)
    for (const double share : {0.9, -0.9, 1.1, -1.1}) {
      start += 10;
      read(start, model_.home());
      Eigen::Vector3d v = Eigen::Vector3d::Zero();
      v(k) = share * (model_.joints[k].upper - model_.joints[k].lower) / 0.05;
      const Eigen::VectorXd far = model_.home() + kStep * v;
      read(start + kStep, far);
      const bool believed = std::abs(share) < 1;
      EXPECT_LT((velocity() - (believed ? v : Eigen::Vector3d::Zero().eval())).norm(), 1e-8) << k << ", " << share;
      if (believed) continue;
      const Eigen::Vector3d slow(0.1, 0.2, -0.03);  // one of the two readings was wrong: a third one tells the speed
      read(start + 2 * kStep, far + kStep * slow);
      EXPECT_LT((velocity() - slow).norm(), 1e-8) << k << ", " << share;
    }
}

TEST_F(Restart, UntilItsSpeedIsKnownAJointMayCrossItsRangeInASecondAndTakeItsMotorsAlong) {
  const StateLayout& l = process_->layout();
  const Eigen::MatrixXd S = filter_.filter().S();
  for (int k = 0; k < 3; ++k) {
    const double range = model_.joints[k].upper - model_.joints[k].lower;
    EXPECT_DOUBLE_EQ(S(l.rate[k], *l.motor_rate[k]), range) << k;
    for (int i = 0; i < 3; ++i) {
      const JointParameters<double>& j = process_->arm().joint[i];
      EXPECT_DOUBLE_EQ(S(*l.motor_rate[i], *l.motor_rate[k]), range * path_per_joint(j, k) / j.motor_travel())
          << i << ", " << k;
    }
  }
}

TEST_F(Restart, MotorsThatWereReadEarlierMayHaveMovedSinceWithTheirJoints) {
  const StateLayout& l = process_->layout();
  for (int k = 0; k < 3; ++k) {  // after another gap, one after the other
    Sample s = sample_at(kAgain + 10 + 1e-3 * k, model_.home());
    for (int i = 0; i < 3; ++i)
      if (i != k) s.motor_position(i) = kNan;
    EXPECT_EQ(filter_.update(s).nu.size(), 0) << k;
  }
  const Eigen::MatrixXd S = filter_.filter().S();
  for (int k = 0; k < 3; ++k) {
    const double range = model_.joints[k].upper - model_.joints[k].lower;
    const int source = *l.motor_angle[k];
    const double moved = S(l.position[k], source);
    EXPECT_NEAR(moved, 2e-3 * range, 1e-9 * range) << k;  // the oldest is 2 ms old
    EXPECT_DOUBLE_EQ(S(l.rate[k], *l.motor_rate[k]), range) << k;
    for (int i = 0; i < 3; ++i) {
      const JointParameters<double>& j = process_->arm().joint[i];
      EXPECT_DOUBLE_EQ(S(*l.motor_angle[i], source), moved * path_per_joint(j, k) / j.motor_travel()) << i << ", " << k;
    }
  }
}

ArmModel without_motor(int joint) {
  ArmModel model = raven2();
  model.nominal.joint[joint].drive = Drive::none;
  return model;
}

class RestartOfAnUndrivenJoint : public Restart, public testing::WithParamInterface<int> {
 protected:
  RestartOfAnUndrivenJoint() : Restart(without_motor(GetParam())) {}
};

INSTANTIATE_TEST_SUITE_P(All, RestartOfAnUndrivenJoint, testing::Range(0, 3));

TEST_P(RestartOfAnUndrivenJoint, TwoReadingsGiveTheSpeedOfTheOthers) {
  Eigen::Vector3d v(0.5, -0.2, 0.04);
  v(GetParam()) = 0;
  read_moved(v, 2e-3);
  EXPECT_LT((velocity() - v).norm(), 1e-10);  // as above
}

TEST_P(RestartOfAnUndrivenJoint, ItIsWhereItWasButMayMove) {
  const int k = GetParam();
  const double range = model_.joints[k].upper - model_.joints[k].lower;
  const StateLayout& l = process_->layout();
  filter_.reset(sample_at(0, model_.home()));
  EXPECT_NEAR(filter_.estimate().joint_position(k), model_.home()(k), 4 * kEps);
  for (int i = 1; i <= 100; ++i) read(1e-3 * i, model_.home());
  const double there = filter_.estimate().joint_position(k);
  EXPECT_GT(std::abs(there - model_.home()(k)), 1e-6) << "it falls";
  for (const double after : {0.0, 2e-3}) {
    read_moved(Eigen::Vector3d::Zero(), after);
    EXPECT_NEAR(filter_.estimate().joint_position(k), there, 4 * kEps) << after;
    EXPECT_EQ(velocity()(k), 0) << after;
    const Eigen::MatrixXd S = filter_.filter().S();
    // As at the start of a record, and of a joint whose speed no reading tells.
    EXPECT_NEAR(S.row(l.position[k]).norm(), 0.1 * range, 1e-9 * range) << after;
    EXPECT_NEAR(S.row(l.rate[k]).norm(), range, 1e-9 * range) << after;
    // No motor moves with it: joints further out make up for it.
    const Eigen::VectorXd S_q = S.col(l.position[k]), S_v = S.col(l.rate[k]);
    Eigen::Vector3d moved, rate;
    for (int i = 0; i < 3; ++i) moved(i) = S_q(l.position[i]), rate(i) = S_v(l.rate[i]);
    for (int i = 0; i < 3; ++i) {
      if (i == k) continue;
      EXPECT_EQ(S_q(*l.motor_angle[i]), 0) << i;
      EXPECT_EQ(S_v(*l.motor_rate[i]), 0) << i;
    }
    // Angles of some 100 rad.
    EXPECT_LT(unstretched_motors(process_->arm(), moved).norm(), 1e-12);
    EXPECT_LT(unstretched_motors(process_->arm(), rate).norm(), 1e-12);
  }
}

class RestartWithoutRange : public Restart {
 protected:
  RestartWithoutRange() : Restart(without_range_of_joint_2()) {}

 private:
  static ArmModel without_range_of_joint_2() {
    ArmModel model = raven2();
    model.joints[1].upper = model.joints[1].lower;
    return model;
  }
};

TEST_F(RestartWithoutRange, AJointMayMoveByOneInASecondAndIsBelievedAnySpeed) {
  EXPECT_DOUBLE_EQ(filter_.filter().S()(process_->layout().rate[1], *process_->layout().motor_rate[1]), 1);
  const Eigen::Vector3d v(0.5, 40, 0.04);
  read_moved(v, 2e-3);
  EXPECT_LT((velocity() - v).norm(), 1e-9);  // differences of motor angles of some 100 rad over 2 ms
}

TEST(Start, MotorsAreWhereTheirEncodersReadLessTheirOffsets) {
  ArmModel model = raven2();
  const Eigen::Vector3d offset(0.3, -2, 5);
  const Eigen::VectorXd q_m = unstretched_motors(model.nominal, model.home());
  const auto started = [&](const Eigen::VectorXd& reading) {
    const auto filter = make_sr_ukf(model, {});
    filter->reset({0, Eigen::VectorXd::Zero(3), reading, {}});
    return filter->estimate().joint_position;
  };
  const Eigen::VectorXd without = started(q_m);
  for (int k = 0; k < 3; ++k) model.nominal.joint[k].motor_encoder_offset = offset(k);
  EXPECT_LT((started(q_m + offset) - without).norm(), 1e-12);
}

TEST(Start, AfterTheGateHasRefusedForLongItFiltersAgain) {
  for (const bool is_driven : {true, false}) {
    const ArmModel model = is_driven ? raven2() : without_motor(1);
    const auto filter = make_sr_ukf(model, {{"gate", "0.9999"}, {"restart_gap", "0.05"}});
    Sample s{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
    filter->reset(s);
    s.motor_position(0) += 1;
    long refused = 0;
    for (int i = 1; i <= 70; ++i) {
      s.time_s = 1e-3 * i;
      const Innovation innovation = filter->update(s);
      refused += !innovation.accepted;
      // It starts anew at the first sample that is more than 50 ms after the first refusal; the next one tells the
      // speed.
      EXPECT_EQ(innovation.nu.size(), i == 52 || i == 53 ? 0 : is_driven ? 3 : 2) << i;
    }
    EXPECT_EQ(refused, 51);
    EXPECT_TRUE(filter->estimate().joint_velocity.allFinite());
  }
}

TEST(Start, AJointWithoutAMotorIsAtHomeWhateverPullsIt) {
  for (int k = 0; k < 3; ++k) {
    const ArmModel model = without_motor(k);
    const auto filter = make_sr_ukf(model, {});
    filter->reset(
        {0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), Eigen::Vector3d(1, -1, 2)});
    EXPECT_NEAR(filter->estimate().joint_position(k), model.home()(k), 4 * kEps) << k;
    EXPECT_EQ(filter->estimate().joint_velocity, Eigen::Vector3d::Zero()) << k;
  }
}

TEST(DelayedCommands, ReachTheFilterFromThePast) {
  ArmModel model = raven2();
  add_effect(model, "delay", 0, {5e-3});
  const ArmRun run = run_arm(model, 0.2);
  const auto knowing = make_sr_ukf(model, {}), ignorant = make_sr_ukf(raven2(), {});
  const auto mean_nis_of = [&](Estimator& estimator) {
    estimator.reset(run.samples[0]);
    double sum = 0;
    for (std::size_t i = 1; i < run.samples.size(); ++i) sum += estimator.update(run.samples[i]).nis();
    return sum / 3 / static_cast<double>(run.samples.size() - 1);
  };
  EXPECT_LT(mean_nis_of(*knowing), 1.5);  // 0.9 was observed
  EXPECT_GT(mean_nis_of(*ignorant), 3);   // 5.1
}

TEST(Start, AGapOfASecondIsLongUnlessToldOtherwise) {
  ArmModel model = raven2();
  model.nominal.gravity[0] = 0;  // it stays where it is
  for (const double gap : {0.9, 1.1}) {
    const auto filter = make_ekf(model, {});
    Sample s{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
    filter->reset(s);
    s.time_s = gap;
    EXPECT_EQ(filter->update(s).nu.size(), gap > 1 ? 0 : 3) << gap;
  }
}

TEST(Start, AfterAGapMotorsThatAreReadByTurnsGiveTheSpeed) {
  const ArmModel model = raven2();
  const auto filter = make_sr_ukf(model, {});
  const Eigen::Vector3d v(0.5, -0.2, 0.04);
  const auto sample_at = [&](double since_s) {
    const Eigen::VectorXd q = model.home() + since_s * v;
    return Sample{3 + since_s, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, q), {}};
  };
  Sample first = sample_at(0);
  first.time_s = 0;
  filter->reset(first);
  for (int i = 0; i < 6; ++i) {
    Sample one = sample_at(1e-3 * i);
    for (int k = 0; k < 3; ++k)
      if (k != i % 3) one.motor_position(k) = kNan;
    EXPECT_EQ(filter->update(one).nu.size(), 0) << i;
  }
  // Differences of motor angles of some 100 rad over 3 ms.
  EXPECT_LT((filter->estimate().joint_velocity - v).norm(), 1e-10);
}

TEST(Start, UntilAllMotorsHaveBeenReadJointsAreAsUncertainAsTheirRanges) {
  const ArmModel model = raven2();
  const auto filter = make_sr_ukf(model, {});
  Sample blind{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
  blind.motor_position(2) = kNan;
  filter->reset(blind);
  for (int k = 0; k < 3; ++k)
    EXPECT_GE(filter->estimate().joint_position_std(k), model.joints[k].upper - model.joints[k].lower) << k;
}

TEST(Start, AfterTheGateHasRefusedForLongItStartsFromMotorsThatAreReadByTurns) {
  const ArmModel model = raven2();
  const auto filter = make_sr_ukf(model, {{"gate", "0.9999"}, {"restart_gap", "0.05"}});
  Sample s{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
  filter->reset(s);
  s.motor_position(0) += 1;
  for (int i = 1; i <= 51; ++i) {
    s.time_s = 1e-3 * i;
    filter->update(s);
  }
  for (int k = 0; k < 3; ++k) {
    Sample one = s;
    one.time_s = 1e-3 * (52 + k);
    for (int i = 0; i < 3; ++i)
      if (i != k) one.motor_position(i) = kNan;
    EXPECT_EQ(filter->update(one).nu.size(), 0) << k;
  }
  s.time_s = 0.055;
  EXPECT_EQ(filter->update(s).nu.size(), 0) << "the second reading gives the speed";
  s.time_s = 0.056;
  EXPECT_EQ(filter->update(s).nu.size(), 3);
}

TEST(Start, TimeWithoutReadingsIsLeftOutOfTheTimeForWhichTheGateRefuses) {
  ArmModel model = raven2();
  model.nominal.gravity[0] = 0;
  const auto filter = make_sr_ukf(model, {{"gate", "0.9999"}, {"restart_gap", "0.05"}});
  Sample s{0, Eigen::VectorXd::Zero(3), unstretched_motors(model.nominal, model.home()), {}};
  filter->reset(s);
  s.motor_position(0) += 3;
  Sample blind = s;
  blind.motor_position.setConstant(kNan);
  for (int i = 1; i <= 72; ++i) {
    const bool is_blind = i > 30 && i <= 50;
    Sample& now = is_blind ? blind : s;
    now.time_s = 1e-3 * i;
    const Eigen::Index readings = filter->update(now).nu.size();
    // Refused since 1 ms, less 20 ms without readings: more than 50 ms at 72 ms. 71 ms is a matter of rounding.
    if (i != 71) {
      EXPECT_EQ(readings, is_blind || i == 72 ? 0 : 3) << i;
    }
  }
}

class RestartOfAnUndrivenJointWithoutRange : public Restart {
 protected:
  RestartOfAnUndrivenJointWithoutRange() : Restart(undriven_without_range()) {}

 private:
  static ArmModel undriven_without_range() {
    ArmModel model = without_motor(1);
    model.joints[1].upper = model.joints[1].lower;
    return model;
  }
};

TEST_F(RestartOfAnUndrivenJointWithoutRange, ItMayMoveByOneInASecond) {
  const int rate = process_->layout().rate[1];
  EXPECT_NEAR(filter_.filter().S()(rate, rate), 1, 1e-9);
}

}  // namespace
}  // namespace halyard
