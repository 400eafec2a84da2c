#include "evaluation/studies/diagnosis_evaluation.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include "evaluation/judgement/error_statistics.h"
#include "evaluation/run/contained_run.h"
#include "evaluation/run/sensor_readings.h"

namespace halyard {
namespace {

constexpr std::array kEstimators = {"kinematics", "ekf", "sr_ukf"};
constexpr double kSkip = 0.5;  ///< s; a filter's start is not counted

}  // namespace

EstimatorErrors errors_of(const std::string& name, const ArmModel& model, const std::vector<HeldOutLog>& logs) {
  const auto n = static_cast<std::size_t>(model.n());
  EstimatorErrors result;
  result.innovation.resize(n);
  result.joint_rate.resize(n);
  Signals estimate(n), truth(n);
  try {
    for (const auto& [held, from] : logs) {
      const Log& log = *held;
      const EstimatorRun run = run_contained(name, model, log, {.use_joint_torque = true});
      const Signals readings = sensor_readings(model, run);
      const std::size_t first = first_counted_sample(log.time, std::max(kSkip, from - log.time.front()));
      const auto append = [first](const std::vector<double>& from, std::vector<double>& to) {
        to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
      };
      append(log.time, result.time);
      for (std::size_t k = 0; k < n; ++k) {
        append(run.innovation[k], result.innovation[k]);
        append(run.estimates.joint_velocity[k], result.joint_rate[k]);
        if (log.joint_position[k].empty()) continue;
        append(readings[k], estimate[k]);
        append(log.joint_position[k], truth[k]);
      }
      result.mean_nis += mean_of(run.nis) / static_cast<double>(logs.size());
    }
  } catch (const std::exception& e) {
    EstimatorErrors failed;
    failed.failure = e.what();
    return failed;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const ErrorStatistics error = error_statistics(estimate[k], truth[k]);
    result.rms.push_back(error.rms);
    result.peak.push_back(error.peak);
  }
  return result;
}

namespace {

EffectEvidence evidence_of(const std::vector<Record>& records, const Hypothesis& without, const Hypothesis& with,
                           const std::vector<FullPrediction>& predicted_with, int joint) {
  std::vector<FullPrediction> predicted_without;
  for (const Record& r : records) predicted_without.push_back(predict_fully(r, without));
  // An effect of a joint that moves shows at that joint first, one of the arm anywhere.
  EffectEvidence best;
  double most = -1;
  for (int k = 0; k < with.nominal.n; ++k) {
    if (joint >= 0 && k != joint) continue;
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

}  // namespace

DiagnosisEvaluation evaluate_diagnosis(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
                                       const std::optional<Log>& holdout,
                                       const std::function<void(const std::string&, double)>& progress) {
  const DiagnosisOptions options;
  std::vector<Record> records;
  std::vector<HeldOutLog> held_out;
  for (const Log& log : training) {
    const auto [first, last] = split_log(log, 2.0 / 3);
    for (Record& r : make_records(holdout ? log : first, model, options.record)) records.push_back(std::move(r));
    if (!holdout) held_out.push_back({&log, last.time.front()});
  }
  if (holdout) held_out.push_back({&*holdout, holdout->time.front()});

  DiagnosisEvaluation result;
  if (progress) progress("residuals that point", 0);
  const Hypothesis revised{d.revised.nominal, d.revised.effects, d.past};
  for (std::size_t r = 0; r < records.size(); ++r) records[r].place = static_cast<int>(r);
  std::vector<FullPrediction> predicted;
  for (const Record& r : records) predicted.push_back(predict_fully(r, revised));
  for (std::size_t i = 0; i < d.effects.size(); ++i) {
    const Hypothesis without = without_effect(revised, model.effects.size() + i);
    result.effects.push_back(evidence_of(records, without, revised, predicted, d.effects[i].effect.joint));
  }
  for (const Unexplained& u : d.unexplained) {
    EffectEvidence rest{u.joint, residual_signals(records, predicted, revised, u.joint), {}, {}};
    rest.views = telling_views(rest.without);
    rest.with = rest.without;
    result.unexplained.push_back(std::move(rest));
  }

  const bool sensed = std::any_of(held_out.begin(), held_out.end(), [](const HeldOutLog& h) {
    return std::any_of(h.log->joint_position.begin(), h.log->joint_position.end(),
                       [](const auto& column) { return !column.empty(); });
  });
  if (!sensed) return result;
  result.estimators.resize(kEstimators.size());
  std::mutex mutex;
  std::size_t done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, 2 * kEstimators.size(), [&](std::size_t job) {
    EstimatorComparison& of = result.estimators[job / 2];
    const bool after = job % 2 == 1;
    EstimatorErrors errors = errors_of(kEstimators[job / 2], after ? d.revised : d.given, held_out);
    const std::lock_guard lock(mutex);
    of.name = kEstimators[job / 2];
    (after ? of.after : of.before) = std::move(errors);
    ++done;
    if (progress) progress("estimators on the hold-out", static_cast<double>(done) / (2 * kEstimators.size()));
  });
  return result;
}

std::string alternatives_sentence(const NamedEffect& effect) {
  if (effect.alternatives.empty()) return "";
  std::string text = " These data cannot tell it from ";
  for (std::size_t i = 0; i < effect.alternatives.size(); ++i)
    text += (i == 0 ? "" : ", ") + effect_label(effect.alternatives[i]);
  return text + ".";
}

std::string why_named(const Diagnosis& d, const DiagnosisEvaluation& evaluation, std::size_t i) {
  const NamedEffect& named = d.effects[i];
  const EffectEvidence& evidence = evaluation.effects[i];
  const ArmParameters<double>& arm = d.revised.nominal;
  std::string text;
  if (evidence.views.empty()) {
    text = "No single view tells it; the candidates were weighed by all residuals together.";
  } else {
    const View& v = evidence.views.front();
    text = fmt::format("Without it the {} of joint {} {}", residual_name(arm, evidence.joint, v.residual),
                       evidence.joint + 1, view_phrase(v, arm, evidence.joint));
    // A constant alone says little of what makes it.
    if (v.abscissa == Abscissa::constant && evidence.views.size() > 1 && evidence.views[1].residual == v.residual)
      text += "; beyond that it " + view_phrase(evidence.views[1], arm, evidence.joint);
    text += "; with the effect";
    for (std::size_t p = 0; p < named.parameters.size(); ++p)
      text +=
          (p == 0 ? " (" : ", ") + shown_parameter(named.parameters[p]) + (p + 1 == named.parameters.size() ? ")" : "");
    text += fmt::format(" {} of the mean square is left.", shown_share(v.left));
  }
  return text + alternatives_sentence(named);
}

}  // namespace halyard
