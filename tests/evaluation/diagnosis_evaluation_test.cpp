#include "evaluation/studies/diagnosis_evaluation.h"

#include <gtest/gtest.h>

#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(AlternativesSentence, NamesThoseAloneThatAreInTheSet) {
  const ArmParameters<double> arm = first_joints(2).nominal;
  const auto effect = [&](const char* name) { return place_effect(*find_effect(name), arm, 1); };
  NamedEffect named;
  named.effect = effect("hysteresis");
  named.alternatives = {{effect("creep"), 0.3, true}, {effect("stiffness"), 0.2, true}, {effect("slack"), 0, false}};
  EXPECT_EQ(alternatives_sentence(named), " These data cannot tell it from creep of joint 2, stiffness of joint 2.");
  named.alternatives = {{effect("slack"), 0, false}};
  EXPECT_EQ(alternatives_sentence(named), "") << "as good as excluded";
}

}  // namespace
}  // namespace halyard
