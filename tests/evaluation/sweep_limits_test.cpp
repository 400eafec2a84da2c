/// Detection limits at a point of a sweep.

#include "evaluation/sweep/measures/sweep_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/plan.h"
#include "evaluation/studies/motion_proposal.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(SweepLimits, AreThoseOfAPlan) {
  const ArmModel model = first_joints(1);
  Scenario scenario = motion(model, 3);
  scenario.robot.nominal.joint[0].joint_viscous *= 2;  // the plan is of the model
  const auto limits = limits_of(parse_limited_effects("stiffness,backlash", model), scenario, model);
  ASSERT_EQ(limits.size(), 2u);
  const auto plan = detection_limits(model, {planned_log(planned_scenario(scenario, model), true)});
  int compared = 0;
  for (const DetectionLimit& limit : plan) {
    const std::string name = limit.effect.effect->name();
    if (name != "backlash" && name != "stiffness") continue;
    const std::vector<double>& found = limits[name == "backlash"].at(0);
    ++compared;
    EXPECT_EQ(parse_limited_effects(name, model)[0].parameter, limit.parameter);
    EXPECT_EQ(parse_limited_effects(name, model)[0].units[0], limit.unit);
    if (limit.excited) EXPECT_EQ(found[0], limit.limit);
    else EXPECT_TRUE(std::isnan(found[0]));
    EXPECT_EQ(std::isnan(found[1]), !limit.naming_limit);
  }
  EXPECT_EQ(compared, 2);
}

TEST(SweepLimits, AreOfEffectsThatAJointCanHave) {
  ArmModel model = first_joints(1);
  const auto message = [&](const char* text) { return message_of([&] { parse_limited_effects(text, model); }); };
  EXPECT_NE(message("backlsh").find("'backlsh' is no effect; expected one or more of payload, "), std::string::npos);
  EXPECT_EQ(message("backlash,backlash"), "'backlash' is listed twice; list it once");
  EXPECT_EQ(message("payload"), "'payload' cannot be at a joint of this arm; leave it out");
  model.effects.push_back(place_effect(*find_effect("backlash"), model.nominal, 0));
  EXPECT_EQ(message("backlash"), "'backlash' is in the model already; name an effect that it lacks");
}

}  // namespace
}  // namespace halyard
