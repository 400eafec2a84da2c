// The boundary of modules of effects: what is refused, and that what is refused leaves nothing behind.
#include "plugins/host/effect_module.h"

#include <gtest/gtest.h>

#include <string>

#include "diagnosis/search_space.h"
#include "model/input_error.h"
#include "transmission/effect.h"

namespace halyard {
namespace {

std::string fixture(const std::string& name) { return std::string(HALYARD_BROKEN_PLUGINS) + "/" + name + ".so"; }

/// What follows `plugin PATH: ` in the refusal.
std::string refusal(const std::string& name) {
  const std::size_t before = effect_library().size();
  std::string message;
  try {
    load_effects(fixture(name));
    ADD_FAILURE() << name << " was taken";
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(effect_library().size(), before) << name;
  EXPECT_EQ(message.find('\n'), message.npos);
  const std::string start = "plugin " + fixture(name) + ": ";
  EXPECT_TRUE(message.starts_with(start)) << message;
  return message.substr(std::min(start.size(), message.size()));
}

TEST(EffectModule, AModuleThatBreaksTheContractIsRefusedWithOneLineAndLeavesNothing) {
  EXPECT_EQ(refusal("well_formed"),  // an estimator
            "exports no function halyard_effects; it holds no effects, or its function lacks extern \"C\"");
  EXPECT_EQ(refusal("effects_older_interface"),
            "built for effect interface 4, this program speaks 5; rebuild it against the installed headers");
  const std::string compiler = refusal("effects_other_compiler");
  EXPECT_TRUE(compiler.starts_with("compiled by 'Cfront 3', this program by '")) << compiler;
  EXPECT_TRUE(compiler.ends_with("; rebuild it with this program's compiler")) << compiler;
  EXPECT_EQ(
      refusal("effects_other_layout"),
      "the types that it shares with this program have other sizes there; rebuild it against the installed headers");
  EXPECT_EQ(refusal("effects_no_table"), "halyard_effects() returns no table; return the address of a static one");
  EXPECT_EQ(refusal("effects_throwing_table"), "halyard_effects() lets an exception out");
  EXPECT_EQ(refusal("effects_missing_entry"), "its table lacks an entry; fill every entry");
  EXPECT_EQ(refusal("effects_none"), "makes no effect");
  EXPECT_EQ(refusal("effects_null"), "makes an effect that is null");
  EXPECT_EQ(refusal("effects_spaced_name"),
            "effect 'a spring' cannot be named so; use letters, digits, '_' and '-', at most 64");
  const std::string size = refusal("effects_small_table");
  EXPECT_TRUE(size.starts_with("its table has ")) << size;
  EXPECT_TRUE(size.ends_with("; rebuild it against the installed headers")) << size;
  EXPECT_EQ(refusal("effects_taken_name"), "effect 'backlash' is already in the library; give yours another name");
  EXPECT_EQ(refusal("effects_throwing"), "its effects cannot be made: no table of springs in this folder");
  EXPECT_EQ(refusal("effects_refusing"), "its effects cannot be made: no springs are sold here");
  EXPECT_EQ(refusal("effects_missing_scale"),
            "effect 'fixture_spring' must give its 2 states one scale each, finite and not negative; correct "
            "state_scale()");
  EXPECT_EQ(refusal("effects_too_many_parameters"), "effect 'fixture_spring' has 9 parameters; give it 1 to 8");
  EXPECT_EQ(refusal("effects_too_many_states"), "effect 'fixture_spring' has 9 states; the most is 8");
  EXPECT_EQ(refusal("effects_spaced_parameter"),
            "effect 'fixture_spring' has a parameter 'spring rate'; use letters, digits, '_' and '-', at most 64");
  EXPECT_EQ(
      refusal("effects_outside_bounds"),
      "effect 'fixture_spring' has 'stiffness' with the typical value 200 outside its bounds [0, 100]; correct one of "
      "them");
  EXPECT_EQ(refusal("effects_no_range"),
            "effect 'fixture_spring' has 'stiffness' with the bounds [10, 10]; give it a lower bound below the upper "
            "one");
  EXPECT_EQ(refusal("effects_shape_first"),
            "effect 'fixture_spring' lists the shape 'rest' before any size; list the sizes that it belongs to first");
  EXPECT_EQ(refusal("effects_without_stage"),
            "effect 'fixture_spring' acts at no stage and changes no number of an arm; define stages()");
  EXPECT_EQ(refusal("effects_twice"), "makes 'fixture_spring' twice; give each a name of its own");
}

TEST(EffectModule, MayChangeNumbersOfTheArmAlone) {
  load_effects(fixture("effects_numbers_only"));
  const Effect* effect = find_effect("fixture_heavier");
  ASSERT_NE(effect, nullptr);
  EXPECT_EQ(effect->stages(), 0u);
}

TEST(EffectModule, AWellFormedOneJoinsTheLibraryOnceAndActs) {
  load_effects(fixture("effects_well_formed"));
  const Effect* effect = find_effect("fixture_spring");
  ASSERT_NE(effect, nullptr);
  EXPECT_EQ(refusal("effects_well_formed"),
            "effect 'fixture_spring' is already in the library; give yours another name");

  ArmParameters<Dual> arm;
  arm.n = 1;
  JointSignals<Dual> s[1];
  s[0].joint_position = Dual::seed(0.5, 2);
  const Dual p[] = {Dual(4.0)};
  effect->act(EffectStage::joint, EffectContext<Dual>{arm, 0, p, nullptr, 0, nullptr}, s);
  EXPECT_EQ(s[0].joint_force.a, -2);
  EXPECT_EQ(s[0].joint_force.d[2], -4);
}

TEST(EffectModule, AnEffectBringsItsOwnSearchSpaceAlong) {
  load_effects(fixture("effects_refining"));
  ArmParameters<double> arm;
  arm.n = 1;
  SearchSpace space = search_space(*find_effect("fixture_refining_spring"), arm, 0);
  EXPECT_EQ(space["stiffness"].starts, (std::vector<double>{1, 10}));
}

}  // namespace
}  // namespace halyard
