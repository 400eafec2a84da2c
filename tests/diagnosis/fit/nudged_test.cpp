#include "diagnosis/fit/nudged.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/search_space.h"
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
  const double m = evidence.correlated_rows(evidence.row_channel()[0]);
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

/// A sine of the joint's sensor with an origin that is given.
class SineFromAnOrigin : public EffectOf<SineFromAnOrigin>, public RefinesSearch {
 public:
  std::string name() const override { return "sine_from_an_origin"; }
  std::string summary() const override { return "an error of the joint's sensor"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"size", "rad", 0, 0.01, -1, 1}, {"origin", "s", 0, 0, -100, 100}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["origin"].range = SearchRange::record_time;
    space["origin"].is_whole = true;
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_error += c.p[0] * cos(T(std::numbers::pi) * (T(c.time) - c.p[1]));
  }
};

TEST(Nudged, LeavesAnInstantThatIsGiven) {
  const ArmModel model = first_joints(1);
  Log log = simulate(motion(model, 3)).measured;
  for (std::size_t i = 0; i < log.size(); ++i)
    log.joint_position[0][i] += 0.01 * std::cos(std::numbers::pi * (log.time[i] - 0.3));
  const Evidence evidence(make_records(log, model, {}), model);
  const SineFromAnOrigin effect;
  PlacedEffect from_zero = place_effect(effect, model.nominal, 0);
  from_zero.p[0] = 0.01, from_zero.p[1] = 0;
  const Nudge nudge =
      nudged(evidence, {model.nominal, {from_zero}}, 0, model.nominal, BeyondNumbers(evidence, {}, evidence.floor()));
  EXPECT_EQ(nudge.at.effects[0].p[1], 0) << "another origin would fit better";
}

}  // namespace
}  // namespace halyard
