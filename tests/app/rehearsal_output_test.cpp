/// What is told of rehearsals that no diagnosis has run.

#include "app/pages/diagnosis/rehearsal_output.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "model/model_file.h"

namespace halyard {
namespace {

using nlohmann::json;

PlacedEffect rehearsed(const char* name, EffectPlace joint) { return {find_effect(name), joint}; }

/// One of each kind of truth, and one that failed.
Rehearsals four_rehearsals() {
  Rehearsal found, nothing, drawn, failed;
  found.truth = RehearsedTruth::found;
  found.hidden = {{rehearsed("backlash", 1), true, true}};
  found.names = {{rehearsed("backlash", 1), 0.96, true}};
  nothing.verdict = Diagnosis::Verdict::clean;
  drawn.truth = failed.truth = RehearsedTruth::drawn;
  PlacedEffect payload = rehearsed("payload", kWholeArm);
  payload.p[0] = 0.125;
  drawn.hidden = {{rehearsed("stiffness", 0), true, false}, {payload, false, false}};
  drawn.names = {{rehearsed("hysteresis", 0), 0.95, false}};
  drawn.verdict = Diagnosis::Verdict::effects;
  drawn.unexplained = {{2, "a residual"}};
  failed.failure = "log.csv: no";
  return {7, {found, nothing, drawn, failed}};
}

TEST(RehearsalOutput, HasALineForEachKindOfTruthAndOneForFailures) {
  EXPECT_EQ(rehearsal_lines(four_rehearsals()),
            (std::vector<std::string>{
                "with what was found: the same names and no other in 1 of 1",
                "without an effect: clean in 1 of 1; false names: 0",
                "with effects at random: 0 of 1 effects named, 1 of 1 names false; too small to be seen: 1",
                "1 rehearsals failed; they count as not right"}));
  EXPECT_EQ(rehearsal_lines({1, {Rehearsal{}}}).size(), 1u) << "of nothing but logs without an effect";
}

TEST(RehearsalOutput, IsAMemberOfTheDiagnosisOnlyIfThereWereAny) {
  DiagnosisEvaluation evaluation;
  EXPECT_FALSE(json::parse(diagnosis_json({}, evaluation)).contains("rehearsals"));
  evaluation.rehearsals = four_rehearsals();
  Diagnosis d;
  d.given.nominal.n = 3;
  d.effects = {{rehearsed("backlash", 1), 0.97, {}, {}}};
  const json r = json::parse(diagnosis_json(d, evaluation)).at("rehearsals");
  EXPECT_EQ(r.at("seed"), 7);
  // A sure name that is false: 0.97 * 20 of 21 names.
  EXPECT_EQ(r.at("right_if_certain"), 0.924);
  EXPECT_EQ(r.at("effects"), json::array({{{"effect", "backlash"}, {"joint", 2}, {"probability", 0.924}}}));
  EXPECT_EQ(r.at("drawn"), json({{"rehearsals", 2},
                                 {"right", 0},
                                 {"failed", 1},
                                 {"visible_effects", 1},
                                 {"named", 0},
                                 {"too_small", 1},
                                 {"names", 1},
                                 {"false_names", 1}}));
  const json& logs = r.at("rehearsals");
  ASSERT_EQ(logs.size(), 4u);
  EXPECT_EQ(logs[0].at("truth"), "found");
  EXPECT_EQ(logs[1].at("verdict"), "clean");
  EXPECT_EQ(logs[2].at("hidden").at(1), json({{"effect", "payload"},
                                              {"joint", nullptr},
                                              {"parameters", {{"mass", 0.125}}},
                                              {"visible", false},
                                              {"named", false}}));
  EXPECT_EQ(logs[2].at("names"),
            json::array({{{"effect", "hysteresis"}, {"joint", 1}, {"probability", 0.95}, {"right", false}}}));
  EXPECT_EQ(logs[2].at("unexplained"), json::array({{{"joint", 3}, {"signature", "a residual"}}}));
  EXPECT_EQ(logs[3].at("verdict"), nullptr);
  EXPECT_EQ(logs[3].at("failure"), "log.csv: no");
}

TEST(RehearsalOutput, OnThePageTellsEachRehearsal) {
  report::Page page("title", "");
  Diagnosis d;
  d.effects = {{rehearsed("backlash", 1), 0.97, {}, {}}};
  add_rehearsals(page, d, four_rehearsals());
  const std::string html = page.html();
  for (const char* text : {"With these rehearsals, backlash of joint 2 has a probability of 92 %.",
                           "Without an effect: clean in 1 of 1; false names: 0.", "payload (too small to be seen)",
                           "hysteresis of joint 1 (95 %, false)", "log.csv: no"})
    EXPECT_NE(html.find(text), html.npos) << text;
}

}  // namespace
}  // namespace halyard
