#include "diagnosis/prediction/room.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// One joint with so many effects of one state each.
ArmModel arm_with_states(int n) {
  ArmModel model = first_joints(1);
  model.source = "arm.xml";
  model.effects.assign(n, place_effect(*find_effect("motor_presliding"), model.nominal, 0));
  return model;
}

TEST(Room, IsForTheStatesBesideThoseOfTheJoints) {
  EXPECT_TRUE(has_room(arm_with_states(62).effects, 1));
  EXPECT_FALSE(has_room(arm_with_states(63).effects, 1));
}

TEST(Room, WhereThereIsNoneNothingIsPredictedAndTheNeighboursAre) {
  const ArmModel full = arm_with_states(70);
  const Record record = make_records(simulate(motion(first_joints(1), 2)).measured, full, {})[0];
  const auto residuals = predict(record, {{full.nominal, full.effects}, {full.nominal, {}}}, 4);
  EXPECT_FALSE(residuals[0].finite);
  EXPECT_TRUE(residuals[1].finite);
}

TEST(Room, ARefusalSaysWhetherStatesOrStiffnessAreTooMuch) {
  EXPECT_EQ(message_of([] { refuse_to_predict(arm_with_states(70), "motion"); }),
            "arm.xml: its effects have 70 internal states; expected at most 62: place fewer of them");
  const std::string too_stiff = message_of([] { refuse_to_predict(arm_with_states(1), "motion"); });
  EXPECT_TRUE(too_stiff.starts_with("arm.xml: cannot be integrated along the motion: joint_rate_1 settles at "))
      << too_stiff;
  EXPECT_TRUE(
      too_stiff.ends_with(" 1/s at standstill; expected frictions and cables that settle more slowly: take "
                          "larger smoothing speeds, or less damping"))
      << too_stiff;
}

}  // namespace
}  // namespace halyard
