#include "diagnosis/record/common_clock.h"

#include <gtest/gtest.h>

#include "tests/support/short_arm.h"

namespace halyard {
namespace {

Log log_between(double first, double last) {
  Log log(1);
  log.time = {first, last};
  return log;
}

/// A second of samples that begin at `start` on the log's clock.
Record second_from(double start, double clock_shift) {
  Record r;
  r.n = 1, r.dt = 0.01, r.size = 101;
  r.start = start, r.clock_shift = clock_shift;
  return r;
}

PlacedEffect push_between(double start, double stop) {
  PlacedEffect e = place_neutral_effect(*find_effect("external_force"), first_joints(1).nominal, 0);
  e.p[0] = 3, e.p[1] = start, e.p[2] = stop, e.p[3] = 0.5;
  return e;
}

TEST(CommonClock, MovesALaterLogASecondBehindTheOthersIfItWouldOverlapThem) {
  EXPECT_EQ(clock_shifts({log_between(0.5, 2), log_between(0, 3), log_between(5, 7), log_between(20, 21)}),
            (std::vector<double>{0, 3, 2, 0}));
  EXPECT_EQ(clock_shifts({log_between(-4, -1)}), std::vector<double>{0}) << "the first keeps its clock";
}

TEST(CommonClock, MovesTheInstantsOfEffectsAndNothingElse) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const Hypothesis h = on_own_clock(second_from(0, 4), {arm, {push_between(4.25, 4.75)}});
  const double* p = h.effects[0].p;
  EXPECT_EQ(p[0], 3);
  EXPECT_EQ(p[1], 0.25);
  EXPECT_EQ(p[2], 0.75);
  EXPECT_EQ(p[3], 0.5);
}

TEST(CommonClock, TheRecordOfAnEffectIsTheOneThatItOverlapsMostOrTheNearest) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const std::vector<Record> records = {second_from(0, 0), second_from(0, 2), second_from(1.5, 2)};  // 0, 2 and 3.5 s
  const auto place = [&](double start, double stop) {
    return record_of(push_between(start, stop), arm, records) - records.data();
  };
  EXPECT_EQ(place(0.2, 0.4), 0);
  EXPECT_EQ(place(0.8, 2.5), 1);
  EXPECT_EQ(place(2.9, 4), 2);
  EXPECT_EQ(place(1.6, 1.7), 1) << "between two";
  EXPECT_EQ(place(9, 9.5), 2);
  EXPECT_EQ(record_of(place_effect(*find_effect("backlash"), arm, 0), arm, records), nullptr);
  PlacedEffect contact = place_neutral_effect(*find_effect("external_force"), arm, 0);
  contact.p[4] = 100;  // contact_stiffness
  EXPECT_EQ(record_of(contact, arm, records), nullptr) << "it is a part of the arm";
}

TEST(CommonClock, AnEffectIsToldOnTheClockOfItsLog) {
  const ArmParameters<double> arm = first_joints(1).nominal;
  const std::vector<Record> records = {second_from(0, 0), second_from(0, 2)};
  EXPECT_EQ(on_clock_of_its_log(push_between(2.25, 2.5), arm, records).p[1], 0.25);
  EXPECT_EQ(on_clock_of_its_log(push_between(0.25, 0.5), arm, records).p[1], 0.25);
  const PlacedEffect gap = place_effect(*find_effect("backlash"), arm, 0);
  EXPECT_EQ(on_clock_of_its_log(gap, arm, records).p[0], gap.p[0]);
}

}  // namespace
}  // namespace halyard
