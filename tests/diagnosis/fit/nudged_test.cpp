#include "diagnosis/fit/nudged.h"

#include <gtest/gtest.h>

#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// All rows equal to x.
std::vector<double> even_rows(const Evidence& evidence, double x) {
  return std::vector<double>(evidence.row_channel().size(), x);
}

TEST(BeyondNumbers, LeavesWhatThePenalisedFitLeaves) {
  const Evidence evidence = small_evidence();
  const std::vector<double> scale(evidence.channels(), 1.0);
  std::vector<double> column = even_rows(evidence, 0), rest = column;
  column[0] = 3, rest[1] = 5;
  const BeyondNumbers beyond(evidence, {column}, scale);
  const double m = evidence.correlated_rows();
  // Of r = c J a fit with a prior of one unit leaves c² J² / (1 + J²), prior included.
  EXPECT_NEAR(beyond.left(column), (9 / m) / (1 + 9 / m), 1e-12);
  EXPECT_NEAR(beyond.left(rest), 25 / m, 1e-12) << "no number resembles it";
  EXPECT_EQ(beyond.left({}), std::numeric_limits<double>::infinity());
}

/// The log's joint has more friction than the model's, beside friction of the pulleys. At the model's friction a larger
/// friction of the pulleys fits better than the true one.
TEST(Nudged, LeavesASizeThatIsRightWithAnotherNumberOfTheModel) {
  constexpr double kSize = 0.02, kMoreFriction = 1.1;  // half of the tolerance
  const ArmModel model = first_joints(2);
  ArmModel robot = model;
  robot.nominal.joint[1].joint_coulomb *= kMoreFriction;
  PlacedEffect pulleys = place_effect(*find_effect("pulley_friction"), model.nominal, 1);
  pulleys.p[0] = kSize;
  robot.effects = {pulleys};
  const Evidence evidence(make_records(simulate(motion(robot, 6)).measured, model, {}), model);
  const Hypothesis start{model.nominal, {pulleys}};
  const std::vector<FitParameter> numbers = baseline_parameters(model);
  const auto columns = sensitivities(evidence, start, numbers);
  ASSERT_EQ(columns.size(), numbers.size());
  const auto size = [&](const std::vector<std::vector<double>>& of_numbers) {
    return nudged(evidence, start, 0, model.nominal, BeyondNumbers(evidence, of_numbers, evidence.floor()))
        .at.effects[0]
        .p[0];
  };
  EXPECT_NEAR(size(columns), kSize, 0.11 * kSize);
  EXPECT_GT(size({}), 1.25 * kSize) << "the log does not show the difference";
}

}  // namespace
}  // namespace halyard
