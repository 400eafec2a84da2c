#include "diagnosis/judgement/decision_rule.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace halyard {
namespace {

/// Other tests get the rule as it was.
class DecisionRuleTest : public testing::Test {
 protected:
  ~DecisionRuleTest() override {
    const DecisionRule usual;
    vary_rule("sure_name", usual.sure_name);
    vary_rule("leaders", static_cast<double>(usual.leaders));
    vary_rule("most_passes", usual.most_passes);
  }
};

TEST_F(DecisionRuleTest, CanBeVariedByTheNamesOfItsThresholds) {
  EXPECT_EQ(kRule.sure_name, DecisionRule().sure_name);
  vary_rule("sure_name", 0.5);
  vary_rule("leaders", 2);
  vary_rule("most_passes", 5);
  EXPECT_EQ(kRule.sure_name, 0.5);
  EXPECT_EQ(kRule.leaders, 2u);
  EXPECT_EQ(kRule.most_passes, 5);
  EXPECT_EQ(kRule.share, DecisionRule().share);
}

TEST_F(DecisionRuleTest, RefusesWhatIsNoThresholdOrNoValueOfIt) {
  EXPECT_THROW(vary_rule("sure_names", 0.5), std::invalid_argument);
  EXPECT_THROW(vary_rule("leaders", 2.5), std::invalid_argument);
  EXPECT_THROW(vary_rule("leaders", 0), std::invalid_argument);
  EXPECT_THROW(vary_rule("sure_name", 1e7), std::invalid_argument);
  EXPECT_THROW(vary_rule("sure_name", -0.1), std::invalid_argument);
  EXPECT_THROW(vary_rule("sure_name", std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_EQ(kRule.leaders, DecisionRule().leaders);
}

}  // namespace
}  // namespace halyard
