/// What a diagnosis could not have found: effects that no sensor shows, and waves of which the motion is too short.

#include "diagnosis/explanation/not_excited.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/fit/made_log.h"

namespace halyard {
namespace {

/// Why the data could not have shown this effect of the only joint; "" if they could. No torque is logged.
template <class Position>
std::string why_not(const char* name, const Position& position) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(log_along(4, 100, position), model, {}), model);
  for (const NotExcited& n : not_excited(evidence, {model.nominal, {}}, model.nominal))
    if (n.effect == name && n.joint == EffectPlace(0)) return n.why;
  return "";
}

TEST(NotExcited, IsWhatChangesNoSignalByMoreThanItsSensorResolves) {
  EXPECT_EQ(why_not("motor_friction", slow_swing),
            "at its typical size it changes no signal of these data by more than the sensors resolve");
  EXPECT_EQ(why_not("encoder_offset", slow_swing), "");
}

TEST(NotExcited, IsAWaveOfWhichTheMotionHasTooFewPeriods) {
  const auto little = [](double t) { return 0.8 - 0.03 * std::cos(1.7 * t); };
  EXPECT_EQ(why_not("encoder_eccentricity", little), "the motion has too few of its periods");
  EXPECT_EQ(why_not("encoder_eccentricity", slow_swing), "");
}

}  // namespace
}  // namespace halyard
