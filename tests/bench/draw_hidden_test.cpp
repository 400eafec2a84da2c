/// What trials hide: which effects, of which sizes, and how far the arm is off its model. The rules are in trial.h.

#include "bench/diagnosis/draw/hidden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bench/diagnosis/forms/unregistered.h"
#include "diagnosis/fit/fit_parameter.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

std::vector<Hidden> hidden(Kind kind, int index, std::uint64_t seed = 1) {
  Random random(seed, 0, static_cast<std::uint32_t>(index));
  return draw_effects(raven2(), kind, index, random);
}

bool can_have(const Effect& effect) { return !effect_places(effect, raven2().nominal).empty(); }

/// The effects that trials of a kind take in turn, and the right answers.
using Turns = std::vector<std::pair<const Effect*, std::string>>;
Turns turns_of(Kind kind) {
  Turns turns;
  if (kind == Kind::effect)
    for (const Effect* e : effect_library()) turns.emplace_back(e, e->name());
  if (kind == Kind::outside)
    for (const Effect* e : outside_effects()) turns.emplace_back(e, e->name());
  if (kind == Kind::form)
    for (const OtherForm& form : other_forms()) turns.emplace_back(form.effect, form.like);
  std::erase_if(turns, [](const auto& turn) { return !can_have(*turn.first); });
  return turns;
}

TEST(DrawnEffects, AreNoneOfACleanArm) { EXPECT_TRUE(hidden(Kind::clean, 0).empty()); }

TEST(DrawnEffects, OfOneKindTakeEveryEffectInTurnAndStartAgain) {
  for (const Kind kind : {Kind::effect, Kind::form, Kind::outside}) {
    const Turns turns = turns_of(kind);
    ASSERT_GE(turns.size(), 3u) << word(kind);
    for (std::size_t i = 0; i < 2 * turns.size(); ++i) {
      const std::vector<Hidden> one = hidden(kind, static_cast<int>(i));
      ASSERT_EQ(one.size(), 1u);
      EXPECT_EQ(one[0].acts.effect, turns[i % turns.size()].first) << word(kind) << " " << i;
      EXPECT_EQ(one[0].right_name, turns[i % turns.size()].second) << word(kind) << " " << i;
      const std::vector<EffectPlace> places = effect_places(*one[0].acts.effect, raven2().nominal);
      EXPECT_EQ(std::ranges::count(places, one[0].acts.joint), 1) << word(kind) << " " << i;
    }
  }
}

TEST(DrawnEffects, OfOneKindAreAtEveryPlace) {
  const Effect* const backlash = find_effect("backlash");
  const Turns turns = turns_of(Kind::effect);
  const auto turn = std::ranges::find(turns, backlash, &Turns::value_type::first) - turns.begin();
  std::set<EffectPlace> at;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    at.insert(hidden(Kind::effect, static_cast<int>(turn), seed)[0].acts.joint);
  EXPECT_EQ(at.size(), effect_places(*backlash, raven2().nominal).size());
}

TEST(DrawnEffects, OfSeveralAreDifferentOnesOfTheLibraryAndADelayIsTheFirst) {
  bool has_delay = false;
  for (const auto& [kind, count] : {std::pair(Kind::two_at_joint, 2u), std::pair(Kind::three, 3u)}) {
    std::set<EffectPlace> joints;
    for (int index = 0; index < 100; ++index) {
      const std::vector<Hidden> all = hidden(kind, index);
      ASSERT_EQ(all.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(find_effect(all[i].right_name), all[i].acts.effect);
        EXPECT_TRUE(kind == Kind::three || all[i].acts.joint == all[0].acts.joint) << index;
        joints.insert(all[i].acts.joint);
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(same_name(all[i].acts, all[j].acts)) << index;
        const bool is_delay = all[i].right_name == "delay";
        has_delay = has_delay || is_delay;
        EXPECT_TRUE(!is_delay || i == 0 || all[i - 1].right_name == "delay") << "it acts on what comes before it";
      }
    }
    EXPECT_GE(joints.size(), 3u) << word(kind);
  }
  EXPECT_TRUE(has_delay) << "no draw has shown the rule";
}

TEST(DrawnEffects, AreThoseOfTheirSeedAlone) {
  for (const Kind kind : {Kind::effect, Kind::three})
    for (std::size_t i = 0; i < hidden(kind, 4).size(); ++i)
      EXPECT_TRUE(same_name(hidden(kind, 4)[i].acts, hidden(kind, 4)[i].acts));
}

/// How far each number of the arm is off its model, in tolerances.
std::vector<double> off_by(const ArmModel& robot) {
  std::vector<double> off;
  for (const FitParameter& p : baseline_parameters(raven2()))
    off.push_back((parameter_value({robot.nominal, {}}, p) - p.nominal) / (p.upper - p.nominal));
  return off;
}

std::vector<double> mistuned(int off, const std::vector<Hidden>& effects, std::uint64_t seed = 1) {
  ArmModel robot = raven2();
  Random random(seed, 0, 0);
  mistune(robot, off, effects, random);
  return off_by(robot);
}

constexpr double kRounding = 1e-12;  // of a value over its tolerance, which is at least 1/200 of it: 200 eps and a few

TEST(MistunedArms, AreOffByUpToSoManyTolerances) {
  for (const double off : mistuned(0, {})) EXPECT_EQ(off, 0);
  for (const int tolerances : {1, 2}) {
    double least = 0, most = 0, count = 0, square = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
      for (const double off : mistuned(tolerances, {}, seed)) {
        least = std::min(least, off), most = std::max(most, off);
        count += 1, square += off * off;
      }
    EXPECT_GE(least, -tolerances - kRounding);
    EXPECT_LE(most, tolerances + kRounding);
    EXPECT_LT(least, -0.95 * tolerances);
    EXPECT_GT(most, 0.95 * tolerances);
    // Uniform: a mean square of a third. That of n draws has a relative deviation of sqrt(4 / 5 / n); four of them.
    EXPECT_GT(count, 400);
    EXPECT_NEAR(square / count, tolerances * tolerances / 3.0,
                tolerances * tolerances / 3.0 * 4 * std::sqrt(0.8 / count));
  }
}

TEST(MistunedArms, KeepTheNumbersWhosePlaceAHiddenEffectTakesAndDrawTheOthersAlike) {
  const Hidden ratio{place_effect(*find_effect("capstan_ratio"), raven2().nominal, 1), "capstan_ratio"};
  const std::vector<double> free = mistuned(1, {}), beside = mistuned(1, {ratio});
  const std::vector<FitParameter> numbers = baseline_parameters(raven2());
  int kept = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool covered = effect_covers(ratio.acts, raven2().nominal, numbers[i]);
    kept += covered;
    EXPECT_EQ(beside[i], covered ? 0 : free[i]) << numbers[i].name;
    EXPECT_EQ(covered, numbers[i].name == "joint 2 motor capstan radius") << numbers[i].name;
  }
  EXPECT_EQ(kept, 1);
}

TEST(MistunedArms, HaveNamesForNumbersBeyondTheirTolerance) {
  ArmModel robot = raven2();
  EXPECT_TRUE(names_beyond_tolerance(raven2(), robot).empty());
  const double friction = raven2().nominal.joint[1].motor_coulomb;
  robot.nominal.joint[1].motor_coulomb = 1.19 * friction;
  EXPECT_TRUE(names_beyond_tolerance(raven2(), robot).empty()) << "its tolerance is 0.2";
  robot.nominal.joint[1].motor_coulomb = 1.21 * friction;
  const std::vector<Place> names = names_beyond_tolerance(raven2(), robot);
  EXPECT_EQ(std::ranges::count(names, Place{"motor_friction", 2}), 1);
  for (const Place& p : names) EXPECT_EQ(p.joint, 2) << label(p);
}

TEST(PlacesOfEffects, AreJointsFromOneOrTheArm) {
  const ArmParameters<double>& arm = raven2().nominal;
  EXPECT_EQ(place_of(place_effect(*find_effect("backlash"), arm, 1), 3), (Place{"backlash", 2}));
  EXPECT_EQ(place_of(place_effect(*find_effect("payload"), arm, kWholeArm), 3), (Place{"payload", 0}));
  EXPECT_EQ(place_of(place_effect(*find_effect("payload"), arm, kWholeArm), 1), (Place{"payload", 1}));
}

}  // namespace
}  // namespace halyard::blind
