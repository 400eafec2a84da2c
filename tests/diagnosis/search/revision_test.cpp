#include "diagnosis/search/revision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/round/refit.h"
#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr double kRatio = 1.02;

PlacedEffect on_the_only_joint(const std::string& name, double size) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), first_joints(1).nominal, 0);
  e.p[0] = size;
  return e;
}

/// A search on the log of an arm with these effects that found those.
struct Searched {
  ArmModel model;
  std::vector<Record> records;
  Evidence evidence, whole;
  Attribution found;

  Searched(const std::vector<PlacedEffect>& true_effects, const std::vector<PlacedEffect>& found_effects)
      : Searched(with(true_effects), first_joints(1), found_effects) {}

  Searched(const ArmModel& robot, const ArmModel& given, const std::vector<PlacedEffect>& found_effects)
      : model(given),
        records(make_records(simulate(motion(robot, 5)).measured, model, {})),
        evidence(records, model),
        whole(records, model, Split::none) {
    const Refitter refitter(evidence, model, 0);
    const auto refitted = [&](const std::vector<PlacedEffect>& effects) {
      const Hypothesis h{model.nominal, effects};
      return refitter.refit(h, evidence.score(h));
    };
    found.baseline = refitted({});
    found.final_fit = refitted(found_effects);
    found.final_score = evidence.score(found.final_fit.hypothesis);
    for (const PlacedEffect& e : found_effects) found.namings.push_back({1, {{e, 0.25}}});
  }
  std::vector<std::size_t> revise() { return halyard::revise(evidence, whole, model, found); }
  std::vector<Doubt> doubts() const {
    return halyard::doubts(evidence, model, found, probabilities_of_none(evidence, found, 0), 0.01);
  }
  const std::vector<PlacedEffect>& effects() const { return found.final_fit.hypothesis.effects; }
  /// The values of the fit, without any uncertainty.
  void make_certain() {
    std::ranges::fill(found.final_fit.std_deviation, 0);
    found.final_fit.covariance.setZero();
  }

 private:
  static ArmModel with(const std::vector<PlacedEffect>& effects) {
    ArmModel robot = first_joints(1);
    robot.effects = effects;
    return robot;
  }
};

TEST(Revision, DropsAnEffectThatTheDataDoNotDetermine) {
  const PlacedEffect larger = on_the_only_joint("capstan_ratio", kRatio);
  Searched s({larger}, {on_the_only_joint("motor_friction", 1e-7), larger});
  s.revise();
  ASSERT_EQ(s.effects().size(), 1u);
  EXPECT_EQ(s.effects()[0].effect->name(), "capstan_ratio");
  EXPECT_NEAR(s.effects()[0].p[0], kRatio, 1e-3);
  ASSERT_EQ(s.found.namings.size(), 1u);
  EXPECT_EQ(s.found.namings[0].alternatives[0].effect.effect->name(), "capstan_ratio") << "the naming of the other one";
}

TEST(Revision, TellsANumberOfTheModelThatChanged) {
  Searched s({on_the_only_joint("motor_friction", 1e-3)}, {});  // within the tolerance of the motor's own friction
  const auto is_friction = [&](std::size_t i) {
    return s.found.final_fit.parameters[i].name == "joint 1 motor Coulomb friction";
  };
  EXPECT_TRUE(std::ranges::any_of(s.revise(), is_friction));
}

TEST(Revision, KeepsADoubtfulEffectButNotOneThatBelongsToTheLog) {
  const PlacedEffect larger = on_the_only_joint("capstan_ratio", kRatio);
  PlacedEffect push = on_the_only_joint("external_force", 0.5);
  push.p[1] = 2, push.p[2] = 3;
  Searched s({larger, push}, {larger, push});
  for (Naming& naming : s.found.namings) naming = {0, {}};  // the names lost against others
  EXPECT_TRUE(is_doubtful(s.found.namings[0], probability_of_none_for(s.evidence, s.found, 0, 0)));
  s.revise();
  ASSERT_EQ(s.effects().size(), 1u);
  EXPECT_EQ(s.effects()[0].effect->name(), "capstan_ratio");
}

TEST(Revision, DropsASlipForWhichACauseOutsideTheLibraryIsMoreProbable) {
  PlacedEffect slip = on_the_only_joint("cable_slip", 2e-4);
  slip.p[1] = 2.5;
  Searched s({slip}, {slip});
  const std::vector<std::size_t> changed = s.revise();
  const auto drop = [&] { return drop_doubtful_events(s.evidence, s.whole, s.model, s.found, changed); };
  s.found.namings[0].unlisted = {0.1, "another cause"};
  EXPECT_EQ(drop(), changed);
  EXPECT_EQ(s.effects().size(), 1u);
  s.found.namings[0].unlisted.weight = 0.9;
  drop();
  EXPECT_TRUE(s.effects().empty());
  EXPECT_TRUE(s.found.namings.empty());
}

TEST(Revision, DropsAPushThatIsDoubtfulBesideAResidualOfItsJoint) {
  PlacedEffect push = on_the_only_joint("external_force", 0.5);
  push.p[1] = 2, push.p[2] = 3;
  const auto effects_left = [&](const std::vector<PlacedEffect>& truth) {
    Searched s(truth, {push});
    s.found.namings[0] = {0.8, {}};
    s.revise();
    return s.effects().size();
  };
  EXPECT_EQ(effects_left({push}), 1u);
  EXPECT_EQ(effects_left({push, on_the_only_joint("encoder_offset", 0.1)}), 0u);
}

TEST(Revision, KeepsWhatWasResetOfAnEffectWhenAnotherOneGoes) {
  const PlacedEffect friction = on_the_only_joint("motor_friction", 4e-3);
  Searched s({friction}, {on_the_only_joint("encoder_offset", 1e-9), friction});
  s.revise();
  ASSERT_EQ(s.effects().size(), 1u);
  EXPECT_EQ(s.effects()[0].effect->name(), "motor_friction");
  const std::vector<ResetParameter>& reset = s.found.final_fit.reset;
  ASSERT_FALSE(reset.empty()) << "this friction is not asymmetric";
  for (const ResetParameter& r : reset) EXPECT_EQ(r.parameter.effect, 0u) << r.parameter.name;
}

TEST(Doubts, ANameBesideAResidualOfItsJointIsUncertain) {
  const PlacedEffect friction = on_the_only_joint("motor_friction", 4e-3),
                     offset = on_the_only_joint("encoder_offset", 0.1);
  const auto none_of = [&](const Searched& s) { return probabilities_of_none(s.evidence, s.found, 0)[0]; };
  EXPECT_LT(none_of(Searched({friction}, {friction})), 0.1);
  const Searched beside({friction, offset}, {friction});
  EXPECT_LT(probability_of_none_for(beside.evidence, beside.found, 0, 0), 0.1) << "it explains the torque";
  EXPECT_NEAR(none_of(beside), kRule.wrong_beside_a_rest, 0.01) << "the position remains unexplained";
}

TEST(Doubts, EffectsThatCancelEachOtherExplainNoMoreThanTheyDoTogether) {
  PlacedEffect ratio = on_the_only_joint("capstan_ratio", kRatio), offset = on_the_only_joint("encoder_offset", 0);
  Searched s({}, {});
  const double middle = s.records[0].motor_angle[0][0];
  offset.p[0] = (1 - 1 / kRatio) * middle;
  const auto none_of_the_ratio = [&](const std::vector<PlacedEffect>& effects) {
    s.found.final_fit.hypothesis = {s.model.nominal, effects};
    s.found.namings.resize(effects.size());
    s.found.final_score = s.evidence.score(s.found.final_fit.hypothesis);
    return probability_of_none_for(s.evidence, s.found, 0, 0);
  };
  EXPECT_GT(none_of_the_ratio({ratio, offset}), 0.9) << "the arm has neither";
  EXPECT_LT(none_of_the_ratio({on_the_only_joint("capstan_ratio", 1)}), 0.5);
}

TEST(Doubts, AnEffectThatIsNeededOnlyBesideADoubtfulOneGetsNoName) {
  const PlacedEffect ratio = on_the_only_joint("capstan_ratio", kRatio),
                     offset = on_the_only_joint("encoder_offset", 0.02);
  const auto of = [&](const std::vector<PlacedEffect>& truth) {
    Searched s(truth, {ratio, offset});
    s.found.namings[0] = {0, {}};  // it lost against others
    s.make_certain();
    return s.doubts();
  };
  EXPECT_EQ(of({offset}), (std::vector{Doubt::another_cause, Doubt::none}));
  EXPECT_EQ(of({}), (std::vector{Doubt::another_cause, Doubt::only_beside_one}));
}

TEST(Doubts, AnEffectGetsNoNameThatIsAGuessAndDoesNotCostOthersTheirs) {
  const PlacedEffect ratio = on_the_only_joint("capstan_ratio", kRatio),
                     offset = on_the_only_joint("encoder_offset", 0.02);
  const auto with_weight = [&](double weight) {
    Searched s({ratio, offset}, {ratio, offset});
    s.found.namings[0] = {weight, {{on_the_only_joint("backlash", 1e-4), 1 - weight}}};
    s.make_certain();
    return s.doubts();
  };
  EXPECT_EQ(with_weight(0.7), (std::vector{Doubt::guess, Doubt::none}));
  EXPECT_EQ(with_weight(0.8), (std::vector{Doubt::none, Doubt::none}));
}

TEST(Doubts, ASingleEffectGetsItsMostProbableNameIfThatIsMoreProbableThanNot) {
  const PlacedEffect ratio = on_the_only_joint("capstan_ratio", kRatio);
  Searched s({ratio}, {ratio});
  const auto with = [&](double weight, double second, double unlisted) {
    s.found.namings[0] = {weight, {{on_the_only_joint("backlash", 1e-4), second}}};
    s.found.namings[0].unlisted.weight = unlisted;
    return s.doubts()[0];
  };
  EXPECT_EQ(with(0.7, 0.3, 0), Doubt::none);
  EXPECT_EQ(with(0.45, 0.3, 0), Doubt::guess);
  EXPECT_EQ(with(0.49, 0.48, 0), Doubt::none) << "it is one of the two";
  EXPECT_EQ(with(0.6, 0.4, 0.3), Doubt::guess) << "with 30 % none of both is right";
  EXPECT_EQ(with(0.8, 0.2, 0.45), Doubt::guess) << "44 %, although four times as probable as the other";
  EXPECT_EQ(with(0.8, 0.2, 0.3), Doubt::none) << "56 %";
}

TEST(Doubts, AGuessIsToldWithItsProbabilityAndWhatElseItMayBe) {
  const Naming naming{0.7, {{on_the_only_joint("backlash", 1e-4), 0.25}, {on_the_only_joint("creep", 1e-4), 0.05}}};
  EXPECT_EQ(reason_of(Doubt::guess, naming, 0.1, {}),
            "its name is a guess (61 %): it may be backlash of joint 1 (22 %)");
  EXPECT_EQ(reason_of(Doubt::guess, {0.7, {}}, 0.1, {}),
            "its name is a guess (61 %): another cause may as well be right");
}

TEST(Doubts, AnEffectWhoseSizeMayBeNeutralGetsNoName) {
  const PlacedEffect ratio = on_the_only_joint("capstan_ratio", kRatio);
  Searched s({ratio}, {ratio});
  Fit& fit = s.found.final_fit;
  const auto named = [&] { return s.doubts(); };
  EXPECT_EQ(named(), (std::vector{Doubt::none}));
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].effect) fit.std_deviation[i] = 1.01 * (kRatio - 1) / interval_factor(fit);
  EXPECT_EQ(named(), (std::vector{Doubt::no_certain_size}));
}

TEST(Doubts, AFrictionThatTheLibraryLacksMakesANameDoubtful) {
  const PlacedEffect friction = on_the_only_joint("motor_friction", 3e-3);
  Searched s({friction}, {friction});
  s.revise();
  EXPECT_EQ(s.doubts(), std::vector<Doubt>{Doubt::none});
  s.found.namings[0].unlisted = {0.9, "friction that grows faster than the speed"};
  EXPECT_GE(probability_of_none_for(s.evidence, s.found, 0, 0), 0.9);
  EXPECT_EQ(s.doubts(), std::vector<Doubt>{Doubt::another_cause});
  EXPECT_NE(reason_of(Doubt::another_cause, s.found.namings[0], 0, s.effects()).find("grows faster than the speed"),
            std::string::npos);
}

TEST(ReasonOfRefusal, NamesAllThatWasAdded) {
  const std::string end = " would explain the training data, but predict this joint worse on the hold-out";
  EXPECT_EQ(reason_of_refusal({on_the_only_joint("backlash", 1e-4), on_the_only_joint("creep", 1e-4)}),
            "backlash of joint 1, creep of joint 1" + end);
  EXPECT_EQ(reason_of_refusal({}), "refitted parameters" + end);
}

TEST(ReasonOfDoubt, ASurerRivalThatWasFoundBeforeIsAnotherOne) {
  const ArmModel model = first_joints(1);
  const PlacedEffect push = place_effect(*find_effect("external_force"), model.nominal, 0),
                     friction = place_effect(*find_effect("motor_friction"), model.nominal, 0);
  Naming naming;
  naming.surer = push;
  EXPECT_EQ(reason_of(Doubt::surer_rival, naming, 0, {friction}),
            "external_force of joint 1 is more probable, though not sure enough for a name either");
  EXPECT_EQ(reason_of(Doubt::surer_rival, naming, 0, {push, friction}),
            "another external_force of joint 1 is more probable, though not sure enough for a name either");
}

TEST(ProbabilityOfARest, IsAHalfAtThreeFloorsOrAtWhatTheEffectsMayMiss) {
  // In squared floors of the joint; nothing of the torque.
  const auto of = [](double rest, double misfit) {
    const double square = std::pow(made_evidence().floor()[1], 2);
    Score score;
    score.mean_square = {0, rest * square};
    return probabilities_of_a_rest(made_evidence(), score, {0, misfit * square});
  };
  EXPECT_EQ(of(9, 0)[0], 0);
  EXPECT_NEAR(of(9, 0)[1], 0.5, 1e-12);
  EXPECT_NEAR(of(36, 27)[1], 0.5, 1e-12) << "27 may be missed, and a floor of one: 36 make it even";
  const ArmModel model = first_joints(1);
  const Evidence without_torque(make_records(log_along(4, 100, slow_swing), model, {}), model);
  Score score;
  score.mean_square = {1, 0};
  EXPECT_EQ(probabilities_of_a_rest(without_torque, score, {0, 0})[0], 0) << "no sensor";
}

}  // namespace
}  // namespace halyard
