#include "diagnosis/explanation/headline.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

using Kind = Unexplained::Kind;

TEST(UnknownHeadline, SaysOfWhichKindsTheUnexplainedIs) {
  EXPECT_EQ(unknown_headline({{0, "", Kind::rest}, {1, "", Kind::rest}}),
            "a residual that matters is left without an explanation");
  EXPECT_EQ(unknown_headline({{2, "", Kind::stuck_sensor}}), "a sensor stands still while its motor moves");
  EXPECT_EQ(unknown_headline({{0, "", Kind::rest}, {1, "", Kind::refused}}),
            "what explains the training data predicts the hold-out worse; a residual that matters is left without an "
            "explanation");
}

TEST(UnknownHeadline, HasAClauseForEachKind) {
  for (const Kind kind :
       {Kind::rest, Kind::unnamed_effect, Kind::refused, Kind::motion, Kind::stuck_sensor, Kind::line_above_band})
    EXPECT_FALSE(unknown_headline({{0, "", kind}}).empty());
}

TEST(RemainderHeadline, SaysTheGravestOfWhatRemains) {
  const Unexplained rest{0, "", Kind::rest}, unnamed{1, "", Kind::unnamed_effect}, stuck{2, "", Kind::stuck_sensor};
  EXPECT_EQ(remainder_headline({stuck, unnamed, rest}), "an unexplained residual remains");
  EXPECT_EQ(remainder_headline({stuck, unnamed}), "an effect without a sure name remains");
  EXPECT_EQ(remainder_headline({stuck}), "a sensor stands still");
  EXPECT_EQ(remainder_headline({}), "");
}

TEST(RemainderHeadline, OfWhatNoNameCanEndIsAnUnexplainedResidual) {
  for (const Kind kind : {Kind::rest, Kind::refused, Kind::motion})
    EXPECT_EQ(remainder_headline({{0, "", Kind::stuck_sensor}, {1, "", kind}}), "an unexplained residual remains");
  EXPECT_EQ(remainder_headline({{0, "", Kind::stuck_sensor}, {1, "", Kind::line_above_band}}),
            "a sine above the compared frequencies remains");
}

}  // namespace
}  // namespace halyard
