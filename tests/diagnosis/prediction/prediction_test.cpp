/// Residuals of an arm that is driven by the measured motion of its motors.

#include "diagnosis/prediction/prediction.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "plant/simulate.h"
#include "tests/diagnosis/prediction/finite_numbers.h"
#include "tests/support/short_arm.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

Log unquantised_log(const ArmModel& robot, double duration) {
  Scenario s = motion(robot, duration);
  s.quantise = false;
  return simulate(s).measured;
}

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
    ArmModel model = first_joints(2);
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
  const ArmModel model = first_joints(2);
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
    Hypothesis h{model.nominal, {place_effect(*find_effect("backlash"), model.nominal, 1)}};
    h.effects[0].p[0] = 1e-4 * (i % 5);
    h.nominal.joint[1].mass *= 1 + 0.02 * (i % 7);
    h.nominal.joint[0].joint_coulomb *= 1 - 0.03 * (i % 4);
    all.push_back(h);
  }
  return all;
}

TEST(Prediction, OfAHypothesisDoesNotDependOnItsLaneNorOnWhatRunsBesideIt) {
  const ArmModel model = first_joints(2);
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
  const ArmModel model = first_joints(2);
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
  const ArmModel model = first_joints(2);
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
  const ArmModel model = first_joints(2);
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

TEST(Prediction, AHypothesisWithANumberThatIsNoneSharesItsMotionWithNoOther) {
  const ArmModel model = first_joints(2);
  const Record record = make_records(unquantised_log(model, 4), model, {})[0];
  Hypothesis right{model.nominal, {}}, none = right;
  none.nominal.joint[0].stiffness = NAN;
  EXPECT_FALSE(predict(record, {none}, 1)[0].finite);
  for (const bool is_first : {true, false}) {
    const auto both = predict(record, is_first ? std::vector{none, right} : std::vector{right, none}, 1);
    EXPECT_EQ(both[0].finite, !is_first);
    EXPECT_EQ(both[1].finite, is_first);
  }
}

TEST(Prediction, OfARigidDriveNeedsNoLinkBesideTheRotor) {
  ArmModel model = first_joints(1);
  JointParameters<double>& j = model.nominal.joint[0];
  j.drive = Drive::rigid;
  j.mass = 0;
  for (double& moment : j.inertia) moment = 0;
  Scenario s = motion(model, 3);
  s.quantise = false;
  s.engine = Engine::halyard;
  const Record record = make_records(simulate(s).measured, model, {})[0];
  const Residuals residuals = predict(record, {{model.nominal, {}}}, 4)[0];
  ASSERT_TRUE(residuals.finite);
  double square = 0, torque = 0;
  for (std::size_t i = 0; i < residuals.channel[0].size(); ++i) {
    const double e = residuals.channel[0][i], t = record.torque[0][4 * i];
    if (std::isfinite(e)) square += e * e, torque += t * t;
  }
  // Filters of motion and torque do not commute with friction.
  EXPECT_LT(square, 0.03 * 0.03 * torque);
}

TEST(Prediction, OfAnArmThatRingsIsStable) {
  const ArmModel model = first_joints(2);
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

TEST(Prediction, OfALoopThatYieldsAtOnceIsThatOfASofterCable) {
  const ArmModel model = first_joints(2);
  Scenario fast = motion(model, 3);
  for (JointTrajectory& t : fast.trajectory)
    for (Sine& s : t.sines) s.frequency_hz *= 3;  // the loop follows as fast as its cable stretches
  const Record record = make_records(simulate(fast).measured, model, {})[0];
  constexpr double kShare = 0.73;
  Hypothesis softer{model.nominal, {}};
  softer.nominal.joint[0].stiffness *= 1 - kShare;
  const Residuals of_softer = predict(record, {softer}, 1)[0], of_model = predict(record, {{model.nominal, {}}}, 1)[0];
  PlacedEffect loop = place_effect(*find_effect("hysteresis"), model.nominal, 0);
  loop.p[0] = kShare;
  const double earliest = loop.effect->parameters(model.nominal, 0)[1].lower;
  for (const double times : {1, 2, 3, 4, 6}) {
    loop.p[1] = times * earliest;
    const Residuals e = predict(record, {{model.nominal, {loop}}}, 1)[0];
    ASSERT_TRUE(e.finite) << times;
    double off = 0, softens = 0;
    for (std::size_t i = record.size / 4; i < record.size; ++i) {
      if (!std::isfinite(e.channel[2][i])) continue;
      off = std::max(off, std::abs(e.channel[2][i] - of_softer.channel[2][i]));
      softens = std::max(softens, std::abs(of_model.channel[2][i] - of_softer.channel[2][i]));
    }
    EXPECT_LT(off, 0.05 * softens) << times;
  }
}

TEST(Prediction, OfEverySampleIsTheReadingLessItsResidual) {
  const ArmModel model = first_joints(2);
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

TEST(Prediction, OfAWristThatIsLightForItsFrictionFollowsThePlant) {
  ArmModel model = first_joints(2);
  JointParameters<double>& wrist = model.nominal.joint[1];
  wrist.mass = 0.02;
  for (double& c : wrist.com) c = 0;
  wrist.com[0] = 0.01;
  const double inertia[] = {1e-6, 3e-6, 3e-6, 0, 0, 0};
  std::copy(std::begin(inertia), std::end(inertia), wrist.inertia);
  wrist.joint_coulomb = 0.02, wrist.joint_viscous = 2e-4;  // 8e5 1/s at standstill
  wrist.pulley_radius = 6e-3, wrist.stiffness = 20e3, wrist.damping = 20;
  const Log log = unquantised_log(model, 3);
  for (const double step : {2e-3, 4e-3}) {  // of fine and of coarse records
    RecordOptions options;
    options.step_s = step;
    const std::vector<Following> joints = follow(log, model, options, {model.nominal, {}});
    EXPECT_LT(joints[1].rms, 0.02 * joints[1].stretch_rms) << step;
  }
}

}  // namespace
}  // namespace halyard
