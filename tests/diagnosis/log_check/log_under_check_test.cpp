/// Corrections of a log under check: the options that are told read the corrected values from the file.

#include "diagnosis/log_check/log_under_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/diagnosis/log_check/checked_logs.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// A log of two joints that was read from a file with a scale and an offset for each motor.
struct Mapped {
  ColumnMap columns;
  LogCheckRule rule;
  Log log;

  Mapped() : log(3) {
    columns.add("motor_position_1", "one", "", 1, 2, 0.5);
    columns.add("motor_position_2", "two", "", -1, 4, -3, 100);
    log.source = "file.csv";
    log.time = {0, 0.1, 0.2};
    for (auto* signals : {&log.motor_torque, &log.motor_position, &log.joint_position})
      for (auto& column : *signals) column = {0.25, 0.5, 2};
  }
  LogUnderCheck check() const { return {log, raven(), columns, rule}; }
};

constexpr auto kMotors = &Log::motor_position;

TEST(LogUnderCheck, TellsTheMapOfAColumnAndACorrectionOnTopOfIt) {
  LogUnderCheck c = Mapped().check();
  EXPECT_EQ(c.option("motor_position_1", Correction{}), "--column motor_position_1=one,scale=2,offset=0.5");
  EXPECT_EQ(c.option("motor_position_1", Correction{.factor = -3, .offset = 1}),
            "--column motor_position_1=one,scale=6,sign=-1,offset=-0.5");
  EXPECT_EQ(c.option("motor_position_2", Correction{.factor = -1}),
            "--column motor_position_2=two,scale=4,offset=3,wrap=100");
  EXPECT_EQ(c.option("motor_position_3", Correction{.factor = 1e-3}),
            "--column motor_position_3=motor_position_3,unit=mm");
  EXPECT_EQ(c.option("time", Correction{.factor = 1e-3}), "--column time=time,unit=ms");
  EXPECT_EQ(c.option("motor_torque_1", Correction{.factor = 1e-3}), "--column motor_torque_1=motor_torque_1,unit=mN.m");
  EXPECT_EQ(c.option("joint_position_1", Correction{.factor = std::numbers::pi / 180}),
            "--column joint_position_1=joint_position_1,unit=deg");
  EXPECT_EQ(c.scale_of("motor_position_2"), 4);
  EXPECT_EQ(c.scale_of("motor_position_3"), 1);
  EXPECT_EQ(c.wrap_of("motor_position_2"), 400);
  EXPECT_EQ(c.wrap_of("motor_position_1"), 0);
  EXPECT_EQ(c.wrap_option("motor_position_1", 7), "--column motor_position_1=one,scale=2,offset=0.5,wrap=3.5");
}

TEST(LogUnderCheck, CorrectionsFollowEachOther) {
  LogUnderCheck c = Mapped().check();
  c.correct(kMotors, 0, {.factor = 3, .offset = 1});
  c.correct(kMotors, 0, {.factor = -2, .offset = 4});
  // x becomes -2 (3 x + 1) + 4, and the file's value, (x - 0.5) / 2, the same by the map that is told.
  EXPECT_EQ(c.log.motor_position[0], (std::vector<double>{0.5, -1, -10}));
  EXPECT_EQ(c.option("motor_position_1", Correction{}), "--column motor_position_1=one,scale=12,sign=-1,offset=-1");
  EXPECT_EQ(c.log.motor_position[1], (std::vector<double>{0.25, 0.5, 2})) << "the others stay";
}

TEST(LogUnderCheck, AnotherUnitOfTheFileLeavesTheOffsetOfItsMap) {
  LogUnderCheck c = Mapped().check();
  EXPECT_EQ(c.option("motor_position_1", Correction{.unit_factor = 3}),
            "--column motor_position_1=one,scale=6,offset=0.5");
  c.correct(kMotors, 0, {.unit_factor = 3});
  // x - 0.5 is what the map's scale gives.
  EXPECT_EQ(c.log.motor_position[0], (std::vector<double>{-0.25, 0.5, 5}));
  EXPECT_EQ(c.option("motor_position_1", Correction{}), "--column motor_position_1=one,scale=6,offset=0.5");
}

TEST(LogUnderCheck, AnExchangeSwapsWhatTheFileHasAndKeepsScalesAndOffsets) {
  LogUnderCheck c = Mapped().check();
  const ColumnCircle pair = {{kMotors, 0}, {kMotors, 1}};
  const std::string told = c.exchange_options(pair);
  EXPECT_EQ(told,
            "--column motor_position_1=two,scale=2,offset=0.5,wrap=100 "
            "--column motor_position_2=one,scale=4,sign=-1,offset=-3");
  c.exchange(pair);
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = Mapped().log.motor_position[0][i];
    const double one = (x - 0.5) / 2, two = (x + 3) / -4;  // in the file
    EXPECT_DOUBLE_EQ(c.log.motor_position[0][i], 2 * two + 0.5);
    EXPECT_DOUBLE_EQ(c.log.motor_position[1][i], -4 * one - 3);
  }
  EXPECT_EQ(c.option("motor_position_1", Correction{}) + " " + c.option("motor_position_2", Correction{}), told);
  c.exchange(pair);
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) EXPECT_DOUBLE_EQ(c.log.motor_position[k][i], Mapped().log.motor_position[k][i]);
}

TEST(LogUnderCheck, KnowsItsFindings) {
  LogUnderCheck c = Mapped().check();
  EXPECT_FALSE(c.has_gross());
  c.suspect("time", "what", "remedy");
  EXPECT_FALSE(c.has_gross());
  EXPECT_TRUE(c.has_finding("time"));
  EXPECT_FALSE(c.has_finding("motor_torque_1"));
  c.reject("motor_torque_1", "what", "remedy");
  EXPECT_TRUE(c.has_gross());
  EXPECT_EQ(finding_line(c.findings[1]), "file.csv: motor_torque_1: what; remedy");
}

TEST(LogUnderCheck, APositionIsBeyondItsRangeByItsWidthAndByItsMedian) {
  const LogUnderCheck c = Mapped().check();
  const double lower = raven().joints[0].lower, upper = raven().joints[0].upper, range = upper - lower;
  ASSERT_DOUBLE_EQ(c.range(0), range);
  // 1001 even places over so many ranges about a centre: their central 98 %.
  const auto even = [&](double centre, double ranges) {
    std::vector<double> x;
    for (int i = -500; i <= 500; ++i) x.push_back(centre + ranges * range * i / 1000);
    return x;
  };
  const double middle = (lower + upper) / 2;
  EXPECT_EQ(c.beyond_range(0, even(middle, 1), true), 0);
  EXPECT_EQ(c.beyond_range(0, even(middle, 1.2), true), 0) << "they overshoot a little";
  EXPECT_NEAR(c.beyond_range(0, even(middle, 3), true), 0.98 * 3 - 1.2, 1e-9);
  EXPECT_NEAR(c.beyond_range(0, even(upper + 0.5 * range, 0.1), true), 0.5, 1e-9);
  EXPECT_NEAR(c.beyond_range(0, even(lower - 0.25 * range, 0.1), true), 0.25, 1e-9);
  EXPECT_EQ(c.beyond_range(0, even(lower - 0.25 * range, 0.1), false), 0) << "its zero is unknown";
  EXPECT_NEAR(c.beyond_range(0, even(upper + range, 3), true), 0.98 * 3 - 1.2 + 1, 1e-9);
}

TEST(LogUnderCheck, UnitsOfPositionsAreAnglesOrLengthsAndCounts) {
  const auto factors = [](const std::vector<UnitGuess>& units) {
    std::map<std::string, double> all;
    for (const UnitGuess& u : units) all[u.what] = u.factor;
    return all;
  };
  EXPECT_EQ(factors(position_units(true, 0)),
            (std::map<std::string, double>{{"millimetres", 1e-3}, {"micrometres", 1e-6}, {"centimetres", 1e-2}}));
  const auto angles = factors(position_units(false, 0.25));
  EXPECT_DOUBLE_EQ(180 * angles.at("degrees"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(0.5 * angles.at("turns"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(angles.at("milliradians"), 1e-3);
  EXPECT_EQ(angles.at("counts of its encoder"), 0.25);
}

TEST(SampledMotion, IsWhatTheMotorsGiveWithoutStretchOnAGridOfSomeThousandPoints) {
  ArmModel model = raven();
  model.nominal.joint[1].motor_encoder_offset = 0.3;
  model.nominal.joint[2].joint_encoder_offset = 0.01;
  const SampledMotion m = sampled_motion(right_log(), model);
  ASSERT_EQ(right_log().size(), 6001u);
  EXPECT_NEAR(static_cast<double>(m.time.size()), 4000, 2);
  EXPECT_NEAR(m.step, 1.5e-3, 1e-6);
  EXPECT_DOUBLE_EQ(m.time[1] - m.time[0], m.step);
  for (std::size_t i = 0; i < m.time.size(); i += 400) {
    // The log has a sample each millisecond: every second point of the grid is one.
    const auto row = static_cast<std::size_t>(std::lround(m.time[i] * 1e3));
    if (std::abs(right_log().time[row] - m.time[i]) > 1e-9) continue;
    Eigen::Vector3d angle;
    for (int k = 0; k < 3; ++k) angle(k) = right_log().motor_position[k][row] - (k == 1 ? 0.3 : 0);
    Eigen::VectorXd q = unstretched_joints(model.nominal, angle, model.home());
    q(2) += 0.01;
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = model.nominal.joint[k];
      EXPECT_NEAR(m.expected[k][i], q(k), 1e-9) << k;
      EXPECT_NEAR(m.own[k][i], j.motor_travel() / j.pulley_radius * angle(k), 1e-9) << k;
      EXPECT_NEAR(m.joint[k][i], right_log().joint_position[k][row], 1e-9) << k;
    }
  }
}

TEST(SampledMotion, BridgesNoHoleLongerThanATenthOfASecond) {
  Log log = right_log();
  for (std::size_t i = 1000; i < 1080; ++i) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 3000; i < 3121; ++i) log.joint_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  const SampledMotion m = sampled_motion(log, raven());
  for (std::size_t i = 0; i < m.time.size(); ++i)
    EXPECT_EQ(std::isnan(m.joint[0][i]), m.time[i] > 2.9995 && m.time[i] < 3.1205) << m.time[i];
  log.joint_position[0].clear();
  log.motor_position[1].clear();
  const SampledMotion without = sampled_motion(log, raven());
  EXPECT_TRUE(without.joint[0].empty());
  EXPECT_TRUE(without.expected[1].empty());
  EXPECT_FALSE(without.expected[0].empty());
}

}  // namespace
}  // namespace halyard
