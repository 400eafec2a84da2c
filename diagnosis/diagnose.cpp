#include "diagnosis/diagnose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "diagnosis/signature.h"

namespace halyard {
namespace {

constexpr double kTwoSided95 = 1.959964;

PredictionError errors(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions, int n) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PredictionError e{std::vector<double>(n, nan), std::vector<double>(n, nan), std::vector<double>(n, nan)};
  for (int k = 0; k < n; ++k) {
    double joint = 0, joints = 0, peak = 0, torque = 0, torques = 0;
    for (std::size_t r = 0; r < records.size(); ++r) {
      for (std::size_t i = 0; i < records[r].size; ++i) {
        if (records[r].has_joint(k) && records[r].joint_valid[k][i] > 0) {
          const double d = records[r].joint_raw[k][i] - predictions[r].joint_reading[k][i];
          joint += d * d, joints += 1, peak = std::max(peak, std::abs(d));
        }
        if (records[r].has_torque(k) && records[r].torque_valid[k][i] > 0) {
          const double d = predictions[r].torque_residual[k][i];
          torque += d * d, torques += 1;
        }
      }
    }
    if (joints > 0) e.joint_rms[k] = std::sqrt(joint / joints), e.joint_peak[k] = peak;
    if (torques > 0) e.torque_rms[k] = std::sqrt(torque / torques);
  }
  return e;
}

std::vector<FullPrediction> predict_all(const std::vector<Record>& records, const Hypothesis& h) {
  std::vector<FullPrediction> all;
  for (const Record& r : records) all.push_back(predict_fully(r, h));
  return all;
}

Estimated estimated(const Fit& f, std::size_t i) {
  const FitParameter& p = f.parameters[i];
  const double half = kTwoSided95 * f.std_deviation[i];
  return {p.name, p.unit, f.value[i], f.value[i] - half, f.value[i] + half, p.nominal};
}

/// A refit that is told: the model's number lies far outside its interval. Of some thirty numbers one in a thousand
/// clean diagnoses then shows a refit by chance.
bool is_refit(const Fit& f, std::size_t i) {
  constexpr double kFar = 4;
  return f.parameters[i].effect < 0 && std::abs(f.value[i] - f.parameters[i].nominal) > kFar * f.std_deviation[i];
}

/// Numbers that the data did not move for certain go back to the model's, and the rest is fitted again.
Fit keep_certain_numbers(const Evidence& evidence, const Fit& f, const Score& score) {
  Hypothesis h = f.hypothesis;
  std::vector<FitParameter> kept;
  for (std::size_t i = 0; i < f.parameters.size(); ++i) {
    if (f.parameters[i].effect >= 0 || is_refit(f, i))
      kept.push_back(f.parameters[i]);
    else
      set_parameter(h, f.parameters[i], f.parameters[i].nominal);
  }
  const Fit again = fit(evidence, h, kept, channel_scale(evidence, score.fit_mean_square));
  return again.usable ? again : f;
}

/// Effects whose typical size changes no signal of the training data by more than its floor.
std::vector<NotExcited> not_excited(const Evidence& evidence, const ArmModel& model, const Hypothesis& at) {
  std::vector<NotExcited> all;
  const auto base = evidence.fit_rows({at})[0];
  for (const Effect* effect : effect_library()) {
    for (int joint = effect->is_of_arm() ? -1 : 0; joint < (effect->is_of_arm() ? 0 : model.n()); ++joint) {
      if (joint >= 0 && !effect->applies(model.nominal, joint)) continue;
      Hypothesis with = at;
      with.effects.push_back(place_effect(*effect, model.nominal, joint));
      const auto rows = evidence.fit_rows({with})[0];
      if (rows.empty()) continue;
      std::vector<double> square(evidence.channels(), 0), count(evidence.channels(), 0);
      for (std::size_t r = 0; r < rows.size(); ++r) {
        const int c = evidence.row_channel()[r];
        square[c] += (rows[r] - base[r]) * (rows[r] - base[r]);
        count[c] += 1;
      }
      bool seen = false;
      for (int c = 0; c < evidence.channels(); ++c)
        seen = seen || (count[c] > 0 && std::sqrt(square[c] / count[c]) > evidence.floor()[c]);
      if (!seen) all.push_back({effect->name(), joint, "at its typical size it changes no signal of these data by more than the sensors resolve"});
    }
  }
  return all;
}

}  // namespace

Diagnosis diagnose(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                   const DiagnosisOptions& options, const std::function<void(const std::string&, double)>& progress) {
  std::mutex one_at_a_time;
  const std::function<void(const std::string&, double)> say = [&](const std::string& what, double fraction) {
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    if (progress) progress(what, fraction);
  };
  Diagnosis d;
  std::vector<Record> records;
  const auto append = [&](std::vector<Record>& to, const Log& log) {
    for (Record& r : make_records(log, model, options.record)) to.push_back(std::move(r));
  };
  for (const Log& log : training) {
    if (holdout) {
      append(records, log);
    } else {
      const auto [first, last] = split_log(log, 2.0 / 3);
      append(records, first);
      append(d.holdout_records, last);
    }
  }
  if (holdout) append(d.holdout_records, *holdout);
  d.holdout = holdout ? holdout->source : "last third of the training data";

  const Evidence evidence(std::move(records), model);
  d.attribution = attribute(evidence, model, options.attribution, say);
  say("final fit", 0);
  const std::size_t given = model.effects.size();
  const Fit final_fit = keep_certain_numbers(evidence, d.attribution.final_fit, d.attribution.final_score);
  d.attribution.final_fit = final_fit;
  const Hypothesis& h = final_fit.hypothesis;

  // One sine fits many effects alike: a name taken from it would be a guess.
  std::vector<bool> one_sine(model.n());
  for (int k = 0; k < model.n(); ++k) one_sine[k] = is_one_sinusoid(evidence.records(), k);
  const bool all_one_sine = std::all_of(one_sine.begin(), one_sine.end(), [](bool b) { return b; });

  for (std::size_t e = given; e < h.effects.size() && !all_one_sine; ++e) {
    NamedEffect named{h.effects[e], {}, d.attribution.alternatives[e - given]};
    for (std::size_t i = 0; i < final_fit.parameters.size(); ++i)
      if (final_fit.parameters[i].effect == static_cast<int>(e)) named.parameters.push_back(estimated(final_fit, i));
    d.effects.push_back(std::move(named));
  }
  for (std::size_t i = 0; i < final_fit.parameters.size(); ++i)
    if (is_refit(final_fit, i)) d.refitted.push_back(estimated(final_fit, i));

  const bool would_name = h.effects.size() > given;
  for (int k = 0; k < model.n(); ++k) {
    const bool rest = d.attribution.significant_rest[k] || d.attribution.significant_rest[model.n() + k];
    if (all_one_sine && would_name)
      d.unexplained.push_back({k, "the record is one sine, along which several effects look alike; record other motions or loads"});
    else if (rest)
      d.unexplained.push_back({k, signature(evidence, h, k)});
  }
  d.verdict = !d.effects.empty() ? Diagnosis::Verdict::effects
              : d.unexplained.empty() ? Diagnosis::Verdict::clean : Diagnosis::Verdict::unknown;
  d.not_excited = not_excited(evidence, model, h);

  d.revised = model;
  if (!all_one_sine || !would_name) {
    d.revised.nominal = h.nominal;
    d.revised.effects = h.effects;
  }
  say("hold-out", 0);
  d.holdout_before = predict_all(d.holdout_records, {model.nominal, model.effects});
  d.holdout_after = predict_all(d.holdout_records, {d.revised.nominal, d.revised.effects});
  d.before = errors(d.holdout_records, d.holdout_before, model.n());
  d.after = errors(d.holdout_records, d.holdout_after, model.n());
  return d;
}

}  // namespace halyard
