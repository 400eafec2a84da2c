#include "diagnosis/diagnosis_details.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "diagnosis/explanation/signature.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "tests/support/finite_numbers.h"
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

Log unquantised_log(const ArmModel& robot, double duration) {
  Scenario s = motion(robot, duration);
  s.quantise = false;
  return simulate(s).measured;
}

// --------------------------------------------------------------------------------------- prediction

/// How well the driven arm follows a joint from the first second on, up to where the comparing kernel sees the end.
struct Following {
  double rms = 0, peak = 0, stretch_rms = 0, peak_acceleration = 0;
};
std::vector<Following> follow(const Log& log, const ArmModel& model, const RecordOptions& options,
                              const Hypothesis& hypothesis) {
  const Record r = make_records(log, model, options)[0];
  const Residuals e = predict(r, {hypothesis}, 1)[0];
  EXPECT_TRUE(e.finite);
  std::vector<Following> all(r.n);
  double count = 0;
  for (std::size_t i = static_cast<std::size_t>(1 / r.dt); i + r.compare.size() / 2 < r.size; ++i, ++count) {
    Eigen::VectorXd q_m(r.n), a_m(r.n);
    for (int k = 0; k < r.n; ++k) q_m(k) = r.motor_angle[k][i], a_m(k) = r.motor_acceleration[k][i];
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(r.n), q = unstretched_joints(model.nominal, q_m, zero);
    const Eigen::VectorXd a = unstretched_joints(model.nominal, a_m, zero);
    for (int k = 0; k < r.n; ++k) {
      const double error = e.channel[r.n + k][i];
      all[k].rms += error * error;
      all[k].peak = std::max(all[k].peak, std::abs(error));
      all[k].stretch_rms += (r.joint[k][i] - q(k)) * (r.joint[k][i] - q(k));
      all[k].peak_acceleration = std::max(all[k].peak_acceleration, std::abs(a(k)));
    }
  }
  for (Following& f : all) f.rms = std::sqrt(f.rms / count), f.stretch_rms = std::sqrt(f.stretch_rms / count);
  return all;
}

TEST(Prediction, DrivenByTheMotorsFollowsThePlantsJointsToSecondOrderOfItsStep) {
  for (const bool rigid_elbow : {false, true}) {
    ArmModel model = two_joints();
    if (rigid_elbow) model.nominal.joint[1].drive = Drive::rigid;
    const Log log = unquantised_log(model, 4);
    const Hypothesis truth{model.nominal, {}};
    RecordOptions coarse, fine;
    coarse.motion_hz = fine.motion_hz = 500;  // as good as no filter
    coarse.compare_hz = fine.compare_hz = 0;
    coarse.step_s = 4e-3;
    fine.step_s = 1e-3;
    const auto at_4_ms = follow(log, model, coarse, truth), at_1_ms = follow(log, model, fine, truth);
    for (int k = 0; k < 2; ++k) {
      SCOPED_TRACE((rigid_elbow ? "rigid elbow, joint " : "joint ") + std::to_string(k + 1));
      // The method's own error is of the order of h²/4 q'', well below the stretch that the prediction is there for.
      EXPECT_LT(at_4_ms[k].peak, 4e-3 * 4e-3 / 4 * at_4_ms[k].peak_acceleration);
      EXPECT_LT(at_1_ms[k].peak, 1e-3 * 1e-3 / 4 * at_4_ms[k].peak_acceleration);
      EXPECT_LT(at_1_ms[k].rms, 0.01 * at_1_ms[k].stretch_rms);
      // Second order: a sixteenth with a quarter of the step.
      EXPECT_GT(at_4_ms[k].rms / at_1_ms[k].rms, 3 * 3);
      EXPECT_LT(at_4_ms[k].rms / at_1_ms[k].rms, 5 * 5);
    }
  }
}

TEST(Prediction, FilterOfRecordsCostsFewPercentOfTheStretchAndAWrongStiffnessShowsAboveIt) {
  const ArmModel model = two_joints();
  const Log log = unquantised_log(model, 4);
  const auto right = follow(log, model, {}, {model.nominal, {}});
  Hypothesis soft{model.nominal, {}};
  soft.nominal.joint[1].stiffness *= 0.85;
  const auto wrong = follow(log, model, {}, soft);
  // Friction does not commute with a filter. Empirical: 1.9 and 0.5 % were observed.
  for (int k = 0; k < 2; ++k) EXPECT_LT(right[k].rms, 0.03 * right[k].stretch_rms);
  // Elastic stretch is inverse to stiffness: 15 % less is 18 % more.
  EXPECT_NEAR(wrong[1].rms / right[1].stretch_rms, 1 / 0.85 - 1, 0.05);
}

/// Arms that differ in numbers only.
std::vector<Hypothesis> some_hypotheses(const ArmModel& model, int count) {
  std::vector<Hypothesis> all;
  for (int i = 0; i < count; ++i) {
    Hypothesis h{model.nominal, {placed("backlash", model, 1, {1e-4 * (i % 5)})}};
    h.nominal.joint[1].mass *= 1 + 0.02 * (i % 7);
    h.nominal.joint[0].joint_coulomb *= 1 - 0.03 * (i % 4);
    all.push_back(h);
  }
  return all;
}

TEST(Prediction, OfAHypothesisDoesNotDependOnItsLaneNorOnWhatRunsBesideIt) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  const std::vector<Hypothesis> all = some_hypotheses(model, 2 * kLaneWidth + 3);
  const auto together = predict(record, all, 4);
  ASSERT_EQ(together.size(), all.size());
  const std::vector<Hypothesis> backwards(all.rbegin(), all.rend());
  const auto reversed = predict(record, backwards, 4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto expected = finite_numbers(together[i]);
    ASSERT_GT(expected.size(), 500u);
    EXPECT_EQ(finite_numbers(predict(record, {all[i]}, 4)[0]), expected) << i;
    EXPECT_EQ(finite_numbers(reversed[all.size() - 1 - i]), expected) << i;
  }
  EXPECT_NE(finite_numbers(together[0]), finite_numbers(together[1]));
}

TEST(Prediction, ChangesByLessThanItsOwnErrorBesideAHypothesisThatNeedsMoreStages) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  std::vector<Hypothesis> all = some_hypotheses(model, 2);
  const auto alone = predict(record, {all[0]}, 4)[0].channel[2];
  all[1].nominal.joint[0].joint_smoothing /= 20;  // friction twenty times as stiff
  const auto both = predict(record, all, 4);
  ASSERT_TRUE(both[1].finite);
  double change = 0;
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (std::isfinite(alone[i])) change = std::max(change, std::abs(both[0].channel[2][i] - alone[i]));
  EXPECT_LT(change, 2e-3 * 2e-3 / 4 * 5);  // h²/4 q'' as above, of a motion of 5 rad/s²
}

TEST(Prediction, IsTheSameOnOneThreadAndOnTwo) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  const std::vector<Hypothesis> all = some_hypotheses(model, 5 * kLaneWidth);
  std::vector<Residuals> by_one, by_two;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    by_one = predict(record, all, 4);
  }
  {
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
    by_two = predict(record, all, 4);
  }
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(finite_numbers(by_one[i]), finite_numbers(by_two[i])) << i;
}

TEST(Prediction, AHypothesisThatCannotBeIntegratedSaysSoAndLeavesItsNeighboursAlone) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  std::vector<Hypothesis> all = some_hypotheses(model, 3);
  const auto expected = predict(record, all, 4);
  all[1].nominal.joint[0].damping *= 1e4;
  const auto beside = predict(record, all, 4);
  EXPECT_FALSE(beside[1].finite);
  for (const int i : {0, 2}) {
    EXPECT_TRUE(beside[i].finite);
    EXPECT_EQ(finite_numbers(beside[i]), finite_numbers(expected[i]));
  }
}

TEST(Prediction, OfAnArmThatRingsIsStable) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  Hypothesis h{model.nominal, {}};
  // A mode at 140 Hz with a hundredth of critical damping, once friction no longer damps it: 2 ms are no step for it.
  h.nominal.joint[0].stiffness *= 7;
  h.nominal.joint[0].damping *= 0.02;
  const Residuals e = predict(record, {h}, 1)[0];
  ASSERT_TRUE(e.finite);
  // The cable stretches less than the model's: it cannot be further off than that stretches.
  const Residuals of_model = predict(record, {{model.nominal, {}}}, 1)[0];
  double most = 0, stretch = 0;
  for (std::size_t i = 0; i < record.size; ++i) {
    if (std::isfinite(e.channel[2][i])) most = std::max(most, std::abs(e.channel[2][i] - of_model.channel[2][i]));
    Eigen::VectorXd q_m(record.n);
    for (int k = 0; k < record.n; ++k) q_m(k) = record.motor_angle[k][i];
    stretch = std::max(stretch, std::abs(record.joint[0][i] - unstretched_joints(model.nominal, q_m, model.home())(0)));
  }
  EXPECT_GT(most, 0);
  EXPECT_LT(most, stretch);
}

TEST(Prediction, OfEverySampleIsTheReadingLessItsResidual) {
  const ArmModel model = two_joints();
  const Record record = make_records(unquantised_log(model, 2), model, {})[0];
  const Hypothesis h{model.nominal, {}};
  const FullPrediction full = predict_fully(record, h);
  const Residuals each = predict(record, {h}, 1)[0], fourth = predict(record, {h}, 4)[0];
  // The torque's last 32 ms do not count: its filter sees beyond the end there.
  for (std::size_t i = 300; i + 20 < record.size; ++i) {
    EXPECT_EQ(full.joint_reading[1][i], record.joint[1][i] - each.channel[3][i]);
    EXPECT_EQ(full.torque_residual[0][i], each.channel[0][i]);
    EXPECT_EQ(fourth.channel[3][i / 4], each.channel[3][i / 4 * 4]);
  }
}

// --------------------------------------------------------------------------------------- end to end

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
  ASSERT_FALSE(d.unexplained.empty());
  EXPECT_NE(d.unexplained[0].signature.find("one sine"), std::string::npos);
  EXPECT_LT(d.probability_clean, 0.01) << "what acts has no name, but it acts";
  EXPECT_TRUE(d.revised.effects.empty());
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
