#include "diagnosis/search_space.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/search_space/built_in.h"
#include "model/input_error.h"
#include "tests/support/message_of.h"
#include "tests/support/random_arm.h"

namespace halyard {
namespace {

/// An arm whose joints are revolute and prismatic, with a cable, a rigid drive and none.
ArmParameters<double> mixed_arm() {
  ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  arm.joint[0].type = JointType::revolute;
  arm.joint[1].type = JointType::prismatic;
  arm.joint[1].drive = Drive::rigid;
  arm.joint[2].drive = Drive::none;
  return arm;
}

TEST(SearchSpace, EachParameterOfTheLibraryHasOneWithStartsThatAscendInsideItsBounds) {
  for (const ArmParameters<double>& arm : {random_arm(1, CableLaw::linear), mixed_arm()})
    for (const Effect* effect : effect_library())
      for (const EffectPlace joint : effect_places(*effect, arm)) {
        SCOPED_TRACE(effect_label({effect, joint, {}}));
        const std::vector<EffectParameter> parameters = effect->parameters(arm, joint);
        const SearchSpace space = search_space(*effect, arm, joint);
        ASSERT_EQ(space.parameters.size(), parameters.size());
        for (std::size_t i = 0; i < parameters.size(); ++i) {
          const ParameterSearch& search = space.parameters[i];
          EXPECT_EQ(search.name, parameters[i].name);
          EXPECT_TRUE(std::ranges::is_sorted(search.starts, std::less_equal{})) << search.name;
          for (const double start : search.starts) {
            if (start == parameters[i].neutral || search.is_whole) continue;
            EXPECT_GT(start, parameters[i].lower) << search.name;
            EXPECT_LT(start, parameters[i].upper) << search.name;
          }
          EXPECT_TRUE(search.starts.empty() || parameters[i].is_shape()) << search.name << ": a size needs no starts";
          if (!search.changes.kind) continue;
          EXPECT_GE(search.changes.joint, 0) << search.name;
          EXPECT_LT(search.changes.joint, arm.n) << search.name;
          EXPECT_GE(search.changes.size, 0) << search.name;
        }
      }
}

TEST(SearchSpace, EachRefinementBelongsToAnEffectOfTheLibrary) {
  int n = 0;
  for (const auto spaces : {cable_spaces(), joint_spaces(), motor_spaces(), sensor_spaces()})
    for (const BuiltInSpace& space : spaces) {
      EXPECT_NE(find_effect(space.effect), nullptr) << space.effect;
      ++n;
    }
  EXPECT_GT(n, 0);
}

TEST(SearchSpace, AnEffectThatChangesANumberOfTheModelFallsUnderThatNumbersTolerance) {
  const ArmParameters<double> arm = random_arm(3, CableLaw::linear);
  const auto changes = [&](const char* effect, EffectPlace joint, const char* parameter) {
    return search_space(*find_effect(effect), arm, joint)[parameter].changes;
  };
  const TolerancedNumber mass = changes("payload", kWholeArm, "mass");
  EXPECT_EQ(mass.kind, &Tolerances::mass);
  EXPECT_EQ(mass.joint, arm.n - 1) << "a payload adds to the last link";
  EXPECT_EQ(mass.size, arm.joint[arm.n - 1].mass);

  const TolerancedNumber coupling = changes("coupling", 2, "from_joint_2");
  EXPECT_EQ(coupling.kind, &Tolerances::coupling);
  EXPECT_EQ(coupling.joint, 2);
  EXPECT_EQ(coupling.size, std::abs(arm.joint[2].coupling[1]));

  EXPECT_EQ(changes("capstan_ratio", 1, "ratio").kind, &Tolerances::length);
  EXPECT_EQ(changes("stiffness", 1, "damping_ratio").kind, &Tolerances::stiffness);
  EXPECT_EQ(changes("motor_friction", 1, "viscous_change").size, arm.joint[1].motor_viscous);
  EXPECT_EQ(changes("joint_friction", 1, "coulomb_change").size, arm.joint[1].joint_coulomb);
  EXPECT_EQ(changes("backlash", 1, "half_gap").kind, nullptr) << "the model has no gap";
}

/// A user's effect with a size and a shape.
class Bump : public EffectOf<Bump> {
 public:
  std::string name() const override { return "bump"; }
  std::string summary() const override { return "for tests"; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"height", "N m", 0, 1, 0, 10}, {"width", "rad", 0.1, 0.1, 0.01, 1}};
  }
};

TEST(SearchSpace, OfAUsersEffectIsDerivedFromItsBounds) {
  const SearchSpace space = search_space(Bump(), random_arm(1, CableLaw::linear), 0);
  ASSERT_EQ(space.parameters.size(), 2u);
  EXPECT_EQ(space.parameters[0].name, "height");
  EXPECT_EQ(space.parameters[1].name, "width");
  for (const ParameterSearch& p : space.parameters) {
    EXPECT_TRUE(p.starts.empty()) << "it sets out from the typical value";
    EXPECT_EQ(p.range, SearchRange::own);
    EXPECT_FALSE(p.natural_bounds);
    EXPECT_EQ(p.changes.kind, nullptr);
  }
  EXPECT_FALSE(space.order_of_motor_torque);
}

class RefinedBump : public Bump, public RefinesSearch {
 public:
  explicit RefinedBump(void (*refine)(SearchSpace&)) : refine_(refine) {}
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override { refine_(space); }

 private:
  void (*refine_)(SearchSpace&);
};

TEST(SearchSpace, AUsersEffectRefinesItsOwn) {
  const RefinedBump bump([](SearchSpace& space) {
    space["height"].natural_bounds = true;
    space["width"].starts = {0.05, 0.2};
  });
  SearchSpace space = search_space(bump, random_arm(1, CableLaw::linear), 0);
  EXPECT_TRUE(space["height"].natural_bounds);
  EXPECT_EQ(space["width"].starts, (std::vector<double>{0.05, 0.2}));
}

TEST(SearchSpace, ARefinementThatIsWrongIsRefusedWithTheEffectsName) {
  const auto refusal = [](void (*refine)(SearchSpace&)) {
    return message_of([&] { search_space(RefinedBump(refine), random_arm(1, CableLaw::linear), 0); });
  };
  EXPECT_EQ(refusal([](SearchSpace& s) {
              s["width"].starts = {0.2, 0.1};
            }),
            "effect 'bump': the starts of 'width' do not ascend; give each once, the smallest first");
  EXPECT_EQ(refusal([](SearchSpace& s) {
              s["width"].starts = {0.2, 0.2};
            }),
            "effect 'bump': the starts of 'width' do not ascend; give each once, the smallest first");
  EXPECT_EQ(refusal([](SearchSpace& s) {
              s["width"].starts = {0.2, 2};
            }),
            "effect 'bump': starts of 'width' lie outside its bounds; move them inside");
  EXPECT_EQ(refusal([](SearchSpace& s) { s["length"].starts = {1}; }),
            "effect 'bump': its search space cannot be told: search space: the effect has no parameter \"length\"; "
            "name one of its own");
  EXPECT_EQ(refusal([](SearchSpace& s) { s.parameters.pop_back(); }),
            "effect 'bump': its search space has other parameters than itself; change those that it is given");
  EXPECT_EQ(refusal([](SearchSpace& s) {
              s["height"].changes = {&Tolerances::friction, 7, 1};
            }),
            "effect 'bump': the number that 'height' changes is negative or of no joint; give a joint of the arm, and "
            "a size of 0 or more");
  EXPECT_EQ(refusal([](SearchSpace& s) { s.order_of_motor_torque = 2; }),
            "effect 'bump': the index of its order is no parameter of it; give the index of one");
  EXPECT_EQ(refusal([](SearchSpace& s) { s.another = {"stiffness"}; }),
            "effect 'bump': it gives another effect; only the library's own effects do; leave it out");
}

TEST(SearchSpace, WholeNumbersStartInsideTheirBounds) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  int n = 0;
  for (const char* name : {"torque_ripple", "encoder_eccentricity"}) {
    const EffectParameter order = find_effect(name)->parameters(arm, 0)[2];
    const ParameterSearch search = search_space(*find_effect(name), arm, 0)["order"];
    ASSERT_TRUE(search.is_whole) << name;
    for (const double start : search.starts) {
      EXPECT_GE(start, order.lower) << name;
      EXPECT_LE(start, order.upper) << name;
      ++n;
    }
  }
  EXPECT_GT(n, 0);
}

TEST(SearchSpace, APushIsAnEventAndAContactIsNone) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  PlacedEffect contact = place_neutral_effect(*find_effect("external_force"), arm, 0), push = contact;
  contact.p[4] = 100;  // contact_stiffness
  push.p[0] = 1;       // force
  EXPECT_TRUE(is_event(push, arm));
  EXPECT_FALSE(is_event(contact, arm));
  EXPECT_TRUE(has_instants(contact, arm)) << "though it has none in use";
  EXPECT_TRUE(is_event(place_effect(*find_effect("cable_slip"), arm, 0), arm));
  EXPECT_FALSE(is_event(place_effect(*find_effect("backlash"), arm, 0), arm));
}

TEST(SearchSpace, AShareThatMayBeOneHasNaturalBounds) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  int n = 0;
  for (const Effect* effect : effect_library())
    for (const EffectPlace joint : effect_places(*effect, arm)) {
      const SearchSpace space = search_space(*effect, arm, joint);
      for (const EffectParameter& p : effect->parameters(arm, joint)) {
        if (!p.name.ends_with("share") || p.upper != 1) continue;
        const auto search = std::ranges::find(space.parameters, p.name, &ParameterSearch::name);
        EXPECT_TRUE(search->natural_bounds) << effect->name() << " " << p.name;
        ++n;
      }
    }
  EXPECT_GT(n, 0);
}

/// A fit keeps whole numbers as they start, and a sine of a neighbouring order leaves most of the residual.
TEST(SearchSpace, AnEccentricSensorMayHaveAnyOrderUpTo32) {
  const ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  for (int k = 0; k < arm.n; ++k) {
    if (arm.joint[k].type != JointType::revolute) continue;
    SearchSpace space = search_space(*find_effect("encoder_eccentricity"), arm, k);
    for (int order = 1; order <= 32; ++order)
      EXPECT_TRUE(std::ranges::binary_search(space["order"].starts, order)) << order;
  }
}

TEST(SearchSpace, ARefinementMayGoToTheEndsOfWhatIsRightAndNotBeyond) {
  const auto answer = [](void (*refine)(SearchSpace&)) {
    return message_of([&] { search_space(RefinedBump(refine), random_arm(1, CableLaw::linear), 0); });
  };
  const std::string fine = "no InputError",
                    no_number =
                        "effect 'bump': the number that 'height' changes is negative or of no joint; give a "
                        "joint of the arm, and a size of 0 or more";
  EXPECT_EQ(answer([](SearchSpace& s) { s["width"].starts = {0.01, 1}; }), fine);
  EXPECT_EQ(answer([](SearchSpace& s) { s["height"].changes = {&Tolerances::friction, 0, 0}; }), fine);
  EXPECT_EQ(answer([](SearchSpace& s) { s["height"].changes = {&Tolerances::friction, 2, 1}; }), fine);
  EXPECT_EQ(answer([](SearchSpace& s) { s["height"].changes = {&Tolerances::friction, 3, 1}; }), no_number);
  EXPECT_EQ(answer([](SearchSpace& s) { s["height"].changes = {&Tolerances::friction, -1, 1}; }), no_number);
  EXPECT_EQ(answer([](SearchSpace& s) { s["height"].changes = {&Tolerances::friction, 0, -1}; }), no_number);
  EXPECT_EQ(answer([](SearchSpace& s) { s.greatest_motor_speed = 1; }), fine);
  EXPECT_EQ(answer([](SearchSpace& s) { s.greatest_motor_speed = 2; }),
            "effect 'bump': the index of its greatest motor speed is no parameter of it; give the index of one");
  EXPECT_EQ(answer([](SearchSpace& s) { s.order_of_joint_position = 2; }),
            "effect 'bump': the index of its order is no parameter of it; give the index of one");
}

}  // namespace
}  // namespace halyard
