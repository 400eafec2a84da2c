#include "app/diagnosis_output.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/joint_unit.h"
#include "model/model_file.h"
#include "model/output_file.h"

namespace halyard {
namespace {

using Json = nlohmann::ordered_json;

/// Nine digits are more than any estimate carries, and the same on every run.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.9g}", value));
}

Json numbers(const std::vector<double>& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number(v));
  return all;
}

Json joint_of(int joint) { return joint < 0 ? Json(nullptr) : Json(joint + 1); }

Json before_after(const std::vector<double>& before, const std::vector<double>& after) {
  return {{"before", numbers(before)}, {"after", numbers(after)}};
}

const char* verdict_word(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::clean: return "clean";
    case Diagnosis::Verdict::effects: return "effects";
    case Diagnosis::Verdict::unknown: break;
  }
  return "unknown";
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  Json effects = Json::array(), refitted = Json::array(), unexplained = Json::array(), not_excited = Json::array();
  for (const NamedEffect& e : d.effects) {
    Json alternatives = Json::array(), parameters = Json::object();
    for (const PlacedEffect& a : e.alternatives)
      alternatives.push_back({{"effect", a.effect->name()}, {"joint", joint_of(a.joint)}});
    for (const Estimated& p : e.parameters)
      parameters[p.name] = {{"value", number(p.value)}, {"unit", p.unit}, {"ci95", numbers({p.lower, p.upper})}};
    effects.push_back({{"effect", e.effect.effect->name()},
                       {"joint", joint_of(e.effect.joint)},
                       {"alternatives", alternatives},
                       {"parameters", parameters}});
  }
  for (const Estimated& p : d.refitted)
    refitted.push_back({{"parameter", p.name}, {"from", number(p.nominal)}, {"to", number(p.value)}, {"unit", p.unit},
                        {"ci95", numbers({p.lower, p.upper})}});
  for (const Unexplained& u : d.unexplained) unexplained.push_back({{"joint", u.joint + 1}, {"signature", u.signature}});
  for (const NotExcited& n : d.not_excited)
    not_excited.push_back({{"effect", n.effect}, {"joint", joint_of(n.joint)}, {"why", n.why}});
  const Json all = {{"verdict", verdict_word(d.verdict)},
                    {"effects", effects},
                    {"refitted", refitted},
                    {"unexplained", unexplained},
                    {"not_excited", not_excited},
                    {"error",
                     {{"holdout", d.holdout},
                      {"joint_position_rms", before_after(d.before.joint_rms, d.after.joint_rms)},
                      {"joint_position_peak", before_after(d.before.joint_peak, d.after.joint_peak)},
                      {"motor_torque_rms", before_after(d.before.torque_rms, d.after.torque_rms)}}}};
  return all.dump(2) + "\n";
}

std::string effect_label(const PlacedEffect& effect) {
  return effect.effect->name() + (effect.joint < 0 ? "" : fmt::format(" of joint {}", effect.joint + 1));
}

std::string verdict_line(const Diagnosis& d) {
  std::string line = verdict_word(d.verdict);
  for (std::size_t i = 0; i < d.effects.size(); ++i) line += (i == 0 ? ": " : ", ") + effect_label(d.effects[i].effect);
  if (d.verdict == Diagnosis::Verdict::effects && !d.unexplained.empty()) line += ", and an unexplained rest";
  return line;
}

void add_verdict(report::Page& page, const Diagnosis& d) {
  switch (d.verdict) {
    case Diagnosis::Verdict::clean:
      page.verdict(report::VerdictKind::good, "Clean: the model explains the data to what its sensors resolve.");
      break;
    case Diagnosis::Verdict::unknown: {
      std::string text = "Unknown: a residual that matters is left, and no candidate explains it.";
      for (const Unexplained& u : d.unexplained) text += fmt::format("\nJoint {}: {}.", u.joint + 1, u.signature);
      page.verdict(report::VerdictKind::bad, text);
      break;
    }
    case Diagnosis::Verdict::effects: {
      std::string text = "The model lacks:";
      for (const NamedEffect& e : d.effects) {
        text += "\n" + effect_label(e.effect) + ": " + e.effect.effect->summary() + ".";
        for (std::size_t i = 0; i < e.alternatives.size(); ++i)
          text += (i == 0 ? " These data cannot tell it from " : ", ") + effect_label(e.alternatives[i]);
        if (!e.alternatives.empty()) text += ".";
      }
      for (const Unexplained& u : d.unexplained) text += fmt::format("\nLeft unexplained, joint {}: {}.", u.joint + 1, u.signature);
      page.verdict(report::VerdictKind::warning, text);
      break;
    }
  }
}

void add_error_table(report::Page& page, const Diagnosis& d) {
  const std::vector<JointUnit> units = joint_units(d.revised);
  report::Table table;
  table.caption = "Error on the hold-out (" + d.holdout + "), which no decision has seen";
  table.header = {"joint", "position RMS before", "after", "position peak before", "after", "torque RMS before [N\u00a0m]", "after [N\u00a0m]"};
  const auto cell = [](double v, double scale, const std::string& unit) {
    return std::isfinite(v) ? fmt::format("{:.4g}{}", v * scale, unit.empty() ? "" : " " + unit) : std::string("no sensor");
  };
  for (int k = 0; k < d.revised.n(); ++k) {
    const JointUnit& u = units[k];
    const auto better = [](double before, double after) { return std::isfinite(after) && after < 0.9 * before; };
    table.rows.push_back({fmt::format("{}", k + 1), cell(d.before.joint_rms[k], u.shown_per_si, u.shown),
                          {cell(d.after.joint_rms[k], u.shown_per_si, u.shown), better(d.before.joint_rms[k], d.after.joint_rms[k])},
                          cell(d.before.joint_peak[k], u.shown_per_si, u.shown),
                          {cell(d.after.joint_peak[k], u.shown_per_si, u.shown), better(d.before.joint_peak[k], d.after.joint_peak[k])},
                          cell(d.before.torque_rms[k], 1, ""),
                          {cell(d.after.torque_rms[k], 1, ""), better(d.before.torque_rms[k], d.after.torque_rms[k])}});
  }
  page.table(table);
}

void write_diagnosis(const std::filesystem::path& folder, const ArmModel& model, const Diagnosis& d) {
  const bool given = d.effects.empty() && d.refitted.empty();
  write_file_whole(folder / "model.xml", model_to_xml(given ? model : d.revised));
  write_file_whole(folder / "diagnosis.json", diagnosis_json(d));
  diagnosis_page(model, d).write(folder / "report.html");
}

}  // namespace halyard
