/// diagnosis.json of results that no diagnosis has found.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "model/model_file.h"

namespace halyard {
namespace {

using nlohmann::json;

json json_of(const Diagnosis& d) { return json::parse(diagnosis_json(d, {})); }

/// A backlash of joint 2 that may be a hysteresis of joint 2 or a payload.
NamedEffect backlash() {
  const ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  const auto placed = [&](const char* name, EffectPlace joint) {
    return place_effect(*find_effect(name), model.nominal, joint);
  };
  Estimated gap{"half_gap", "m", 2e-4, 1e-4, 3e-4, 0};
  return {placed("backlash", 1),
          0.5,
          {gap},
          {{placed("hysteresis", 1), 0.25, true}, {placed("payload", kWholeArm), 0.125, false}}};
}

json alternatives() {
  return json::array({{{"effect", "hysteresis"}, {"joint", 2}, {"probability", 0.25}, {"in_set", true}},
                      {{"effect", "payload"}, {"joint", nullptr}, {"probability", 0.125}, {"in_set", false}}});
}

TEST(DiagnosisJson, HasANamedEffectWithItsPlaceInTheSet) {
  Diagnosis d;
  d.effects = {backlash()};
  const json effect = json_of(d).at("effects").at(0);
  EXPECT_EQ(effect.at("effect"), "backlash");
  EXPECT_EQ(effect.at("joint"), 2);
  EXPECT_EQ(effect.at("probability"), 0.5);
  EXPECT_EQ(effect.at("in_set"), true);
  EXPECT_EQ(effect.at("alternatives"), alternatives());
  EXPECT_EQ(effect.at("parameters"),
            json({{"half_gap", {{"value", 2e-4}, {"unit", "m"}, {"ci95", {1e-4, 3e-4}}, {"at_bound", false}}}}));
  EXPECT_FALSE(effect.contains("log"));
}

TEST(DiagnosisJson, HasAnEffectWithoutASureNameInTheFormOfThoseWithOne) {
  Diagnosis d;
  d.effects = {backlash()};
  d.unexplained = {{0, "a residual"},
                   {2, "backlash of joint 2 explains a part of it", Unexplained::Kind::unnamed_effect}};
  d.unexplained[1].effect = backlash();
  d.unexplained[1].effect->log = "second.csv";
  d.unexplained[1].effect->in_set = false;
  const json all = json_of(d), rest = all.at("unexplained").at(0), unnamed = all.at("unexplained").at(1);
  EXPECT_EQ(rest, json({{"joint", 1}, {"signature", "a residual"}})) << "no effect is known";
  EXPECT_EQ(unnamed.at("joint"), 3) << "the joint whose residual it explains a part of";
  EXPECT_EQ(unnamed.at("signature"), "backlash of joint 2 explains a part of it");
  json same = all.at("effects").at(0);
  same["log"] = "second.csv";
  same["in_set"] = false;
  EXPECT_EQ(unnamed.at("unnamed_effect"), same);
}

TEST(DiagnosisJson, SaysOfEveryNumberWhetherItIsAtItsBound) {
  Diagnosis d;
  d.refitted = {{"joint 1 link mass", "kg", 1.05, 1.04, 1.06, 1}, {"joint 2 link mass", "kg", 1, 0.9, 1.1, 1}};
  d.refitted[0].at_bound = true;
  d.effects = {backlash()};
  d.effects[0].parameters[0].at_bound = true;
  const json all = json_of(d);
  EXPECT_EQ(all.at("refitted").at(0).at("at_bound"), true);
  EXPECT_EQ(all.at("refitted").at(1).at("at_bound"), false);
  EXPECT_EQ(all.at("effects").at(0).at("parameters").at("half_gap").at("at_bound"), true);
}

}  // namespace
}  // namespace halyard
