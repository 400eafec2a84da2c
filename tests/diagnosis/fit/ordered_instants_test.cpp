#include "diagnosis/fit/ordered_instants.h"

#include <gtest/gtest.h>

#include "diagnosis/fit/fit.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// A push and a contact at joint 2.
struct Push {
  Evidence evidence = small_evidence();
  Hypothesis hypothesis{first_joints(2).nominal, {}};

  Push(double force, double start, double stop, double rise) {
    PlacedEffect e = place_neutral_effect(*find_effect("external_force"), hypothesis.nominal, 1);
    e.p[0] = force, e.p[1] = start, e.p[2] = stop, e.p[3] = rise, e.p[4] = 3, e.p[5] = 0.1;
    hypothesis.effects.push_back(e);
  }
  std::vector<double> ordered() const {
    const Hypothesis h =
        with_ordered_instants(hypothesis, effect_parameters(evidence, hypothesis, first_joints(2).nominal, 0));
    return {h.effects[0].p, h.effects[0].p + 6};
  }
};

TEST(OrderedInstants, ExchangesStartAndStopAndTheSignOfTheForce) {
  EXPECT_EQ(Push(-26, 3.2, 1.1, 0.3).ordered(), (std::vector<double>{26, 1.1, 3.2, 0.3, 3, 0.1}));
}

TEST(OrderedInstants, LeavesAPushThatStopsAfterItsStart) {
  EXPECT_EQ(Push(-26, 1.1, 3.2, 0.3).ordered(), (std::vector<double>{-26, 1.1, 3.2, 0.3, 3, 0.1}));
}

TEST(OrderedInstants, PredictsTheSame) {
  const Push forward(2, 1.1, 3.2, 0.3), backward(-2, 3.2, 1.1, 0.3);
  EXPECT_EQ(forward.evidence.fit_rows({forward.hypothesis}), forward.evidence.fit_rows({backward.hypothesis}));
}

}  // namespace
}  // namespace halyard
