/// Modules of effects: what they do as they are loaded, they do first in a process of their own.

#include "evaluation/run/tried_effects.h"

#include <gtest/gtest.h>

#include "plugins/host/effect_module.h"
#include "tests/support/environment.h"
#include "tests/support/message_of.h"
#include "tests/support/plugin_fixtures.h"
#include "transmission/effect.h"

namespace halyard {
namespace {

/// What follows `plugin PATH: ` in the refusal.
std::string refusal_of_effects(const std::string& name, const ContainmentOptions& containment = {}) {
  const std::size_t before = effect_library().size();
  const std::string message = message_of([&] { load_tried_effects(plugin_fixtures::fixture(name), containment); });
  EXPECT_EQ(effect_library().size(), before) << name;
  const std::string start = "plugin " + plugin_fixtures::fixture(name) + ": ";
  EXPECT_TRUE(message.starts_with(start)) << message;
  return message.substr(std::min(start.size(), message.size()));
}

constexpr const char* kRemedy =
    "; correct what runs then: static constructors, halyard_effects(), and the effects' constructors and descriptions";

TEST(TriedEffects, AModuleThatCrashesOrHangsIsRefused) {
  for (const char* name : {"effects_crashes_when_opened", "effects_crashes_in_table"})
    EXPECT_EQ(refusal_of_effects(name), std::string("as it is loaded: crashed: Segmentation fault") + kRemedy);
  EXPECT_EQ(refusal_of_effects("effects_hangs_when_opened", {.step_limit_s = 0.3}),
            std::string("as it is loaded: took more than 0.3 s, and was ended") + kRemedy);
}

TEST(TriedEffects, AModuleThatCanBeLoadedJoinsTheLibraryOnce) {
  if (!find_effect("fixture_spring")) load_tried_effects(plugin_fixtures::fixture("effects_well_formed"));
  EXPECT_NE(find_effect("fixture_spring"), nullptr);
  const std::string taken = "effect 'fixture_spring' is already in the library; give yours another name";
  EXPECT_EQ(refusal_of_effects("effects_well_formed"), taken);
  EXPECT_EQ(refusal_of_effects("effects_well_formed", {.in_process = true}), taken);
}

TEST(TriedEffects, AnotherRefusalIsThatOfThisProcess) {
  for (const char* name : {"well_formed", "effects_older_interface", "no_such_module"})
    EXPECT_EQ(refusal_of_effects(name), refusal_of_effects(name, {.in_process = true}));
}

TEST(TriedEffects, NeedAWorkerUnlessTheyAreTrusted) {
  const Environment none("HALYARD_WORKER", "/no/such/program");
  EXPECT_EQ(message_of([] { load_tried_effects(plugin_fixtures::fixture("effects_older_interface")); }),
            "HALYARD_WORKER: '/no/such/program' is no file; give the path of halyard_worker");
}

}  // namespace
}  // namespace halyard
