#include "app/pages/diagnosis/rehearsal_output.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/name_text.h"
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
      return fmt::format("with what was found: {} of {} find the same names and no other", c.right, c.logs);
    case RehearsedTruth::nothing:
      return fmt::format("without an effect: {} of {} are clean; {} false names", c.right, c.logs, c.false_names);
    case RehearsedTruth::drawn: break;
  }
  return fmt::format(
      "with effects at random: {} of {} effects named, {} of {} names false; {} more effects were too small to be seen",
      c.named, c.visible, c.false_names, c.names, c.too_small);
}

constexpr std::array kTruths = {RehearsedTruth::found, RehearsedTruth::nothing, RehearsedTruth::drawn};

Json count_json(const RehearsalCount& c) {
  return {{"logs", c.logs},   {"right", c.right},         {"failed", c.failed}, {"visible_effects", c.visible},
          {"named", c.named}, {"too_small", c.too_small}, {"names", c.names},   {"false_names", c.false_names}};
}

Json place_json(const PlacedEffect& e) {
  return {{"effect", e.effect->name()}, {"joint", e.joint ? Json(*e.joint + 1) : Json(nullptr)}};
}

Json log_json(const RehearsedLog& log) {
  Json hidden = Json::array(), names = Json::array();
  for (const HiddenEffect& h : log.hidden) {
    hidden.push_back(place_json(h.effect));
    hidden.back().update({{"visible", h.is_visible}, {"named", h.is_named}});
  }
  for (const RehearsedName& n : log.names) {
    names.push_back(place_json(n.effect));
    names.back().update({{"probability", rounded_to_decimals(n.probability, 3)}, {"right", n.is_right}});
  }
  const bool failed = !log.failure.empty();
  return {{"truth", word(log.truth)}, {"hidden", hidden},
          {"names", names},           {"verdict", failed ? Json(nullptr) : Json(verdict_word(log.verdict))},
          {"right", log.is_right()},  {"failure", failed ? Json(log.failure) : Json(nullptr)}};
}

std::string hidden_text(const RehearsedLog& log) {
  std::string text;
  for (const HiddenEffect& h : log.hidden)
    text += (text.empty() ? "" : ", ") + effect_label(h.effect) + (h.is_visible ? "" : " (too small to be seen)");
  return text.empty() ? "nothing" : text;
}

std::string names_text(const RehearsedLog& log) {
  if (!log.failure.empty()) return log.failure;
  std::string text;
  for (const RehearsedName& n : log.names)
    text += fmt::format("{}{} ({}{})", text.empty() ? "" : ", ", effect_label(n.effect), percent(n.probability),
                        n.is_right ? "" : ", false");
  return text.empty() ? verdict_word(log.verdict) : text;
}

}  // namespace

std::vector<std::string> rehearsal_lines(const Rehearsal& r) {
  std::vector<std::string> lines;
  int failed = 0;
  for (const RehearsedTruth truth : kTruths) {
    const RehearsalCount count = r.count(truth);
    failed += count.failed;
    if (count.logs > 0) lines.push_back(line_of(truth, count));
  }
  if (failed > 0) lines.push_back(fmt::format("{} rehearsals failed; they count as not right", failed));
  return lines;
}

Json rehearsal_json(const Diagnosis& d, const Rehearsal& r) {
  Json all = {{"seed", r.seed}, {"right_if_certain", rounded_to_decimals(r.right_if_certain(), 3)}};
  all["effects"] = Json::array();
  for (const NamedEffect& e : d.effects) {
    all["effects"].push_back(place_json(e.effect));
    all["effects"].back()["probability"] = rounded_to_decimals(r.calibrated(e.probability), 3);
  }
  for (const RehearsedTruth truth : kTruths) all[word(truth)] = count_json(r.count(truth));
  all["logs"] = Json::array();
  for (const RehearsedLog& log : r.logs) all["logs"].push_back(log_json(log));
  return all;
}

void add_rehearsal(report::Page& page, const Diagnosis& d, const Rehearsal& r) {
  page.heading("Rehearsals: how often is such a diagnosis right?");
  page.paragraph(
      "Logs with the motion, the sensors and the noise of the real ones, but with effects that are known, were "
      "diagnosed "
      "as the real ones were.");
  for (const std::string& line : rehearsal_lines(r)) page.paragraph(line + ".");
  for (const NamedEffect& e : d.effects)
    page.paragraph(fmt::format("With these rehearsals, {} has a probability of {}.", label_of(e),
                               percent(r.calibrated(e.probability))));
  report::Table table;
  table.caption = "The rehearsals";
  table.header = {"", "what the arm had", "what the diagnosis named", "right"};
  table.align = {report::Align::right, report::Align::left, report::Align::left, report::Align::left};
  for (std::size_t i = 0; i < r.logs.size(); ++i)
    table.rows.push_back(
        {fmt::format("{}", i + 1), hidden_text(r.logs[i]), names_text(r.logs[i]), r.logs[i].is_right() ? "yes" : "no"});
  page.table(table);
}

}  // namespace halyard
