#include "app/pages/diagnosis/rehearsal_output.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/name_text.h"
#include "app/pages/diagnosis/place_json.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

using Json = nlohmann::ordered_json;

const char* word(RehearsedTruth truth) {
  switch (truth) {
    case RehearsedTruth::found: return "found";
    case RehearsedTruth::nothing: return "nothing";
    case RehearsedTruth::drawn: break;
  }
  return "drawn";
}

std::string line_of(RehearsedTruth truth, const RehearsalCount& c) {
  switch (truth) {
    case RehearsedTruth::found:
      return fmt::format("with what was found: the same names and no other in {} of {}", c.right, c.rehearsals);
    case RehearsedTruth::nothing:
      return fmt::format("without an effect: clean in {} of {}; false names: {}", c.right, c.rehearsals, c.false_names);
    case RehearsedTruth::drawn: break;
  }
  return fmt::format("with effects at random: {} of {} effects named, {} of {} names false; too small to be seen: {}",
                     c.named, c.visible, c.false_names, c.names, c.too_small);
}

constexpr std::array kTruths = {RehearsedTruth::found, RehearsedTruth::nothing, RehearsedTruth::drawn};

Json count_json(const RehearsalCount& c) {
  return {
      {"rehearsals", c.rehearsals}, {"right", c.right},         {"failed", c.failed}, {"visible_effects", c.visible},
      {"named", c.named},           {"too_small", c.too_small}, {"names", c.names},   {"false_names", c.false_names}};
}

/// By name, with the values that were drawn.
Json parameters_json(const PlacedEffect& e, const ArmParameters<double>& arm) {
  Json all = Json::object();
  const std::vector<EffectParameter> parameters = e.effect->parameters(arm, e.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i) all[parameters[i].name] = rounded_to_digits(e.p[i], 9);
  return all;
}

Json rehearsal_json(const Rehearsal& r, const ArmParameters<double>& arm) {
  Json hidden = Json::array(), names = Json::array();
  for (const HiddenEffect& h : r.hidden) {
    hidden.push_back(place_json(h.effect));
    hidden.back()["parameters"] = parameters_json(h.effect, arm);
    hidden.back().update({{"visible", h.is_visible}, {"named", h.is_named}});
  }
  for (const RehearsedName& n : r.names) {
    names.push_back(place_json(n.effect));
    names.back().update({{"probability", rounded_to_decimals(n.probability, 3)}, {"right", n.is_right}});
  }
  Json unexplained = Json::array();
  for (const Unexplained& u : r.unexplained)
    unexplained.push_back({{"joint", u.joint + 1}, {"signature", u.signature}});
  const bool failed = !r.failure.empty();
  return {{"truth", word(r.truth)},
          {"hidden", hidden},
          {"names", names},
          {"verdict", failed ? Json(nullptr) : Json(verdict_word(r.verdict))},
          {"unexplained", unexplained},
          {"right", r.is_right()},
          {"failure", failed ? Json(r.failure) : Json(nullptr)}};
}

std::string hidden_text(const Rehearsal& r) {
  std::string text;
  for (const HiddenEffect& h : r.hidden)
    text += (text.empty() ? "" : ", ") + effect_label(h.effect) + (h.is_visible ? "" : " (too small to be seen)");
  return text.empty() ? "nothing" : text;
}

std::string names_text(const Rehearsal& r) {
  if (!r.failure.empty()) return r.failure;
  std::string text;
  for (const RehearsedName& n : r.names)
    text += fmt::format("{}{} ({}{})", text.empty() ? "" : ", ", effect_label(n.effect), percent(n.probability),
                        n.is_right ? "" : ", false");
  if (text.empty()) text = verdict_word(r.verdict);
  for (const Unexplained& u : r.unexplained) text += fmt::format("; joint {}: {}", u.joint + 1, u.signature);
  return text;
}

}  // namespace

std::vector<std::string> rehearsal_lines(const Rehearsals& r) {
  std::vector<std::string> lines;
  int failed = 0;
  for (const RehearsedTruth truth : kTruths) {
    const RehearsalCount count = r.count(truth);
    failed += count.failed;
    if (count.rehearsals > 0) lines.push_back(line_of(truth, count));
  }
  if (failed > 0) lines.push_back(fmt::format("{} rehearsals failed; they count as not right", failed));
  return lines;
}

Json rehearsals_json(const Diagnosis& d, const Rehearsals& r) {
  Json all = {{"seed", r.seed}, {"right_if_certain", rounded_to_decimals(r.right_if_certain(), 3)}};
  all["effects"] = Json::array();
  for (const NamedEffect& e : d.effects) {
    all["effects"].push_back(place_json(e.effect));
    all["effects"].back()["probability"] = rounded_to_decimals(r.calibrated(e.probability), 3);
  }
  for (const RehearsedTruth truth : kTruths) all[word(truth)] = count_json(r.count(truth));
  all["rehearsals"] = Json::array();
  for (const Rehearsal& one : r.all) all["rehearsals"].push_back(rehearsal_json(one, d.given.nominal));
  return all;
}

void add_rehearsals(report::Page& page, const Diagnosis& d, const Rehearsals& r) {
  page.heading("Rehearsals: how often is such a diagnosis right?");
  page.paragraph(
      "Logs with the motion, the sensors and the noise of the real ones, but with known effects, were diagnosed as the "
      "real ones were.");
  for (const std::string& line : rehearsal_lines(r)) page.paragraph(capitalised(line) + ".");
  for (const NamedEffect& e : d.effects)
    page.paragraph(fmt::format("With these rehearsals, {} has a probability of {}.", label_of(e),
                               percent(r.calibrated(e.probability))));
  report::Table table;
  table.caption = "The rehearsals";
  table.header = {"", "what the arm had", "what the diagnosis named", "right"};
  table.align = {report::Align::right, report::Align::left, report::Align::left, report::Align::left};
  for (std::size_t i = 0; i < r.all.size(); ++i)
    table.rows.push_back(
        {fmt::format("{}", i + 1), hidden_text(r.all[i]), names_text(r.all[i]), r.all[i].is_right() ? "yes" : "no"});
  page.table(table);
}

}  // namespace halyard
