#include "diagnosis/diagnosis_details.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "diagnosis/explanation/signature.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

/// Shoulder and elbow alone.
ArmModel two_joints() { return first_joints(2); }

PlacedEffect placed(const std::string& name, const ArmModel& model, int joint, const std::vector<double>& p) {
  PlacedEffect e = place_effect(*find_effect(name), model.nominal, joint);
  for (std::size_t i = 0; i < p.size(); ++i) e.p[i] = p[i];
  return e;
}

/// One name is enough for these tests; a second round would only take time.
DiagnosisOptions quick() {
  DiagnosisOptions options;
  options.most_effects = 1;
  return options;
}

/// A record of the true arm and another one to hold out, and what the model says to them.
Diagnosis diagnose_arm(const ArmModel& model, const ArmModel& truth) {
  return diagnose(model, {simulate(motion(truth, 8)).measured}, simulate(motion(truth, 3, 1)).measured, quick());
}

void expect_half_gap(const Diagnosis& d, double truth) {
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.effect->name(), "backlash");
  EXPECT_EQ(d.effects[0].effect.joint, 1);
  ASSERT_FALSE(d.effects[0].parameters.empty());
  const Estimated& gap = d.effects[0].parameters[0];
  EXPECT_EQ(gap.name, "half_gap");
  EXPECT_TRUE((gap.lower <= truth && truth <= gap.upper) || std::abs(gap.value - truth) < 0.1 * truth)
      << gap.value << " [" << gap.lower << ", " << gap.upper << "]";
}

TEST(Diagnose, FindsNothingWhereNothingIsMissing) {
  const ArmModel model = two_joints();
  const Diagnosis d = diagnose_arm(model, model);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_TRUE(d.unexplained.empty());
}

TEST(Diagnose, NamesBacklashAndItsRevisedModelPredictsBetter) {
  const ArmModel model = two_joints();
  ArmModel truth = model;
  truth.effects.push_back(placed("backlash", model, 1, {3e-4}));
  const Diagnosis d = diagnose_arm(model, truth);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::effects);
  expect_half_gap(d, 3e-4);
  // 0.3 mm are 5.3 mrad of the elbow.
  EXPECT_GT(d.before.joint_rms[1], 4e-3);
  EXPECT_LT(d.after.joint_rms[1], 0.2 * d.before.joint_rms[1]);

  const ArmModel loaded = parse_model(model_to_xml(d.revised), "revised.xml");
  ASSERT_EQ(loaded.effects.size(), 1u);
  EXPECT_EQ(loaded.effects[0].effect->name(), "backlash");
  const FullPrediction again = predict_fully(d.details->joint_view.records[0], {loaded.nominal, loaded.effects});
  ASSERT_EQ(again.joint_reading[1].size(), d.details->joint_view.after[0].joint_reading[1].size());
  for (std::size_t i = 0; i < again.joint_reading[1].size(); ++i) {
    const double now = again.joint_reading[1][i], then = d.details->joint_view.after[0].joint_reading[1][i];
    ASSERT_TRUE(now == then || (std::isnan(now) && std::isnan(then))) << "the file is the model to the last bit";
  }
}

TEST(Diagnose, NamesFrictionThatIsElasticBeforeItSlides) {
  const ArmModel model = two_joints();
  ArmModel truth = model;
  truth.effects.push_back(placed("motor_presliding", model, 0, {0.8, 0.5}));
  const Diagnosis d = diagnose_arm(model, truth);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(effect_label(d.effects[0].effect), "motor_presliding of joint 1");
  EXPECT_NEAR(d.effects[0].effect.p[0], 0.8, 0.08);
  EXPECT_NEAR(d.effects[0].effect.p[1], 0.5, 0.05);
}

TEST(Diagnose, RefitsAStiffnessWithinItsTolerance) {
  const ArmModel model = two_joints();
  ArmModel truth = model;
  truth.nominal.joint[1].stiffness *= 0.92;
  const Diagnosis d = diagnose_arm(model, truth);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_TRUE(d.effects.empty());
  ASSERT_EQ(d.refitted.size(), 1u);
  EXPECT_EQ(d.refitted[0].name, "joint 2 cable stiffness");
  EXPECT_EQ(d.refitted[0].nominal, 88e3);
  // The change is 7 kN/m; a fifth of it was observed to be left to other numbers at most.
  EXPECT_NEAR(d.refitted[0].value, 0.92 * 88e3, 0.2 * 0.08 * 88e3);
  EXPECT_LT(d.after.joint_rms[1], d.before.joint_rms[1]);
}

TEST(Diagnose, RefitsACentreOfMassWithinItsTolerance) {
  ArmModel model = two_joints();
  ArmModel truth = model;
  for (double& x : truth.nominal.joint[1].com) x += 0.012;
  EXPECT_NE(diagnose_arm(model, truth).verdict, Diagnosis::Verdict::clean);
  model.joints[1].tolerances.com = 0.06;
  const Diagnosis d = diagnose_arm(model, truth);
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  const auto is_centre = [](const Estimated& e) { return e.name.starts_with("joint 2 link centre of mass"); };
  EXPECT_TRUE(std::ranges::any_of(d.refitted, is_centre));
  EXPECT_LT(d.after.torque_rms[1], 0.2 * d.before.torque_rms[1]);
}

/// A log in which stiff motors move the joints along their trajectories, without a simulation.
Log kinematic_log(const ArmModel& model, const std::vector<std::vector<Sine>>& sines, double duration) {
  Log log(model.n());
  log.source = "kinematic.csv";
  for (long i = 0; i <= std::lround(duration * 1000); ++i) {
    log.time.push_back(i * 1e-3);
    Eigen::VectorXd q = model.home();
    for (int k = 0; k < model.n(); ++k)
      for (const Sine& s : sines[k])
        q(k) += s.amplitude * std::sin(2 * std::numbers::pi * s.frequency_hz * log.time.back());
    const Eigen::VectorXd q_m = unstretched_motors(model.nominal, q);
    for (int k = 0; k < model.n(); ++k) log.motor_position[k].push_back(q_m(k)), log.joint_position[k].push_back(q(k));
  }
  return log;
}

TEST(OneSinusoid, IsSeenInTheJointsOwnMotionAndInAJointThatStandsStill) {
  const ArmModel model = two_joints();
  const auto one = [&](const std::vector<Sine>& shoulder, const std::vector<Sine>& elbow, int joint) {
    const std::vector<Record> records = make_records(kinematic_log(model, {shoulder, elbow}, 8), model, {});
    return is_one_sinusoid(records, model.nominal, joint);
  };
  const Sine slow{0.25, 0.3, 0};
  for (const double f : {0.29, 0.4, 0.523, 0.7, 1.1}) {  // on no common grid of frequencies
    const Sine sine{0.2, f, 0};
    EXPECT_TRUE(one({sine}, {sine}, 0)) << f;
    EXPECT_TRUE(one({sine}, {sine}, 1)) << f;
    // The elbow's motor also makes up for the shoulder, by C_21 = 0.145: it moves along two lines, the elbow along one.
    EXPECT_TRUE(one({{0.9, 0.3, 0}}, {sine}, 1)) << f;
    EXPECT_TRUE(one({}, {sine}, 0)) << f << ": stands still";
    EXPECT_TRUE(one({}, {sine}, 1)) << f;
    EXPECT_FALSE(one({slow, {0.1, f + 0.2, 0}}, {sine}, 0)) << f;
  }
}

TEST(OneSinusoid, OfAJointWithoutAMotorIsThatOfItsSensor) {
  ArmModel model = two_joints();
  model.nominal.joint[1].drive = Drive::none;
  const Sine slow{0.25, 0.3, 0}, fast{0.1, 0.9, 0};
  const auto one = [&](const std::vector<Sine>& elbow) {
    Log log = kinematic_log(two_joints(), {{slow}, elbow}, 8);
    log.motor_position[1].clear();
    return is_one_sinusoid(make_records(log, model, {}), model.nominal, 1);
  };
  EXPECT_TRUE(one({slow}));
  EXPECT_FALSE(one({slow, fast}));
}

TEST(Diagnose, NeedsALog) { EXPECT_THROW(diagnose(two_joints(), {}, {}, quick()), InputError); }

TEST(Diagnose, NamesNothingFromOneSine) {
  const ArmModel model = two_joints();
  const Log other = simulate(motion(model, 3, 1)).measured;
  // The elbow alone moves, and it has backlash: there is a residual that a name would fit.
  ArmModel truth = model;
  truth.effects.push_back(placed("backlash", model, 1, {3e-4}));
  Scenario s = motion(truth, 8);
  s.trajectory[0].kind = JointTrajectory::Kind::hold;
  s.trajectory[1].sines.resize(1);
  const Diagnosis d = diagnose(model, {simulate(s).measured}, other, quick());
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::unknown);
  EXPECT_TRUE(d.effects.empty());
  ASSERT_EQ(d.unexplained.size(), 3u);
  for (const int k : {0, 1}) EXPECT_EQ(d.unexplained[k].kind, Unexplained::Kind::motion);
  EXPECT_EQ(d.unexplained[2].kind, Unexplained::Kind::rest) << "of the elbow";
  EXPECT_EQ(d.unexplained[2].joint, 1);
  EXPECT_NE(d.unexplained[0].signature.find("stands still"), std::string::npos) << d.unexplained[0].signature;
  EXPECT_NE(d.unexplained[1].signature.find("one sine"), std::string::npos) << d.unexplained[1].signature;
  EXPECT_LT(d.probability_clean, 0.01) << "what acts has no name, but it acts";
  EXPECT_TRUE(d.revised.effects.empty());
}

TEST(Diagnose, LeavesWhatNumbersExplainWithinTheirTolerancesWhereItNamesNothing) {
  const ArmModel model = two_joints();
  ArmModel truth = model;
  truth.nominal.joint[0].motor_coulomb *= 1.2;
  truth.effects.push_back(placed("backlash", model, 1, {3e-4}));
  Scenario s = motion(truth, 8);
  for (JointTrajectory& t : s.trajectory) t.sines.resize(1);
  const Diagnosis d = diagnose(model, {simulate(s).measured}, {}, quick());
  ASSERT_EQ(d.unexplained.size(), 3u);
  for (const int k : {0, 1}) EXPECT_EQ(d.unexplained[k].kind, Unexplained::Kind::motion);
  EXPECT_EQ(d.unexplained[2].kind, Unexplained::Kind::rest);
  EXPECT_EQ(d.unexplained[2].joint, 1) << "not the other joint, whose friction is within its tolerance";
}

// The second, independent simulator; 15 s of its 30 s records, for the time that this takes.
class Rig : public ::testing::Test {
 protected:
  static Log first_15_s(const std::string& folder, const ArmModel& model) {
    const Log log = read_log(std::filesystem::path(HALYARD_SHARED_DATA) / "rig" / folder / "train.csv", model.n());
    return split_log(log, 15.0 / log.duration()).first;
  }
  void SetUp() override {
    if (!std::filesystem::exists(HALYARD_SHARED_DATA "/rig"))
      GTEST_SKIP() << "shared data not found: " HALYARD_SHARED_DATA "/rig";
  }
};

TEST_F(Rig, ExactModelIsFoundClean) {
  const ArmModel model = raven2();
  const Diagnosis d = diagnose(model, {first_15_s("clean-1", model)}, {}, quick());
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  EXPECT_TRUE(d.effects.empty());
}

TEST_F(Rig, BacklashOfTheElbowIsNamedAndMeasured) {
  const ArmModel model = raven2();
  const Diagnosis d = diagnose(model, {first_15_s("backlash-j2", model)}, {}, quick());
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::effects);
  expect_half_gap(d, 3.5e-4);
  EXPECT_LT(d.after.joint_rms[1], 0.2 * d.before.joint_rms[1]);
}

}  // namespace
}  // namespace halyard
