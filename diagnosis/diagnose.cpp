#include "diagnosis/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "diagnosis/calibration/calibrate.h"
#include "diagnosis/calibration/lateness.h"
#include "diagnosis/diagnosis_details.h"
#include "diagnosis/explanation/estimates.h"
#include "diagnosis/explanation/lines_above_band.h"
#include "diagnosis/explanation/not_excited.h"
#include "diagnosis/explanation/signature.h"
#include "diagnosis/holdout/adoption.h"
#include "diagnosis/holdout/prediction_interval.h"
#include "diagnosis/judgement/name_probability.h"
#include "diagnosis/log_check/own_readings.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/search/basis.h"
#include "diagnosis/search/revision.h"
#include "diagnosis/search/unlisted_causes.h"
#include "diagnosis/search_space.h"

namespace halyard {
namespace {

using Progress = std::function<void(const std::string&, double)>;

LogFinding finding_of(const DiagnosisData::Late& late) {
  return {late.log, "joint_position",
          fmt::format("the joint sensors, slower than the motors' encoders, are {:.3g} ms {} them",
                      1e3 * std::abs(late.seconds), late.seconds > 0 ? "late against" : "ahead of"),
          "nothing to do: the diagnosis has moved their readings by this time", LogFinding::Severity::corrected};
}

/// What the stages of one diagnosis share.
class Diagnoser {
 public:
  Diagnoser(const ArmModel& model, const DiagnosisOptions& options, const Progress& progress)
      : model_(model), options_(options), progress_(progress), given_(model.effects.size()) {}

  Diagnosis run(std::vector<Log> all_training, std::optional<Log> own_holdout) {
    const auto [training, holdout, findings] =
        usable_logs(model_, std::move(all_training), std::move(own_holdout), options_.columns.value_or(model_.columns));
    result_.log_findings = findings;
    has_own_holdout_ = holdout.has_value();
    n_logs_ = training.size();
    result_.holdout = holdout ? holdout->source : "last third of each log";
    Searched searched = search(training, holdout, model_);
    if (const auto tells = model_for_lateness(training, model_, final_hypothesis()))
      searched = search(training, holdout, *tells);
    const Evidence& evidence = *searched.evidence;
    weigh_unlisted_causes(evidence, tolerated_, attribution());
    changed_ = drop_doubtful_events(evidence, *searched.whole, tolerated_, attribution(), std::move(changed_));
    DiagnosisData& data = searched.data;
    for (const DiagnosisData::Late& late : data.late) result_.log_findings.push_back(finding_of(late));
    details_->late = data.late;
    details_->training = evidence.records();
    details_->joint_view = std::move(data.joint_view);
    details_->torque_view = std::move(data.torque_view);
    if (names_would_be_guesses(evidence)) refuse_names(evidence);
    else tell_names(evidence);
    tell_rests(evidence);
    adopt_on_holdout(evidence, *searched.whole, data.training_joints);
    tell_refits();
    if (!is_revised()) result_.tolerance_factor = 1;
    tell_doubtful(evidence);
    tell_probabilities(evidence);
    tell_stuck_sensors(training);
    result_.verdict = !result_.effects.empty()      ? Diagnosis::Verdict::effects
                      : result_.unexplained.empty() ? Diagnosis::Verdict::clean
                                                    : Diagnosis::Verdict::unknown;
    if (options_.tell_not_excited) {
      say("what these data could show", 0);
      result_.not_excited = not_excited(evidence, final_hypothesis(), model_.nominal);
    }
    result_.details = details_;
    return std::move(result_);
  }

 private:
  void say(const std::string& what, double fraction) const {
    if (progress_) progress_(what, fraction);
  }
  Attribution& attribution() { return details_->attribution; }
  const Hypothesis& final_hypothesis() const { return details_->attribution.final_fit.hypothesis; }
  /// The effect; an event on the clock of the log in which it happens.
  PlacedEffect on_its_clock(const Evidence& evidence, const PlacedEffect& effect) const {
    return on_clock_of_its_log(effect, model_.nominal, evidence.records());
  }

  /// The data of a search, as it has split them.
  struct Searched {
    DiagnosisData data;  ///< without its training records
    std::unique_ptr<Evidence> evidence, whole;
  };

  /// tells_lateness: see diagnosis_data().
  Searched search(const std::vector<Log>& training, const std::optional<Log>& holdout, const ArmModel& tells_lateness) {
    Searched s{diagnosis_data(model_, training, holdout, tells_lateness), nullptr, nullptr};
    result_.given = calibrated(model_, s.data.training);
    s.evidence = std::make_unique<Evidence>(s.data.training, result_.given);
    s.whole = std::make_unique<Evidence>(std::move(s.data.training), result_.given, Split::none);
    attribution() = attribute(*s.evidence, result_.given, {.most_effects = options_.most_effects}, progress_);
    say("final fit", 0);
    result_.tolerance_factor = attribution().tolerance_factor;
    tolerated_ = with_tolerances_times(result_.tolerance_factor, result_.given);
    changed_ = revise(*s.evidence, *s.whole, tolerated_, attribution());
    return s;
  }

  /// A single record of one sine fits many effects alike: a name taken from it would be a guess.
  bool names_would_be_guesses(const Evidence& evidence) const {
    for (int k = 0; k < model_.n(); ++k)
      if (!is_one_sinusoid(evidence.records(), model_.nominal, k)) return false;
    return final_hypothesis().effects.size() > given_;
  }

  void refuse_names(const Evidence& evidence) {
    const Record& record = evidence.records().front();
    for (int k = 0; k < model_.n(); ++k)
      result_.unexplained.push_back({k,
                                     stands_still(record, model_.nominal, k)
                                         ? "it stands still in the record; record other motions or loads"
                                         : "the record is one sine, along which several effects look alike; record "
                                           "other motions or loads",
                                     Unexplained::Kind::motion});
    give_up_revision(evidence);
  }

  /// The revised model is the given one.
  void give_up_revision(const Evidence& evidence) {
    result_.effects.clear();
    changed_.clear();
    doubts_.clear();
    told_.clear();
    none_for_.clear();
    attribution().final_fit = attribution().baseline;
    attribution().final_fit.hypothesis = {result_.given.nominal, result_.given.effects,
                                          attribution().baseline.hypothesis.past};
    attribution().final_score = evidence.score(final_hypothesis());
    gave_up_ = true;
  }

  /// The model whose residuals are the unexplained rest. Where the revision is given up, it is the given model with its
  /// numbers refitted: what these explain within their tolerances stays explained.
  const Hypothesis& rest_is_of() const {
    return gave_up_ ? details_->attribution.baseline.hypothesis : final_hypothesis();
  }
  const Score& score_of_rest() const {
    return gave_up_ ? details_->attribution.baseline_score : details_->attribution.final_score;
  }

  void tell_names(const Evidence& evidence) {
    none_for_ = probabilities_of_none(evidence, attribution(), given_);
    doubts_ = doubts(evidence, tolerated_, attribution(), none_for_, AttributionOptions{}.significance);
    for (std::size_t e = given_; e < final_hypothesis().effects.size(); ++e) {
      none_ = std::max(none_, none_for_[e - given_]);
      told_.push_back(told_effect(evidence, e));
      if (doubts_[e - given_] == Doubt::none) result_.effects.push_back(told_.back());
    }
  }

  /// The added effect of that index, whether its name is sure enough or not.
  NamedEffect told_effect(const Evidence& evidence, std::size_t e) {
    const PlacedEffect& effect = final_hypothesis().effects[e];
    const Naming& naming = attribution().namings[e - given_];
    const double none = none_for_[e - given_];
    NamedEffect told{on_its_clock(evidence, effect), told_probability(naming.weight, none),
                     told_parameters(evidence, e), naming.alternatives};
    told.index = e;
    const Record* const happens_in = record_of(effect, model_.nominal, evidence.records());
    if (happens_in && n_logs_ > 1) told.log = happens_in->source;
    std::vector<double> all = {told.probability};
    for (Alternative& a : told.alternatives) all.push_back(a.probability = told_probability(a.probability, none));
    const std::vector<bool> in = credible_set(all, kRule.set_share);
    told.in_set = in[0] || doubts_[e - given_] == Doubt::none;
    for (std::size_t a = 0; a < told.alternatives.size(); ++a) told.alternatives[a].in_set = in[a + 1];
    return told;
  }

  /// Effects without a name that stay in the revised model, because it predicts better with them.
  void tell_doubtful(const Evidence& evidence) {
    const Score with = evidence.score(final_hypothesis());
    for (std::size_t e = given_; e - given_ < doubts_.size(); ++e) {
      const Doubt doubt = doubts_[e - given_];
      if (doubt == Doubt::none) continue;
      const Score without = evidence.score(without_effect(final_hypothesis(), e));
      const auto c = without.finite ? most_explained_channel(evidence, with, without) : std::nullopt;
      const PlacedEffect& effect = final_hypothesis().effects[e];
      const int k = c ? *c % model_.n() : effect.joint.value_or(0);
      result_.unexplained.push_back(
          {k,
           fmt::format(
               "{} explains a part of it and is in the revised model, but {}", effect_label(effect),
               reason_of(doubt, attribution().namings[e - given_], none_for_[e - given_], final_hypothesis().effects)),
           Unexplained::Kind::unnamed_effect, told_[e - given_]});
    }
  }

  /// Instants are told on their log's clock.
  std::vector<Estimated> told_parameters(const Evidence& evidence, std::size_t effect) {
    const PlacedEffect& e = final_hypothesis().effects[effect];
    return estimated_parameters(evidence, result_.given.nominal, attribution().final_fit, effect, given_,
                                on_its_clock(evidence, e));
  }

  void tell_refits() {
    const Fit& f = attribution().final_fit;
    for (const std::size_t i : changed_) {
      const FitParameter& p = f.parameters[i];
      result_.refitted.push_back(estimate_of(f, i, given_));
      if (is_unknown_scale(model_, p.index)) result_.refitted.back().nominal = parameter_value({model_.nominal, {}}, p);
    }
  }

  /// Mean square of each channel that the named effects may miss, because their equations may have another form. score:
  /// of the final hypothesis.
  std::vector<double> misfit_of_names(const Evidence& evidence, const Score& score) {
    std::vector<std::size_t> named;
    for (std::size_t e = given_; e < final_hypothesis().effects.size(); ++e)
      if (const Doubt d = doubts_[e - given_]; d == Doubt::none || d == Doubt::guess) named.push_back(e);
    return mean_square_misfit(evidence, {final_hypothesis(), score}, named);
  }

  void tell_rests(const Evidence& evidence) {
    const std::vector<bool> rest_of =
        significant_rest(evidence, score_of_rest(), misfit_of_names(evidence, attribution().final_score));
    const int n = model_.n();
    for (int k = 0; k < n; ++k)
      if (rest_of[k] || rest_of[n + k]) result_.unexplained.push_back({k, signature(evidence, rest_is_of(), k)});
    for (Unexplained& line : lines_above_band(evidence, rest_is_of())) result_.unexplained.push_back(std::move(line));
  }

  void tell_probabilities(const Evidence& evidence) {
    // The hold-out may have changed the numbers since final_score.
    const std::vector<double> misfit = misfit_of_names(evidence, evidence.score(final_hypothesis()));
    for (const double none : probabilities_of_a_rest(evidence, score_of_rest(), misfit)) none_ = std::max(none_, none);
    result_.probability_none = kRule.outside_if_certain * none_;
    // Something acts also where the effect gets no name, or predicts the hold-out badly.
    std::vector<double> present;
    for (const Naming& naming : attribution().namings) present.push_back(probability_of_any_name(naming, 0));
    result_.probability_clean = probability_of_clean(none_, attribution().no_effect, present);
  }

  void tell_stuck_sensors(const std::vector<Log>& training) {
    for (const Log& log : training)
      for (const int k : stuck_joint_sensors(log, model_))
        result_.unexplained.push_back({k,
                                       "its sensor stands still in " + log.source +
                                           " while its motor moves, and was left out: "
                                           "stuck, not connected, or the joint is not driven by this motor",
                                       Unexplained::Kind::stuck_sensor});
  }

  /// The revised model, if the hold-out lets it be adopted, and the errors by both models.
  void adopt_on_holdout(const Evidence& evidence, const Evidence& whole, const std::vector<Record>& training_joints) {
    say("hold-out", 0);
    HoldOut &joints = details_->joint_view, &torques = details_->torque_view;
    const Hypothesis before{result_.given.nominal, result_.given.effects, attribution().baseline.hypothesis.past};
    for (HoldOut* view : {&joints, &torques}) view->before = predict_all(view->records, before);
    const AdoptionTask task{evidence, whole, result_.given, tolerated_, has_own_holdout_};
    const std::vector<FitParameter> fitted = attribution().final_fit.parameters;
    const Adoption adoption = adopted_on_holdout(task, {attribution().final_fit, changed_}, joints, torques);
    attribution().final_fit = adoption.revised.fit;
    changed_ = adoption.revised.changed;
    result_.absent_events = adoption.absent_events;
    if (!adoption.worse.empty()) refuse(evidence, adoption.worse);
    result_.revised = result_.given;
    result_.revised.nominal = final_hypothesis().nominal;
    result_.revised.effects =
        on_clocks_of_their_logs(final_hypothesis(), given_, model_.nominal, evidence.records()).effects;
    for (PlacedEffect& e : result_.revised.effects) keep_within_bounds(e, result_.revised.nominal);
    result_.before = prediction_errors(joints, torques, result_.given.nominal, &HoldOut::before);
    result_.after = prediction_errors(joints, torques, result_.given.nominal, &HoldOut::after);
    tell_intervals(task, fitted, training_joints);
  }

  /// Intervals of the joint positions. The effects that the hold-out's veto leaves are as uncertain as before.
  ///   fitted: the parameters of the fit before that veto
  void tell_intervals(const AdoptionTask& task, const std::vector<FitParameter>& fitted,
                      const std::vector<Record>& training_joints) {
    HoldOut& joints = details_->joint_view;
    Fit uncertain = attribution().final_fit;
    if (final_hypothesis().effects.size() > given_) uncertain.parameters = fitted;
    std::vector<FitParameter> numbers = attribution().baseline.parameters;
    for (const FitParameter& p : fitted)
      if (!p.effect && !find_parameter(numbers, p)) numbers.push_back(p);
    uncertain = with_all_numbers(task.whole, uncertain, numbers);
    for (const std::size_t e : result_.absent_events)
      if (uncertain.usable) uncertain = without_event(std::move(uncertain), e);
    uncertain.hypothesis = on_holdout_clock(task, uncertain.hypothesis);
    const std::vector<double> noise = residual_quantiles(task.evidence, training_joints, final_hypothesis());
    joints.half_width = half_widths(joints.records, uncertain, noise);
    result_.joint_interval = prediction_interval(joints, model_.n());
  }

  bool is_revised() const { return final_hypothesis().effects.size() > given_ || !changed_.empty(); }

  /// What the hold-out refuses becomes unexplained, and what it had explained. Numbers that changed too little to be
  /// told go back without a word.
  void refuse(const Evidence& evidence, const std::vector<int>& worse) {
    const bool is_told = is_revised();
    const std::vector<PlacedEffect>& all = final_hypothesis().effects;
    const std::string reason = reason_of_refusal({all.begin() + static_cast<std::ptrdiff_t>(given_), all.end()});
    give_up_revision(evidence);
    if (!is_told) return;
    result_.unexplained.clear();  // what the refused model leaves
    for (const int k : worse) result_.unexplained.push_back({k, reason, Unexplained::Kind::refused});
    tell_rests(evidence);
  }

  const ArmModel& model_;
  const DiagnosisOptions& options_;
  const Progress& progress_;
  bool has_own_holdout_ = false;      ///< a log, not the last third of the training
  std::size_t n_logs_ = 0;            ///< of the training
  std::size_t given_;                 ///< effects that the model came with
  ArmModel tolerated_;                ///< Diagnosis::given with the tolerances of the search
  std::vector<std::size_t> changed_;  ///< see changed_numbers()
  std::vector<Doubt> doubts_;         ///< of each added effect
  std::vector<double> none_for_;      ///< of each, probabilities_of_none()
  std::vector<NamedEffect> told_;     ///< of each, what is told of it
  double none_ = 0;                   ///< the largest P(none) of a name or of a channel
  bool gave_up_ = false;              ///< see give_up_revision()
  std::shared_ptr<DiagnosisDetails> details_ = std::make_shared<DiagnosisDetails>();
  Diagnosis result_;
};

}  // namespace

const char* verdict_word(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::clean: return "clean";
    case Diagnosis::Verdict::effects: return "effects";
    case Diagnosis::Verdict::unknown: break;
  }
  return "unknown";
}

bool Diagnosis::is_revised() const { return revised.effects.size() > given.effects.size() || !refitted.empty(); }

ArmModel Diagnosis::revised_on_holdout() const {
  ArmModel model = revised;
  for (const std::size_t e : absent_events) model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(e));
  return model;
}

Diagnosis diagnose(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                   const DiagnosisOptions& options, const Progress& progress) {
  std::mutex one_at_a_time;
  const Progress say = [&](const std::string& what, double fraction) {
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    if (progress) progress(what, fraction);
  };
  return Diagnoser(model, options, say).run(training, holdout);
}

}  // namespace halyard
