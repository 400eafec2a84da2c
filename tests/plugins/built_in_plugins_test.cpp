// The estimators that come along: promises kept, and the same numbers as without the boundary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "estimators/built_in.h"
#include "model/model_file.h"
#include "plugins/host/conformance.h"
#include "tests/support/plugin_fixtures.h"
#include "transmission/coupling.h"

using halyard::ArmModel;
using halyard::Sample;
using namespace halyard::plugin_fixtures;

// The check must be able to fail.
TEST(Conformance, FindsWhatACarelessEstimatorBreaks) {
  EXPECT_EQ(halyard::conformance_faults(fixture("careless"), raven2()),
            (std::vector<std::string>{"report: counts 0 steps of 199", "reset: leaves something of the run before",
                                      "two instances: one of two, fed in turn, differs from one alone at sample 0",
                                      "unknown option: is not refused"}));
  // The first is where this fixture passes on what is missing.
  EXPECT_EQ(halyard::conformance_faults(fixture("well_formed"), raven2()).front(),
            "missing samples: plugin fixture: at 0.01 s: innovation 2 is not finite");
}

TEST(Conformance, FindsAnEstimatorThatIsNoKalmanFilter) {
  const std::vector<std::string> faults = halyard::kalman_faults(fixture("careless"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_TRUE(faults[0].starts_with("Kalman: the position at sample 1 is off by ")) << faults[0];
  EXPECT_TRUE(faults[0].ends_with(" nm")) << faults[0];
  EXPECT_EQ(halyard::kalman_faults("sr_ukf"), std::vector<std::string>());
}

TEST(Conformance, FindsInnovationsAndRevisionsThatBelongToNoSample) {
  const auto first = [](const std::string& name) {
    return halyard::conformance_faults(fixture(name), raven2()).front();
  };
  EXPECT_EQ(first("invents_innovations"),
            "missing samples: plugin fixture: at 0.01 s: update: gives 3 innovations where 2 motors have a position");
  EXPECT_EQ(first("certain"),
            "plain record: plugin fixture: at 0.001 s: update: gives an innovation without a deviation: S_root has a "
            "diagonal that is not above 0");
  EXPECT_EQ(first("revises_nowhere"), "plain record: revises an estimate of an instant that is no sample's");
  EXPECT_EQ(first("revises_endlessly"), "plain record: revises more estimates than there are");
}

// The readings of the record are those of the model's own encoders and drives.
TEST(Conformance, KnowsOffsetsAndEffectsOfTheModel) {
  ArmModel model = raven2();
  model.nominal.joint[0].motor_encoder_offset = 0.5;
  model.effects = {halyard::place_effect(*halyard::find_effect("capstan_ratio"), model.nominal, 1)};
  EXPECT_EQ(halyard::conformance_faults(fixture("starts_at_home"), model),
            std::vector<std::string>{"unknown option: is not refused"});
}

TEST(Conformance, TriesTheArmWithoutOneOfItsMotors) {
  ArmModel model = raven2();
  // An effect of a drive goes with it.
  model.effects = {halyard::place_effect(*halyard::find_effect("backlash"), model.nominal, 1)};
  std::vector<std::string> wanted, names;
  for (const std::string k : {"1", "2", "3"})
    wanted.push_back("undriven joint " + k + ": plugin needs_motors: at 0 s: joint_velocity " + k + " is not finite");
  wanted.push_back("unknown option: is not refused");
  EXPECT_EQ(halyard::conformance_faults(fixture("needs_motors"), model), wanted);
  // Who cannot do without a motor may say so before it starts.
  model.estimators["needs_motors"]["refuses"] = "1";
  EXPECT_EQ(halyard::conformance_faults(fixture("needs_motors"), model,
                                        [&](const std::string& promise) { names.push_back(promise); }),
            std::vector<std::string>{wanted.back()});
  EXPECT_EQ(std::ranges::count(names, "undriven joint 2"), 1);

  // An arm without any motor is not asked for.
  model = raven2();
  model.nominal.joint[0].drive = model.nominal.joint[2].drive = halyard::Drive::none;
  names.clear();
  halyard::conformance_faults("kinematics", model, [&](const std::string& promise) { names.push_back(promise); });
  EXPECT_TRUE(std::ranges::none_of(names, [](const std::string& name) { return name.starts_with("undriven"); }));
}

namespace {

struct BuiltIn {
  const char* name;
  std::unique_ptr<halyard::Estimator> (*make)(const ArmModel&, const halyard::EstimatorOptions&);
  halyard::EstimatorOptions options;
};

void PrintTo(const BuiltIn& built_in, std::ostream* out) { *out << built_in.name; }

class BuiltInPlugins : public testing::TestWithParam<BuiltIn> {};

INSTANTIATE_TEST_SUITE_P(
    All, BuiltInPlugins,
    testing::Values(BuiltIn{"sr_ukf", halyard::make_sr_ukf, {{"alpha", "0.01"}}},
                    BuiltIn{"disturbance_sr_ukf", halyard::make_disturbance_sr_ukf, {{"force_wander", "2"}}},
                    BuiltIn{"smoother", halyard::make_smoother, {{"lag", "0.01"}}},
                    BuiltIn{"camera_sr_ukf", halyard::make_camera_sr_ukf, {{"camera_latency", "0.01"}}},
                    BuiltIn{"ekf", halyard::make_ekf, {{"encoder_noise", "1e-4"}}},
                    BuiltIn{"kinematics", halyard::make_kinematics, {}}),
    [](const auto& info) { return info.param.name; });

TEST_P(BuiltInPlugins, KeepWhatEveryEstimatorPromises) {
  for (const char* const name : {"raven2", "raven2_exponential"}) {
    const ArmModel model = halyard::read_model(HALYARD_SOURCE_DIR "/examples/raven2/" + std::string(name) + ".xml");
    EXPECT_EQ(halyard::conformance_faults(GetParam().name, model), std::vector<std::string>()) << name;
  }
}

// Model, options and samples cross as text and double*; no bit may be lost on the way.
TEST_P(BuiltInPlugins, GiveTheSameNumbersAsWithoutTheBoundary) {
  ArmModel model = raven2();
  model.nominal.joint[1].stiffness *= 1.0 / 3;
  model.effects.push_back(halyard::place_effect(*halyard::find_effect("backlash"), model.nominal, 1));
  model.estimators[GetParam().name] = GetParam().options;
  const auto direct = GetParam().make(model, GetParam().options);
  const auto plugin = halyard::make_estimator(GetParam().name, model);

  const Eigen::VectorXd at_home = halyard::unstretched_motors(model.nominal, model.home());
  for (int i = 0; i < 50; ++i) {
    Sample sample = sample_at(0.001 * i);
    sample.motor_position = at_home.array() + 0.1 * std::sin(0.05 * i);
    sample.motor_torque.setConstant(0.01 * std::cos(0.05 * i));
    if (i > 20) sample.joint_torque = Eigen::Vector3d(0.1, 0.2, 0.3);
    if (i % 7 == 3) sample.motor_position(1) = std::nan("");
    if (i % 10 == 9) sample.marker = Eigen::Vector3d(0.05, 0.02, -0.06);
    if (i == 0) {
      direct->reset(sample);
      plugin->reset(sample);
    } else {
      const halyard::Innovation a = direct->update(sample), b = plugin->update(sample);
      ASSERT_EQ(a.time_s, b.time_s);
      ASSERT_EQ(a.nu, b.nu);
      ASSERT_EQ(a.S_root, b.S_root);
      ASSERT_EQ(a.accepted, b.accepted);
    }
    const halyard::Estimate a = direct->estimate(), b = plugin->estimate();
    ASSERT_EQ(a.joint_position, b.joint_position);
    ASSERT_EQ(a.joint_velocity, b.joint_velocity);
    ASSERT_EQ(a.joint_position_std, b.joint_position_std);
    ASSERT_EQ(a.extra_outputs.cols(), b.extra_outputs.cols());
    if (a.extra_outputs.cols() > 0) {  // matrices without columns may have different rows
      ASSERT_EQ(a.extra_outputs, b.extra_outputs);
    }
    for (bool more = true; more;) {
      const auto c = direct->revise(i == 49), d = plugin->revise(i == 49);
      more = c.has_value();
      ASSERT_EQ(more, d.has_value());
      if (!more) continue;
      ASSERT_EQ(c->time_s, d->time_s);
      ASSERT_EQ(c->estimate.joint_position, d->estimate.joint_position);
      ASSERT_EQ(c->estimate.joint_position_std, d->estimate.joint_position_std);
    }
  }
  EXPECT_EQ(direct->extra_output_names(), plugin->extra_output_names());
  EXPECT_EQ(direct->report().steps, plugin->report().steps);
}

TEST_P(BuiltInPlugins, RefuseAnUnknownOptionByName) {
  ArmModel model = raven2();
  model.source = "arm.xml";
  model.estimators[GetParam().name]["alhpa"] = "1";
  const std::string start = std::string("arm.xml: estimator ") + GetParam().name + ": unknown option 'alhpa'; ";
  const std::string message = refusal(GetParam().name, model);
  EXPECT_TRUE(message.starts_with(start)) << message;
}

}  // namespace
