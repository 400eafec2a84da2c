#include <gtest/gtest.h>

#include "tests/diagnosis/odd_logs.h"

namespace halyard {
namespace {

TEST(ZeroError, OfAJointsSensorIsToldFromThatOfItsMotorByAnotherCable) {
  const ArmModel model = first_joints(2);
  for (const bool at_joint : {false, true}) {
    ArmModel truth = model;
    truth.effects.push_back(placed("encoder_offset", model, 0, {0.01, at_joint ? 1.0 : 0.0}));
    const Diagnosis d =
        diagnosis_of(model, {simulate(motion(truth, 8)).measured, simulate(motion(truth, 3, 1)).measured});
    ASSERT_EQ(d.effects.size(), 1u);
    EXPECT_EQ(effect_label(d.effects[0].effect), "encoder_offset of joint 1");
    EXPECT_NEAR(d.effects[0].effect.p[0], 0.01, 2e-4);
    EXPECT_EQ(d.effects[0].effect.p[1], at_joint ? 1 : 0);
    EXPECT_TRUE(d.unexplained.empty());
  }
}

}  // namespace
}  // namespace halyard
