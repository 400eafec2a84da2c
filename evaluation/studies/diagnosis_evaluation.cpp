#include "evaluation/studies/diagnosis_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "diagnosis/diagnosis_details.h"
#include "diagnosis/explanation/view_sentence.h"
#include "diagnosis/log_check/own_readings.h"
#include "evaluation/studies/diagnosis_evidence.h"
#include "model/machine/first_failure.h"

namespace halyard {
namespace {

constexpr std::array kEstimators = {"kinematics", "ekf", "sr_ukf"};

EffectEvidence evidence_of(const std::vector<Record>& records, const Hypothesis& without, const Hypothesis& with,
                           const std::vector<FullPrediction>& predicted_with, EffectPlace joint) {
  const std::vector<FullPrediction> predicted_without = predict_all(records, without);
  // An effect of a joint that moves shows at that joint first, one of the arm anywhere.
  EffectEvidence best;
  double most = -1;
  for (int k = 0; k < with.nominal.n; ++k) {
    if (joint && k != *joint) continue;
    EffectEvidence e{k,
                     residual_signals(records, predicted_without, without, k),
                     residual_signals(records, predicted_with, with, k),
                     {}};
    e.views = telling_views(e.without, e.with);
    const double share = e.views.empty() ? 0 : e.views.front().removed();
    if (share > most) most = share, best = std::move(e);
  }
  return best;
}

std::string shown_parameter(const Estimated& p) {
  std::string name = p.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const ShownUnit unit = p.unit == "m"     ? ShownUnit{"mm", 1e3}
                         : p.unit == "rad" ? ShownUnit{"deg", 180 / std::numbers::pi}
                         : p.unit == "1"   ? ShownUnit{"", 1}
                                           : ShownUnit{p.unit, 1};
  return name + " " + shown(p.value, unit);
}

std::string why_named(const NamedEffect& named, const EffectEvidence& evidence, const ArmParameters<double>& arm) {
  std::string text;
  if (evidence.views.empty()) {
    text =
        "No residual lies on a curve over direction, position, speed, load or time more clearly than chance could make "
        "it, "
        "so no single picture tells this effect: it is preferred because the fit as a whole improves.";
  } else {
    const View& v = evidence.views.front();
    text = fmt::format("Without it the {} of joint {} {}", residual_name(arm, evidence.joint, v.residual),
                       evidence.joint + 1, view_phrase(v, arm, evidence.joint));
    // A constant alone says little of what makes it.
    if (v.abscissa == Abscissa::constant && evidence.views.size() > 1 && evidence.views[1].residual == v.residual)
      text += "; beyond that it " + view_phrase(evidence.views[1], arm, evidence.joint);
    text += "; with the effect";
    std::string numbers;
    for (const Estimated& p : named.parameters)
      if (!p.is_reset) numbers += (numbers.empty() ? "" : ", ") + shown_parameter(p);
    if (!numbers.empty()) text += " (" + numbers + ")";
    text += fmt::format(" {} of the mean square is left.", shown_share(v.left));
  }
  return text + alternatives_sentence(named);
}

/// What speaks for each effect and each rest, on the records that the diagnosis learnt from.
DiagnosisEvidence evidence_for(const Diagnosis& d) {
  const std::vector<Record>& records = d.details->training;
  const Hypothesis& revised = d.details->attribution.final_fit.hypothesis;
  const std::vector<FullPrediction> predicted = predict_all(records, revised);
  DiagnosisEvidence evidence;
  for (const NamedEffect& named : d.effects) {
    const Hypothesis without = without_effect(revised, named.index);
    evidence.effects.push_back(evidence_of(records, without, revised, predicted, named.effect.joint));
  }
  for (const Unexplained& u : d.unexplained) {
    EffectEvidence rest{u.joint, residual_signals(records, predicted, revised, u.joint), {}, {}};
    rest.views = telling_views(rest.without);
    rest.with = rest.without;
    evidence.unexplained.push_back(std::move(rest));
  }
  return evidence;
}

/// Every estimator with the given and with the revised model, in parallel; none without a joint sensor.
std::vector<EstimatorComparison> compare_on(const std::vector<HeldOutLog>& held_out, const Diagnosis& d,
                                            const std::function<void(const std::string&, double)>& progress,
                                            const ContainmentOptions& containment) {
  const bool sensed = std::any_of(held_out.begin(), held_out.end(), [](const HeldOutLog& h) {
    return std::any_of(h.log->joint_position.begin(), h.log->joint_position.end(),
                       [](const auto& column) { return !column.empty(); });
  });
  if (!sensed) return {};
  std::vector<EstimatorComparison> all(kEstimators.size());
  std::mutex mutex;
  std::size_t done = 0;
  for_each_in_parallel(2 * kEstimators.size(), [&](std::size_t job) {
    EstimatorComparison& of = all[job / 2];
    const bool after = job % 2 == 1;
    EstimatorErrors errors =
        errors_of(kEstimators[job / 2], after ? d.revised_on_holdout() : d.given, held_out, containment);
    const std::lock_guard lock(mutex);
    of.name = kEstimators[job / 2];
    (after ? of.after : of.before) = std::move(errors);
    ++done;
    if (progress) progress("estimators on the hold-out", static_cast<double>(done) / (2 * kEstimators.size()));
  });
  return all;
}

}  // namespace

std::string alternatives_sentence(const NamedEffect& effect) {
  std::string names;
  for (const Alternative& a : effect.alternatives)
    if (a.in_set) names += (names.empty() ? "" : ", ") + effect_label(a.effect);
  return names.empty() ? "" : " These data cannot tell it from " + names + ".";
}

DiagnosisEvaluation evaluate_diagnosis(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
                                       const std::optional<Log>& holdout,
                                       const std::function<void(const std::string&, double)>& progress,
                                       const ContainmentOptions& containment) {
  std::vector<Log> logs;
  if (holdout) logs.push_back(usable_readings(*holdout, model));
  else
    for (const Log& log : training) logs.push_back(usable_readings(log, model));
  std::vector<HeldOutLog> held_out;
  for (const Log& log : logs)
    held_out.push_back({&log, holdout ? log.time.front() : split_log(log, kTrainingShare).second.time.front()});

  DiagnosisEvaluation result;
  if (progress) progress("residuals that point", 0);
  const auto evidence = std::make_shared<DiagnosisEvidence>(evidence_for(d));
  result.evidence = evidence;
  for (std::size_t i = 0; i < d.effects.size(); ++i)
    result.why.push_back(why_named(d.effects[i], evidence->effects[i], d.revised.nominal));
  result.estimators = compare_on(held_out, d, progress, containment);
  return result;
}

}  // namespace halyard
