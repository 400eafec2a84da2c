#include "diagnosis/diagnose.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "diagnosis/diagnosis_details.h"
#include "diagnosis/explanation/signature.h"
#include "diagnosis/prediction/calibrate.h"

namespace halyard {
namespace {

constexpr double kTwoSided95 = 1.959964;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Root mean square and peak of what sample(record, prediction, i) gives, where it is not NaN.
template <class Sample>
std::pair<double, double> size_of(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions,
                                  const Sample& sample) {
  double square = 0, count = 0, peak = 0;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t i = 0; i < records[r].size; ++i) {
      const double e = sample(records[r], predictions[r], i);
      if (std::isnan(e)) continue;
      square += e * e, count += 1, peak = std::max(peak, std::abs(e));
    }
  return count > 0 ? std::pair(std::sqrt(square / count), peak) : std::pair(kNone, kNone);
}

PredictionError errors(const HoldOut& joints, const HoldOut& torques, int n,
                       std::vector<FullPrediction> HoldOut::*which) {
  PredictionError e;
  for (int k = 0; k < n; ++k) {
    const auto [joint_rms, joint_peak] =
        size_of(joints.records, joints.*which, [k](const Record& r, const FullPrediction& p, std::size_t i) {
          return r.has_joint(k) && r.joint_valid[k][i] > 0 ? r.joint_raw[k][i] - p.joint_reading[k][i] : kNone;
        });
    const auto [torque_rms, torque_peak] =
        size_of(torques.records, torques.*which, [k](const Record& r, const FullPrediction& p, std::size_t i) {
          return r.has_torque(k) && r.torque_valid[k][i] > 0 ? p.torque_residual[k][i] : kNone;
        });
    e.joint_rms.push_back(joint_rms);
    e.joint_peak.push_back(joint_peak);
    e.torque_rms.push_back(torque_rms);
  }
  return e;
}

/// Takes out what was before a time.
void compare_from(Record& r, double from) {
  for (Signals* valid : {&r.joint_valid, &r.torque_valid})
    for (std::vector<double>& x : *valid)
      for (std::size_t i = 0; i < x.size() && r.time(i) < from; ++i) x[i] = 0;
}

std::vector<FullPrediction> predict_all(const std::vector<Record>& records, const Hypothesis& h) {
  std::vector<FullPrediction> all;
  for (const Record& r : records) all.push_back(predict_fully(r, h));
  return all;
}

Estimated estimated(const Fit& f, std::size_t i) {
  const FitParameter& p = f.parameters[i];
  const double half = kTwoSided95 * f.std_deviation[i];
  // No interval reaches beyond what the number can be.
  return {p.name,   p.unit, f.value[i], std::max(f.value[i] - half, p.lower), std::min(f.value[i] + half, p.upper),
          p.nominal};
}

/// A refit that is told lies so many standard deviations off the model's number. Of some thirty numbers two in a
/// thousand clean diagnoses then show a refit by chance.
constexpr double kRefit = 4;

bool is_refit(const Fit& f, std::size_t i) {
  return f.parameters[i].effect < 0 && std::abs(f.value[i] - f.parameters[i].nominal) > kRefit * f.std_deviation[i];
}

/// Numbers that the data did not move for certain go back to the model's, sizes of an effect to neutral as long as
/// another of its sizes stays; the rest is fitted again. They go one by one, the least certain first: of two numbers
/// that the data know only the sum of, one is needed.
Fit keep_certain_numbers(const Evidence& evidence, const ArmModel& model, const Fit& f, const Score& score) {
  Eigen::VectorXd value = Eigen::Map<const Eigen::VectorXd>(f.value.data(), static_cast<Eigen::Index>(f.value.size()));
  Eigen::MatrixXd covariance = f.covariance;
  std::vector<bool> kept(f.parameters.size(), true);
  const std::vector<ParameterGroup> groups = groups_of(f.parameters);
  const auto ends = [&](std::size_t i) { return ends_at_bound(f.parameters[i], value(i)); };
  /// True of a number at its bound, or shaped by one.
  const auto is_exhausted = [&](std::size_t i) {
    return ends(i) || std::ranges::any_of(groups, [&](const ParameterGroup& group) {
             return std::ranges::count(group.sizes, i) > 0 && std::ranges::any_of(group.shapes, ends);
           });
  };
  const auto may_go = [&](std::size_t i) {
    const FitParameter& p = f.parameters[i];
    if (!kept[i] || p.shape) return false;
    if (p.effect < 0) return !is_unknown_scale(model, p.index);
    for (std::size_t j = 0; j < f.parameters.size(); ++j)
      if (j != i && kept[j] && !f.parameters[j].shape && f.parameters[j].effect == p.effect) return true;
    return false;
  };
  while (true) {
    std::size_t least = f.parameters.size();
    double certainty = 1;
    for (std::size_t i = 0; i < f.parameters.size(); ++i) {
      if (!may_go(i)) continue;
      const double needed = f.parameters[i].effect < 0 ? kRefit : kTwoSided95;
      const FitParameter& p = f.parameters[i];
      const double has = is_exhausted(i) ? 0 : std::abs(value(i) - p.nominal) / (needed * std::sqrt(covariance(i, i)));
      if (has < certainty) certainty = has, least = i;
    }
    if (least == f.parameters.size()) break;
    // The others make up for it as far as they can.
    const Eigen::VectorXd gain = covariance.col(least) / covariance(least, least);
    value -= gain * (value(least) - f.parameters[least].nominal);
    covariance -= gain * covariance.row(least);
    kept[least] = false;
  }
  // Shapes of sizes that are gone shape nothing; the past of an effect that the model came with has no sizes.
  for (const ParameterGroup& group : groups)
    if (!group.sizes.empty() && std::ranges::none_of(group.sizes, [&](std::size_t i) { return kept[i]; }))
      for (const std::size_t i : group.shapes) kept[i] = false;

  Hypothesis h = f.hypothesis;
  std::vector<FitParameter> left;
  for (std::size_t i = 0; i < f.parameters.size(); ++i) {
    const FitParameter& p = f.parameters[i];
    set_parameter(h, p, kept[i] ? std::clamp(value(i), p.lower, p.upper) : p.nominal);
    if (kept[i]) left.push_back(p);
  }
  const Fit again = fit(evidence, h, left, channel_scale(evidence, score.fit_mean_square));
  if (!again.usable) return f;
  bool at_bound = false;
  for (std::size_t i = 0; i < left.size(); ++i)
    at_bound = at_bound || (!left[i].shape && ends_at_bound(left[i], again.value[i]));
  return at_bound && left.size() < f.parameters.size() ? keep_certain_numbers(evidence, model, again, score) : again;
}

/// Effects whose typical size changes no signal of the training data by more than its floor.
std::vector<NotExcited> not_excited(const Evidence& evidence, const ArmModel& model, const Hypothesis& at) {
  const auto base = evidence.fit_rows({at})[0];
  const std::vector<PlacedEffect> candidates = all_candidates(model.nominal);
  std::vector<char> shows(candidates.size(), 1);
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    Hypothesis with = at;
    with.effects.push_back(candidates[i]);
    const auto rows = evidence.fit_rows({with})[0];
    shows[i] = rows.empty() || evidence.exceeds_floor(difference(rows, base), 1);
  });
  std::vector<NotExcited> all;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!shows[i])
      all.push_back({candidates[i].effect->name(), candidates[i].joint,
                     "at its typical size it changes no signal of these data by more than the sensors resolve"});
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
  const auto details = std::make_shared<DiagnosisDetails>();
  d.details = details;
  std::vector<Record> records;
  const auto learn_from = [&](const Log& log) {
    for (Record& r : make_records(log, model, kFitBand)) records.push_back(std::move(r));
  };
  // What is held out of a log goes on from the part before it: cables remember. That part is driven along, not
  // compared.
  const auto hold_out = [&](const Log& log, double from, std::size_t first) {
    for (const auto& [view, how] :
         {std::pair(&details->joint_view, kJointErrorBand), std::pair(&details->torque_view, kFitBand)})
      for (Record& r : make_records(log, model, how)) {
        if (r.time(r.size - 1) < from) continue;
        compare_from(r, from);
        for (std::size_t place = first; place < records.size(); ++place)
          if (records[place].start == r.start) r.place = static_cast<int>(place);
        view->records.push_back(std::move(r));
      }
  };
  for (const Log& log : training) {
    if (holdout) {
      learn_from(log);
    } else {
      const auto [first, last] = split_log(log, 2.0 / 3);
      const std::size_t place = records.size();
      learn_from(first);
      hold_out(log, last.time.front(), place);
    }
  }
  if (holdout) hold_out(*holdout, holdout->time.front(), records.size());
  d.holdout = holdout ? holdout->source : "last third of the training data";

  d.given = calibrated(model, records);
  const Evidence evidence(std::move(records), d.given);
  Attribution& attribution = details->attribution;
  attribution = attribute(evidence, d.given, {options.most_effects, options.significance}, say);
  say("final fit", 0);
  const std::size_t given = model.effects.size();
  const Fit final_fit = keep_certain_numbers(evidence, model, attribution.final_fit, attribution.final_score);
  attribution.final_fit = final_fit;
  attribution.final_score = evidence.score(final_fit.hypothesis);
  const Hypothesis& h = final_fit.hypothesis;

  // One sine fits many effects alike: a name taken from it would be a guess.
  std::vector<bool> one_sine(model.n());
  for (int k = 0; k < model.n(); ++k) one_sine[k] = is_one_sinusoid(evidence.records(), model.nominal, k);
  const bool all_one_sine = std::all_of(one_sine.begin(), one_sine.end(), [](bool b) { return b; });

  for (std::size_t e = given; e < h.effects.size() && !all_one_sine; ++e) {
    NamedEffect named{h.effects[e], {}, attribution.alternatives[e - given]};
    for (std::size_t i = 0; i < final_fit.parameters.size(); ++i)
      if (final_fit.parameters[i].effect == static_cast<int>(e) && !is_past(final_fit.parameters[i]))
        named.parameters.push_back(estimated(final_fit, i));
    d.effects.push_back(std::move(named));
  }
  const bool would_name = h.effects.size() > given;
  for (std::size_t i = 0; i < final_fit.parameters.size() && !(all_one_sine && would_name); ++i) {
    const FitParameter& p = final_fit.parameters[i];
    const bool was_unknown = p.effect < 0 && is_unknown_scale(model, p.index);
    if (!was_unknown && !is_refit(final_fit, i)) continue;
    d.refitted.push_back(estimated(final_fit, i));
    if (was_unknown) d.refitted.back().nominal = parameter_value({model.nominal, {}}, p);
  }

  const std::vector<bool> rest_of = significant_rest(evidence, attribution.final_score);
  for (int k = 0; k < model.n(); ++k) {
    const bool rest = rest_of[k] || rest_of[model.n() + k];
    if (all_one_sine && would_name)
      d.unexplained.push_back(
          {k, "the record is one sine, along which several effects look alike; record other motions or loads"});
    else if (rest) d.unexplained.push_back({k, signature(evidence, h, k)});
  }
  for (const Log& log : training)
    for (const int k : stuck_joint_sensors(log, model))
      d.unexplained.push_back({k, "its sensor stands still in " + log.source +
                                      " while its motor moves, and was left out: "
                                      "stuck, not connected, or the joint is not driven by this motor"});
  d.verdict = !d.effects.empty()      ? Diagnosis::Verdict::effects
              : d.unexplained.empty() ? Diagnosis::Verdict::clean
                                      : Diagnosis::Verdict::unknown;
  if (options.tell_not_excited) {
    say("what these data could show", 0);
    d.not_excited = not_excited(evidence, model, h);
  }

  const std::vector<std::vector<double>>& unexplained_past = attribution.baseline.hypothesis.past;
  d.revised = d.given;
  details->past = unexplained_past;
  if (!all_one_sine || !would_name) {
    d.revised.nominal = h.nominal;
    d.revised.effects = h.effects;
    details->past = h.past;
  }
  say("hold-out", 0);
  for (HoldOut* view : {&details->joint_view, &details->torque_view}) {
    view->before = predict_all(view->records, {d.given.nominal, d.given.effects, unexplained_past});
    view->after = predict_all(view->records, {d.revised.nominal, d.revised.effects, details->past});
  }
  d.before = errors(details->joint_view, details->torque_view, model.n(), &HoldOut::before);
  d.after = errors(details->joint_view, details->torque_view, model.n(), &HoldOut::after);
  return d;
}

}  // namespace halyard
