#include "diagnosis/holdout/adoption.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/fit/fit_parameter.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr double kDuration = 4;  // s

PlacedEffect on_the_only_joint(const std::string& name, const std::vector<double>& p) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), first_joints(1).nominal, 0);
  std::ranges::copy(p, e.p);
  return e;
}

/// A joint of the RAVEN-II whose true arm has these effects in the training, and those in a hold-out log of its own.
class Revision {
 public:
  Revision(const std::vector<PlacedEffect>& in_training, const std::vector<PlacedEffect>& on_holdout)
      : training_(make_records(log_with(in_training, 0), model_, {})),
        evidence_(training_, model_),
        whole_(training_, model_, Split::none) {
    const Log log = log_with(on_holdout, 1);
    joints.records = make_records(log, model_, kJointErrorBand);
    torques.records = make_records(log, model_, kFitBand);
    for (HoldOut* view : {&joints, &torques}) view->before = predict_all(view->records, {model_.nominal, {}});
  }

  /// Offers the hypothesis, of which these numbers changed. left: the share of their tolerance, as a variance, that the
  /// training leaves.
  Adoption offer(const Hypothesis& h, const std::vector<FitParameter>& numbers = {}, double left = 0) {
    Revised revised;
    revised.fit.hypothesis = h;
    revised.fit.parameters = numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      revised.fit.value.push_back(parameter_value(h, numbers[i]));
      revised.changed.push_back(i);
    }
    Eigen::VectorXd variance(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      variance(static_cast<Eigen::Index>(i)) = left * numbers[i].scale * numbers[i].scale;
    revised.fit.covariance = variance.asDiagonal();
    return adopted_on_holdout({evidence_, whole_, model_, model_, true}, revised, joints, torques);
  }

  const ArmModel& model() const { return model_; }
  double rms(std::vector<FullPrediction> HoldOut::*which) const {
    return prediction_errors(joints, torques, model_.nominal, which).joint_rms[0];
  }

  HoldOut joints, torques;

 private:
  static Log log_with(const std::vector<PlacedEffect>& effects, int variant) {
    ArmModel robot = first_joints(1);
    robot.effects = effects;
    return simulate(motion(robot, kDuration, variant)).measured;
  }

  const ArmModel model_ = first_joints(1);
  std::vector<Record> training_;
  Evidence evidence_, whole_;
};

TEST(Adoption, IsOfAnEffectThatTheHoldOutHasAsWell) {
  const PlacedEffect zero = on_the_only_joint("encoder_offset", {0.01});
  Revision r({zero}, {zero});
  const Adoption a = r.offer({r.model().nominal, {zero}});
  EXPECT_TRUE(a.worse.empty());
  EXPECT_TRUE(a.absent_events.empty());
  EXPECT_EQ(a.revised.fit.hypothesis.effects.size(), 1u);
  EXPECT_LT(r.rms(&HoldOut::after), 0.1 * r.rms(&HoldOut::before));
}

TEST(Adoption, IsRefusedIfAJointIsPredictedWorse) {
  Revision r({}, {});
  const Adoption a = r.offer({r.model().nominal, {on_the_only_joint("encoder_offset", {0.01})}});
  EXPECT_EQ(a.worse, std::vector<int>{0});
  EXPECT_EQ(r.rms(&HoldOut::after), r.rms(&HoldOut::before)) << "the given model predicts";
}

TEST(Adoption, GivesTheNumbersOfTheMotionBackBeforeItRefuses) {
  Revision r({}, {});
  std::vector<FitParameter> numbers = baseline_parameters(r.model());
  std::erase_if(numbers, [](const FitParameter& p) { return !p.name.ends_with("capstan radius"); });
  ASSERT_EQ(numbers.size(), 1u);
  Hypothesis wrong{r.model().nominal, {}};
  wrong.nominal.joint[0].capstan_radius *= 1.05;
  const Adoption a = r.offer(wrong, numbers);
  EXPECT_TRUE(a.worse.empty());
  EXPECT_TRUE(a.revised.changed.empty());
  EXPECT_EQ(a.revised.fit.hypothesis.nominal.joint[0].capstan_radius, r.model().nominal.joint[0].capstan_radius);
}

TEST(Adoption, GivesAWeakNumberBackAndKeepsWhatTheOthersExplain) {
  Revision r({}, {});
  std::vector<FitParameter> numbers = baseline_parameters(r.model());
  std::erase_if(numbers, [](const FitParameter& p) {
    return !p.name.ends_with("capstan radius") && !p.name.ends_with("motor Coulomb friction");
  });
  ASSERT_EQ(numbers.size(), 2u);
  Hypothesis wrong{r.model().nominal, {}};
  wrong.nominal.joint[0].capstan_radius *= 1.05;
  wrong.nominal.joint[0].motor_coulomb *= 1.05;
  const Adoption a = r.offer(wrong, numbers, 0.5);
  EXPECT_TRUE(a.worse.empty());
  EXPECT_EQ(a.revised.fit.hypothesis.nominal.joint[0].capstan_radius, r.model().nominal.joint[0].capstan_radius);
  ASSERT_EQ(a.revised.fit.parameters.size(), 1u) << "that of the motor is fitted again";
  EXPECT_TRUE(a.revised.fit.parameters[0].name.ends_with("motor Coulomb friction"));
}

TEST(Adoption, LeavesAPushOutOfALogThatHasNone) {
  const PlacedEffect push = on_the_only_joint("external_force", {2, 1.5, 2.5});  // N m, s, s
  Revision r({push}, {});
  const Adoption a = r.offer({r.model().nominal, {push}});
  EXPECT_EQ(a.absent_events, std::vector<std::size_t>{0});
  EXPECT_TRUE(a.worse.empty());
  EXPECT_EQ(a.revised.fit.hypothesis.effects.size(), 1u) << "the training has it";
}

TEST(Adoption, KeepsAPushThatHappensAtTheSameTimeOfBothLogs) {
  const PlacedEffect push = on_the_only_joint("external_force", {2, 1.5, 2.5});  // N m, s, s
  Revision r({push}, {push});
  EXPECT_TRUE(r.offer({r.model().nominal, {push}}).absent_events.empty());
  EXPECT_LT(r.rms(&HoldOut::after), r.rms(&HoldOut::before));
}

}  // namespace
}  // namespace halyard
