#include "diagnosis/search/basis.h"

#include <gtest/gtest.h>

#include "diagnosis/diagnose.h"
#include "diagnosis/search/attribution.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Basis, WidensWhatIsKnown) {
  ArmModel model = first_joints(1);
  Tolerances& stated = model.joints[0].tolerances;
  stated.friction = 0.2;
  stated.torque_scale = 1;
  const Tolerances wide = with_tolerances_times(2, model).joints[0].tolerances;
  EXPECT_EQ(wide.friction, 0.4);
  EXPECT_EQ(wide.torque_scale, 1) << "nothing is known of it";
  model.joints[0].tolerances.torque_scale = 0.5;
  EXPECT_LT(with_tolerances_times(2, model).joints[0].tolerances.torque_scale, 1) << "something is known of it";
  model.joints[0].tolerances.torque_scale = 0.1;
  EXPECT_EQ(with_tolerances_times(2, model).joints[0].tolerances.torque_scale, 0.2);
}

/// Moves each number of the model by so many tolerances, up and down in turns.
void move_numbers(ArmModel& robot, double tolerances) {
  Hypothesis h{robot.nominal, {}};
  double sign = 1;
  for (const FitParameter& p : baseline_parameters(robot))
    set_parameter(h, p, p.nominal + (sign = -sign) * tolerances * (p.upper - p.nominal));
  robot.nominal = h.nominal;
}

/// One name for each number that is off would be a patchwork.
TEST(Basis, AModelThatIsOffByMoreThanItStatesGetsWiderTolerancesAndNoNames) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  move_numbers(robot, 1.8);
  DiagnosisOptions options;
  options.tell_not_excited = false;
  const Diagnosis d =
      diagnose(model, {simulate(motion(robot, 12)).measured}, simulate(motion(robot, 12, 1)).measured, options);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_FALSE(d.refitted.empty());
  EXPECT_EQ(d.tolerance_factor, 2);
  EXPECT_EQ(d.revised.joints[0].tolerances.friction, model.joints[0].tolerances.friction) << "the model's own stay";
}

TEST(Basis, OneNumberThatIsOffIsAnEffect) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.nominal.joint[0].motor_coulomb *= 1.8;
  const Evidence evidence(make_records(simulate(motion(robot, 12)).measured, model, {}), model);
  const Attribution a = attribute(evidence, model, {}, {});
  EXPECT_EQ(a.tolerance_factor, 1);
  ASSERT_EQ(a.final_fit.hypothesis.effects.size(), 1u);
  EXPECT_EQ(a.final_fit.hypothesis.effects[0].effect->name(), "motor_friction");
}

}  // namespace
}  // namespace halyard
