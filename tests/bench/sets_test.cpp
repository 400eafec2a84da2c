#include <gtest/gtest.h>

#include "bench/diagnosis/summary/calibration.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

using Sets = std::vector<bool>;

TEST(SetsOfTrials, HoldIfTheNameIsRightOrAnAlternativeInTheSetIs) {
  const Alternative inside{{"backlash", 1}, 0.3, true}, beyond{{"backlash", 1}, 0.01, false};
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("backlash", 1)})), Sets{true});
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("slack", 1, 0.6, {inside})})), Sets{true});
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("slack", 1, 0.98, {beyond})})), Sets{false});
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("backlash", 2)})), Sets{false});
}

TEST(SetsOfTrials, OfASecondNameForOneEffectDoesNotHold) {
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("backlash", 1), named("backlash", 1)})),
            (Sets{true, false}));
  // Not even where the second name has the effect among its alternatives.
  const Alternative again{{"backlash", 1}, 0.4, true};
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("backlash", 1), named("slack", 1, 0.6, {again})})),
            (Sets{true, false}));
  EXPECT_EQ(sets_with_truth(trial(Kind::effect, {kBacklash}, {named("slack", 1, 0.6, {again}), named("backlash", 1)})),
            (Sets{false, true}));
}

TEST(SetsOfTrials, ShareAnEffectWithoutANameOnlyOnce) {
  const Alternative creep{{"creep", 1}, 0.4, true};
  const Result r = trial(Kind::two_at_joint, {kBacklash, kCreep},
                         {named("slack", 1, 0.6, {creep}), named("hysteresis", 1, 0.6, {creep})});
  EXPECT_EQ(sets_with_truth(r), (Sets{true, false}));
}

TEST(SetsOfTrials, HoldForANameThatIsAlsoTrueButNotForSuchAnAlternative) {
  const Alternative delay{{"delay", 0}, 0.4, true};
  Result r = trial(Kind::clean, {}, {named("delay", 0), named("stiffness", 1, 0.6, {delay})});
  r.also_true = {{"delay", 0}};
  EXPECT_EQ(sets_with_truth(r), (Sets{true, false}));
}

TEST(SetsOfTrials, OfACauseOutsideTheLibraryHoldNothing) {
  const Alternative itself{{"quadratic_drag", 1}, 0.4, true};
  const Result r =
      trial(Kind::outside, {true_effect("quadratic_drag", 1)}, {named("joint_friction", 1, 0.6, {itself})});
  EXPECT_EQ(sets_with_truth(r), Sets{false});
  EXPECT_EQ(set_coverage({&r}).hits, 0);
  EXPECT_EQ(set_coverage({&r}).of, 1);
}

}  // namespace
}  // namespace halyard::blind
