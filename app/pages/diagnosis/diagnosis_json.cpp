#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/pages/diagnosis/place_json.h"
#include "app/pages/diagnosis/rehearsal_output.h"
#include "evaluation/json.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

using Json = nlohmann::ordered_json;

/// Nine digits are more than any estimate carries, and the same on every run.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return rounded_to_digits(value, 9);
}

Json numbers(const std::vector<double>& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number(v));
  return all;
}

/// Three digits are more than a probability deserves.
Json probability(double value) { return rounded_to_decimals(value, 3); }

Json interval_of(const Estimated& e) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return e.is_whole ? numbers({kNone, kNone}) : numbers({e.lower, e.upper});
}

Json before_after(const std::vector<double>& before, const std::vector<double>& after) {
  return {{"before", numbers(before)}, {"after", numbers(after)}};
}

/// Errors on the hold-out and the intervals of the predicted joint positions.
Json error_json(const Diagnosis& d) {
  const PredictionError &b = d.before, &a = d.after;
  Json absent = Json::array();
  for (const std::size_t e : d.absent_events) absent.push_back(effect_label(d.revised.effects[e]));
  Json error = {{"holdout", d.holdout},
                {"events_absent_from_holdout", absent},
                {"joint_position_rms", before_after(b.joint_rms, a.joint_rms)},
                {"joint_position_peak", before_after(b.joint_peak, a.joint_peak)},
                {"motor_torque_rms", before_after(b.torque_rms, a.torque_rms)}};
  const auto add_parts = [&error](const std::string& signal, const ErrorParts& before, const ErrorParts& after) {
    error[signal + "_bias"] = before_after(before.bias, after.bias);
    error[signal + "_spread"] = before_after(before.spread, after.spread);
    error[signal + "_rms_moving"] = before_after(before.moving_rms, after.moving_rms);
    error[signal + "_rms_resting"] = before_after(before.resting_rms, after.resting_rms);
  };
  add_parts("joint_position", b.joint, a.joint);
  add_parts("motor_torque", b.torque, a.torque);
  error["joint_position_interval95"] = {{"half_width", numbers(d.joint_interval.half_width)},
                                        {"coverage", numbers(d.joint_interval.coverage)}};
  return error;
}

/// {"joint_position_rms": {"before": [...], "after": [...]}, ...} of each estimator; null where it failed.
Json estimators_json(const DiagnosisEvaluation& evaluation) {
  const auto of = [](const std::vector<double>& values) { return values.empty() ? Json(nullptr) : numbers(values); };
  Json all = Json::object();
  for (const EstimatorComparison& e : evaluation.estimators)
    all[e.name] = {{"joint_position_rms", {{"before", of(e.before.rms)}, {"after", of(e.after.rms)}}},
                   {"joint_position_peak", {{"before", of(e.before.peak)}, {"after", of(e.after.peak)}}}};
  return all;
}

/// What is told of an effect, with a sure name or without.
Json effect_json(const NamedEffect& e) {
  Json alternatives = Json::array(), parameters = Json::object();
  for (const Alternative& a : e.alternatives)
    alternatives.push_back({{"effect", a.effect.effect->name()},
                            {"joint", joint_json(a.effect.joint)},
                            {"probability", probability(a.probability)},
                            {"in_set", a.in_set}});
  for (const Estimated& p : e.parameters)
    parameters[p.name] = {
        {"value", number(p.value)}, {"unit", p.unit}, {"ci95", interval_of(p)}, {"at_bound", p.at_bound}};
  Json effect = {{"effect", e.effect.effect->name()},
                 {"joint", joint_json(e.effect.joint)},
                 {"probability", probability(e.probability)},
                 {"in_set", e.in_set},
                 {"alternatives", alternatives},
                 {"parameters", parameters}};
  if (!e.log.empty()) effect["log"] = e.log;
  return effect;
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  Json effects = Json::array(), refitted = Json::array(), unexplained = Json::array(), not_excited = Json::array();
  for (std::size_t i = 0; i < d.effects.size(); ++i) {
    effects.push_back(effect_json(d.effects[i]));
    if (i < evaluation.why.size()) effects.back()["why"] = evaluation.why[i];
  }
  for (const Estimated& p : d.refitted)
    refitted.push_back({{"parameter", p.name},
                        {"from", number(p.nominal)},
                        {"to", number(p.value)},
                        {"unit", p.unit},
                        {"ci95", interval_of(p)},
                        {"at_bound", p.at_bound}});
  for (const Unexplained& u : d.unexplained) {
    unexplained.push_back({{"joint", u.joint + 1}, {"signature", u.signature}});
    if (u.effect) unexplained.back()["unnamed_effect"] = effect_json(*u.effect);
  }
  for (const NotExcited& n : d.not_excited)
    not_excited.push_back({{"effect", n.effect}, {"joint", joint_json(n.joint)}, {"why", n.why}});
  Json log_check = Json::array();
  for (const LogFinding& f : d.log_findings)
    log_check.push_back({{"log", f.log},
                         {"column", f.column},
                         {"what", f.what},
                         {"remedy", f.remedy},
                         {"severity", severity_word(f.severity)}});
  Json all = {{"verdict", verdict_word(d.verdict)},
              {"effects", effects},
              {"refitted", refitted},
              {"tolerance_factor", number(d.tolerance_factor)},
              {"probability_clean", probability(d.probability_clean)},
              {"probability_none", probability(d.probability_none)},
              {"unexplained", unexplained},
              {"not_excited", not_excited},
              {"log_check", log_check},
              {"error", error_json(d)},
              {"estimators", estimators_json(evaluation)}};
  if (evaluation.rehearsals) all["rehearsals"] = rehearsals_json(d, *evaluation.rehearsals);
  return json_text(all);
}

}  // namespace halyard
