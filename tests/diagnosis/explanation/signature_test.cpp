/// The sentence about a residual that no effect explains.

#include "diagnosis/explanation/signature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "diagnosis/explanation/lines_above_band.h"
#include "diagnosis/explanation/residual_signals.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Signature, TellsTheRootMeanSquareOfAResidualOverWhatItsSensorResolves) {
  const ArmModel model = first_joints(1);
  Log log = simulate(motion(model, 4)).measured;
  for (double& q : log.joint_position[0]) q += 0.5;  // rad: thousands of what the sensor resolves
  const Evidence evidence(make_records(log, model, {}), model);
  const Hypothesis h{model.nominal, {}};
  std::vector<FullPrediction> predictions;
  for (const Record& r : evidence.records()) predictions.push_back(predict_fully(r, h));
  double square = 0, count = 0;
  const ResidualSignals signals = residual_signals(evidence.records(), predictions, h, 0);
  for (const double e : signals.of(ResidualKind::joint_position))
    if (std::isfinite(e)) square += e * e, count += 1;
  char ratio[64];
  std::snprintf(ratio, sizeof ratio, "is %.1f times what its sensor resolves",
                std::sqrt(square / count) / evidence.floor()[1]);
  const std::string told = signature(evidence, h, 0);
  EXPECT_NE(told.find(ratio), std::string::npos) << told << "\n" << ratio;
  EXPECT_NE(told.find(" RMS, "), std::string::npos) << told;
}

TEST(Signature, TellsTheRootMeanSquareOverTheNoiseIfThatIsLarger) {
  const ArmModel model = first_joints(1);
  Log log = log_along(4, 1000, slow_swing);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.01);  // rad: a hundred times what the sensor resolves
  for (double& q : log.joint_position[0]) q += 0.5 + noise(random);
  const Evidence evidence(make_records(log, model, {}), model);
  ASSERT_GT(evidence.floor()[1], evidence.resolved()[1]);
  const std::string told = signature(evidence, {model.nominal, {}}, 0);
  EXPECT_NE(told.find(" times its sensor's noise, and "), std::string::npos) << told;
  EXPECT_EQ(told.find("resolves"), std::string::npos) << told;
}

TEST(Signature, OfARightModelIsEmpty) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(simulate(motion(model, 4)).measured, model, {}), model);
  EXPECT_EQ(signature(evidence, {model.nominal, {}}, 0), "");
}

TEST(LinesAboveBand, TellASineThatIsLargerThanWhatTheSensorResolves) {
  const ArmModel model = first_joints(1);
  const auto told = [&](double amplitude) {
    Log log = log_along(2, 1000, slow_swing);
    for (std::size_t i = 0; i < log.size(); ++i)
      log.joint_position[0][i] += amplitude * std::sin(2 * std::numbers::pi * 50 * log.time[i]);
    const Evidence evidence(make_records(log, model, {}), model);
    return lines_above_band(evidence, {model.nominal, {}});
  };
  const std::vector<Unexplained> lines = told(9.5e-4);  // rad: 0.0544 deg
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].joint, 0);
  EXPECT_EQ(lines[0].kind, Unexplained::Kind::line_above_band);
  EXPECT_TRUE(
      lines[0].signature.starts_with("the position residual contains a sine of 50 Hz with an amplitude of 0.05"))
      << lines[0].signature;
  EXPECT_TRUE(told(1e-5).empty()) << "the sensor's rounding is 2.4e-5";
}

TEST(StandsStill, AMotorThatIsFasterThanTwiceItsSmoothingInLessThanATwentiethOfItsSamples) {
  ArmParameters<double> arm;
  arm.n = 1;
  arm.joint[0].motor_smoothing = 0.5;  // rad/s
  Record record;
  record.n = 1;
  record.size = 100;
  const auto is_still = [&](std::size_t samples, double rate) {
    record.motor_rate.assign(1, std::vector<double>(record.size, 0.0));
    for (std::size_t i = 0; i < samples; ++i) record.motor_rate[0][i] = rate;
    return stands_still(record, arm, 0);
  };
  EXPECT_TRUE(is_still(4, 10));
  EXPECT_FALSE(is_still(5, 10));
  EXPECT_FALSE(is_still(5, -10));
  EXPECT_TRUE(is_still(100, -0.99));
  EXPECT_FALSE(is_still(100, -1.01));
}

}  // namespace
}  // namespace halyard
