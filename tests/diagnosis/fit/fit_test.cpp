/// A fit says what it came to in its result, and writes nothing. Its rows count as much as they are worth.

#include "diagnosis/fit/fit.h"

#include <glog/logging.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "diagnosis/diagnose.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Fit, LeavesTheLogOfTheProgramAlone) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(simulate(motion(model, 2)).measured, model, {}), model);
  Hypothesis right{model.nominal, {place_effect(*find_effect("stiffness"), model.nominal, 0)}};
  const auto fit_from = [&](const Hypothesis& start) {
    return fit(evidence, start, effect_parameters(evidence, right, model.nominal, 0),
               channel_scale(evidence, std::vector<double>(evidence.channels(), 0)));
  };
  Hypothesis impossible = right;
  impossible.nominal.joint[0].mass = std::numeric_limits<double>::quiet_NaN();

  const int level = FLAGS_minloglevel;
  ASSERT_LT(level, google::GLOG_ERROR);
  ::testing::internal::CaptureStderr();
  EXPECT_TRUE(fit_from(right).usable);
  EXPECT_FALSE(fit_from(impossible).usable) << "its motion cannot be integrated";
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(FLAGS_minloglevel, level);
}

TEST(IndependentRows, ManyOfNoiseAndFewOfErrorsOfTheModel) {
  const ArmModel model = first_joints(1);
  Log log = simulate(motion(model, 6)).measured;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 20 * model.nominal.joint[0].joint_encoder_resolution);
  for (double& q : log.joint_position[0]) q += noise(random);
  const Evidence evidence(make_records(log, model, {}), model);
  // Filters of 20 and 60 Hz, 50 times a second: 2 √π σ_t = 1 / (20 √π) s of the first alone.
  EXPECT_NEAR(evidence.noise_rows(), 50 / (20 * std::sqrt(std::numbers::pi)) * std::hypot(1, 20.0 / 60), 1e-9);
  EXPECT_GT(evidence.correlated_rows(1), 8 * evidence.noise_rows());

  std::vector<double> scale = evidence.floor();
  // The sensor's resolution is a twentieth of its noise before the filter, and about a tenth behind it.
  EXPECT_NEAR(independent_rows(evidence, scale)[1], evidence.noise_rows(), 0.2 * evidence.noise_rows());
  for (double& s : scale) s *= 100;
  // The noise is a ten-thousandth of such a mean square.
  for (const int c : {0, 1})
    EXPECT_NEAR(independent_rows(evidence, scale)[c], evidence.correlated_rows(c), 2e-4 * evidence.correlated_rows(c));
}

TEST(Fit, FindsTheInstantOfASlipThatIsAPeriodOfTheCableOff) {
  constexpr double kJump = 2e-4, kTime = 2.613;  // m, s
  const ArmModel model = first_joints(2);
  Hypothesis truth{model.nominal, {place_effect(*find_effect("cable_slip"), model.nominal, 1)}};
  truth.effects[0].p[0] = kJump, truth.effects[0].p[1] = kTime;
  ArmModel robot = model;
  robot.effects = truth.effects;
  const Evidence evidence(make_records(simulate(motion(robot, 5)).measured, model, {}), model);
  Hypothesis start = truth;
  start.effects[0].p[1] = kTime + 0.008;
  const Fit found = fit(evidence, start, effect_parameters(evidence, start, model.nominal, 0),
                        channel_scale(evidence, evidence.score(start).fit_mean_square));
  ASSERT_TRUE(found.usable);
  EXPECT_NEAR(found.hypothesis.effects[0].p[1], kTime, 0.0015);
  EXPECT_NEAR(found.hypothesis.effects[0].p[0], kJump, 0.02 * kJump);
}

/// A motor that turns a larger capstan than its tolerance allows, at a joint whose zero is off: both move the joint.
TEST(Fit, FindsTheBestOfOneNumberWhileAnotherIsAtItsBound) {
  const ArmModel model = first_joints(1);
  ArmModel robot = model;
  robot.nominal.joint[0].capstan_radius *= 1.02;
  robot.effects = {place_effect(*find_effect("encoder_offset"), model.nominal, 0)};
  robot.effects[0].p[0] = 0.02;
  const Evidence evidence(make_records(simulate(motion(robot, 5)).measured, model, {}), model);
  Hypothesis start{model.nominal, {place_neutral_effect(*find_effect("encoder_offset"), model.nominal, 0)}};
  const std::vector<double> scale = channel_scale(evidence, evidence.score(start).fit_mean_square);
  const std::vector<FitParameter> offset = effect_parameters(evidence, start, model.nominal, 0);
  std::vector<FitParameter> both = baseline_parameters(model);
  std::erase_if(both, [](const FitParameter& p) { return p.name != "joint 1 motor capstan radius"; });
  ASSERT_EQ(both.size(), 1u);
  const FitParameter radius = both[0];
  both.insert(both.end(), offset.begin(), offset.end());
  FitOptions options;
  options.correlated_rows.assign(evidence.channels(), 1);  // the data outweigh the tolerance
  const Fit found = fit(evidence, start, both, scale, options);
  ASSERT_TRUE(found.usable);
  EXPECT_DOUBLE_EQ(parameter_value(found.hypothesis, radius), radius.upper);
  set_parameter(start, radius, radius.upper);
  const double best = fit(evidence, start, offset, scale, options).hypothesis.effects[0].p[0];
  EXPECT_NEAR(found.hypothesis.effects[0].p[0], best, 0.01 * std::abs(best));
}

TEST(BaselineParameters, LeaveNoValueThatAModelFileMayNotHave) {
  ArmModel model = first_joints(2);
  model.joints[0].tolerances = {.length = 3, .mass = 3, .stiffness = 3, .friction = 3};
  for (const FitParameter& p : baseline_parameters(model)) {
    Hypothesis h{model.nominal, {}};
    set_parameter(h, p, p.lower);
    ArmModel at_bound = model;
    at_bound.nominal = h.nominal;
    EXPECT_NO_THROW(parse_model(model_to_xml(at_bound), "at bound")) << p.name;
  }
}

TEST(Sensitivities, AreChangesByOneUnitOfTheOptimiser) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(simulate(motion(model, 2)).measured, model, {}), model);
  const Hypothesis at{model.nominal, {place_neutral_effect(*find_effect("encoder_offset"), model.nominal, 0)}};
  FitParameter offset = effect_parameters(evidence, at, model.nominal, 0).at(0);
  for (const double scale : {0.005, 0.02}) {  // rad
    offset.scale = scale;
    const auto columns = sensitivities(evidence, at, {offset});
    ASSERT_EQ(columns.size(), 1u);
    for (std::size_t r = 0; r < columns[0].size(); ++r)
      if (evidence.row_channel()[r] == 1) {
        // The motor is taken to be as far back, but for the cable's stretch under the changed gravity.
        ASSERT_NEAR(columns[0][r], scale, 0.01 * scale);
      }
  }
}

}  // namespace
}  // namespace halyard
