#include "diagnosis/judgement/judge.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// The elbow is pushed for two seconds, if at all, and pressed against something soft all the time.
struct Tug {
  ArmModel model = first_joints(2);
  PlacedEffect push = place_neutral_effect(*find_effect("external_force"), model.nominal, 1);
  Evidence evidence;
  Judge judge;

  Tug(double force, double stiffness)
      : evidence(make_records(record(force, stiffness), model, {}), model), judge(evidence, model, {}, squares()) {
    // The something is where the motion ends: the end of what a search may ask for.
    push.p[4] = evidence.joint_span(1).first;
  }
  Log record(double force, double stiffness) {
    push.p[0] = force, push.p[1] = 2, push.p[2] = 4;                // N m, s
    push.p[3] = stiffness, push.p[4] = model.joints[1].home - 0.4;  // N m/rad, rad
    ArmModel robot = model;
    robot.effects = {push};
    return simulate(motion(robot, 6)).measured;
  }
  std::vector<double> squares() const { return evidence.score({model.nominal, {}}).mean_square; }
  /// The verdict on a push and a contact of these sizes.
  Trial trial(double force, double stiffness) const {
    Hypothesis with{model.nominal, {push}}, without{model.nominal, {}};
    with.effects[0].p[0] = force, with.effects[0].p[3] = stiffness;
    return judge.trial(with, {without, evidence.score(without)}, 0);
  }
};

TEST(Judge, AContactAtTheEndOfTheMotionDoesNotDiscardThePushBesideIt) {
  const Tug tug(1, 0.03), none(0, 0.2);
  const Trial both = tug.trial(1, 0.03), push = tug.trial(1, 0), contact = none.trial(0, 0.2);
  ASSERT_TRUE(both.is_judged() && push.is_judged() && contact.is_judged());
  EXPECT_GT(both.gain, push.gain + kRule.by_chance) << "the contact mends the form of the push";
  EXPECT_FALSE(both.at_bound);
  EXPECT_FALSE(push.at_bound);
  EXPECT_TRUE(contact.at_bound);
}

}  // namespace
}  // namespace halyard
