#include "app/pages/plan_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/pages/diagnosis/place_json.h"
#include "app/report/page.h"
#include "evaluation/joint_unit.h"
#include "evaluation/json.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNamesNothing =
    "Each joint moves along one sine or stands still: a diagnosis would see these effects but name none. Add sines or "
    "moves.";

/// Limits are known to a tenth.
Json number(double value) { return std::isfinite(value) ? Json(rounded_to_digits(value, 4)) : Json(nullptr); }

std::string joint_text(EffectPlace joint) { return joint ? fmt::format("{}", *joint + 1) : "arm"; }

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.2g}{}", value, unit_suffix(unit));
}

std::string limit_text(const DetectionLimit& d) {
  const std::string size = fmt::format("{} {}", d.parameter, with_unit(d.limit, d.unit));
  return d.excited ? size : "not excited up to " + size;
}

std::string confused_text(const DetectionLimit& d) {
  std::string text;
  for (const PlacedEffect& e : d.confused_with) text += (text.empty() ? "" : ", ") + effect_label(e);
  return text;
}

std::string naming_text(const DetectionLimit& d) {
  return d.naming_limit ? with_unit(*d.naming_limit, d.unit) : d.excited ? "never" : "";
}

/// "|cos| 0.97, not told apart", and a line for each effect.
std::string separation_text(const Separation& s) {
  std::string text = fmt::format("|cos| {:.3f}, {}\n", s.cosine, s.told_apart ? "told apart" : "not told apart");
  for (const DetectionLimit* d : {&s.first, &s.second})
    text += fmt::format("  {} {}{}\n", effect_label(d->effect), d->excited ? "from " : "", limit_text(*d));
  return text;
}

std::string pair_text(const SeparatingMotion& m) { return effect_label(m.first) + " and " + effect_label(m.second); }

Json limit_json(const DetectionLimit& d, const ArmModel& model) {
  Json json = place_json(d.effect), shapes = Json::object(), confused = Json::array();
  const auto parameters = d.effect.effect->parameters(model.nominal, d.effect.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].is_shape())
      shapes[parameters[i].name] = {{"value", number(d.effect.p[i])}, {"unit", parameters[i].unit}};
  for (const PlacedEffect& e : d.confused_with) confused.push_back(place_json(e));
  json["excited"] = d.excited;
  json["parameter"] = d.parameter;
  json[d.excited ? "limit" : "largest"] = {{"value", number(d.limit)}, {"unit", d.unit}};
  json["neutral"] = number(d.neutral);
  json["naming_limit"] = d.naming_limit ? Json{{"value", number(*d.naming_limit)}, {"unit", d.unit}} : Json(nullptr);
  json["shapes"] = shapes;
  json["confused_with"] = confused;
  return json;
}

Json separation_json(const Separation& s, const ArmModel& model) {
  return {{"cosine", number(s.cosine)},
          {"told_apart", s.told_apart},
          {"limits", Json::array({limit_json(s.first, model), limit_json(s.second, model)})}};
}

/// Joint positions of the given motion and of the proposed one.
std::vector<report::Chart> motion_charts(const Plan& plan) {
  std::vector<report::Chart> charts;
  const std::vector<JointUnit> units = joint_units(plan.model);
  for (int k = 0; k < plan.model.n(); ++k) {
    report::Chart chart{.title = fmt::format("Joint {}", k + 1),
                        .x_label = "time [s]",
                        .y_label = fmt::format("joint position [{}]", units[k].shown)};
    const auto add = [&](const char* name, const Log& log) {
      report::Series series{.name = name, .x = log.time, .y = log.joint_position[k]};
      for (double& y : series.y) y *= units[k].shown_per_si;
      chart.series.push_back(std::move(series));
    };
    if (plan.log.has_joint_position(k)) add("given motion", plan.log);
    if (plan.separating && plan.separating->scenario && plan.separating->log.has_joint_position(k))
      add("proposed motion", plan.separating->log);
    if (!chart.series.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

void add_separation(report::Page& page, const SeparatingMotion& m) {
  page.heading("A motion that separates " + pair_text(m));
  page.verdict(m.scenario ? report::VerdictKind::good : report::VerdictKind::warning,
               m.scenario ? fmt::format("The motion of scenario.xml: |cos| {:.3f} instead of {:.3f}.",
                                        m.proposed.cosine, m.given.cosine)
                          : fmt::format("None of {} motions separates them better than the given one, |cos| {:.3f}.",
                                        m.tried, m.given.cosine));
  report::Table table;
  table.header = {"motion", "|cos|", "told apart", effect_label(m.first) + " from", effect_label(m.second) + " from"};
  table.align = {report::Align::left, report::Align::right, report::Align::left, report::Align::right,
                 report::Align::right};
  const auto add = [&](const char* name, const Separation& s) {
    table.rows.push_back({name, fmt::format("{:.3f}", s.cosine), s.told_apart ? "yes" : "no", limit_text(s.first),
                          limit_text(s.second)});
  };
  add("given", m.given);
  if (m.scenario) add("proposed", m.proposed);
  page.table(table);
}

report::Page plan_page(const Plan& plan) {
  report::Page page("Plan: what a diagnosis will see",
                    fmt::format("model {}, motion of {}{}", plan.model.source, plan.scenario,
                                plan.joint_sensor ? "" : ", no sensor at the joints"));
  page.paragraph(
      "The arm was simulated without any effect, as the model describes it. A diagnosis of this motion would see an "
      "effect whose size is farther from its value without the effect (0, or 1 for ratios and scales) than the "
      "detection limit: it then changes a signal by significantly more than its sensor resolves, and by more than "
      "the model's numbers can absorb within their tolerances. Beyond the naming limit, no other effect explains the "
      "same data about as well. The last column lists the effects that do so at twice the detection limit. Of several "
      "sizes of an effect, only the one that its limit names was varied: gravity that tilts about the other axis, for "
      "example, may be seen earlier or later.");
  if (plan.names_nothing) page.verdict(report::VerdictKind::warning, kNamesNothing);
  report::Table table;
  table.header = {"effect", "joint", "detection limit", "naming limit", "not distinguishable from"};
  table.align = {report::Align::left, report::Align::right, report::Align::left, report::Align::left,
                 report::Align::left};
  for (const DetectionLimit& d : plan.limits)
    table.rows.push_back(
        {d.effect.effect->name(), joint_text(d.effect.joint), limit_text(d), naming_text(d), confused_text(d)});
  page.table(table);
  if (plan.separating) add_separation(page, *plan.separating);
  if (const auto charts = motion_charts(plan); !charts.empty()) {
    page.heading("Motion");
    page.figure_row(charts);
  }
  return page;
}

}  // namespace

std::string plan_text(const Plan& plan) {
  std::vector<std::array<std::string, 5>> rows = {{"effect", "joint", "detection limit", "naming limit",
                                                   "not distinguishable, at twice the detection limit, from"}};
  for (const DetectionLimit& d : plan.limits)
    rows.push_back(
        {d.effect.effect->name(), joint_text(d.effect.joint), limit_text(d), naming_text(d), confused_text(d)});
  std::array<std::size_t, 4> width{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < width.size(); ++i) width[i] = std::max(width[i], row[i].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < width.size(); ++i) line += fmt::format("{:<{}}  ", row[i], width[i]);
    line += row.back();
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  text +=
      "A diagnosis would see an effect whose size is farther from its value without the effect (0, or 1 for ratios and "
      "scales)\nthan the detection limit, and name it beyond the naming limit.\n";
  if (plan.names_nothing) text += fmt::format("{}\n", kNamesNothing);
  if (!plan.separating) return text;
  const SeparatingMotion& m = *plan.separating;
  text += fmt::format("{}, given motion: {}", pair_text(m), separation_text(m.given));
  text += m.scenario ? fmt::format("{}, proposed motion: {}", pair_text(m), separation_text(m.proposed))
                     : fmt::format("none of {} motions separates them better\n", m.tried);
  return text;
}

std::string plan_json(const Plan& plan) {
  Json limits = Json::array();
  for (const DetectionLimit& d : plan.limits) limits.push_back(limit_json(d, plan.model));
  Json all = {{"model", plan.model.source},
              {"scenario", plan.scenario},
              {"joint_sensor", plan.joint_sensor},
              {"names_nothing", plan.names_nothing},
              {"limits", limits}};
  if (plan.separating) {
    const SeparatingMotion& m = *plan.separating;
    all["separation"] = {{"effects", Json::array({place_json(m.first), place_json(m.second)})},
                         {"given", separation_json(m.given, plan.model)},
                         {"proposed", m.scenario ? separation_json(m.proposed, plan.model) : Json(nullptr)}};
  }
  return json_text(all);
}

void write_plan(OutputFiles& files, const std::filesystem::path& folder, const Plan& plan) {
  namespace fs = std::filesystem;
  if (plan.separating && plan.separating->scenario) {
    files.add(folder / "scenario.xml", scenario_xml(*plan.separating->scenario, plan.model.source, folder));
  } else if (fs::exists(folder / "plan.json")) {
    files.remove(folder / "scenario.xml");  // the proposal of an earlier plan
  }
  files.add(folder / "plan.json", plan_json(plan));
  files.add(folder / "plan.html", plan_page(plan).html());
}

}  // namespace halyard
