#pragma once
/// Finds, from measured logs, the effects that a model lacks, and returns the model with those effects.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/log_check/log_check.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

struct DiagnosisOptions {
  int most_effects = 6;          ///< largest number of effects added to the model
  bool tell_not_excited = true;  ///< fill Diagnosis::not_excited; costs one prediction for each candidate
  /// The map with which the logs were read, for the remedies in log_findings; none: the model's.
  std::optional<ColumnMap> columns = std::nullopt;
};

/// A number with its unit and 95 % interval.
struct Estimated {
  std::string name, unit;
  double value = 0, lower = 0, upper = 0;
  double nominal = 0;
  bool is_whole = false;  ///< a whole number: it has no interval, and both ends are its value
  bool is_reset = false;  ///< it was set to its neutral value: not significant, or at the end of what is plausible
  /// The fit has taken it to a bound of its range: of a number of the model to the end of its tolerance. Of a parameter
  /// that was reset: to the end of what is plausible, before it was reset.
  bool at_bound = false;
  bool at_limit = false;       ///< that bound is a physical limit: the true value cannot lie beyond
  double least = 0, most = 0;  ///< the range in which it was fitted
};

/// An effect that may be the true one instead of the effect that was named.
struct Alternative {
  PlacedEffect effect;
  double probability = 0;  ///< that it is the true effect, given the log
  /// It is in the smallest set of effects that contains the true one with probability 90 %, if the name or one of its
  /// alternatives is right.
  bool in_set = false;
};

/// An effect that the diagnosis found.
struct NamedEffect {
  PlacedEffect effect;
  double probability = 0;  ///< that the arm has this effect at this joint, given the log
  std::vector<Estimated> parameters;
  std::vector<Alternative> alternatives;  ///< the most probable first
  std::string log = {};   ///< the training log on whose clock its instants are; empty without instants or with one log
  std::size_t index = 0;  ///< in the effects of Diagnosis::revised, which also has effects without a name
  bool in_set = true;     ///< as Alternative::in_set; a name that is sure enough to be told is always in the set
};

/// What the diagnosis cannot name.
struct Unexplained {
  enum class Kind {
    rest,             ///< a significant residual that no candidate effect explains
    unnamed_effect,   ///< it is in the revised model, but its name is not sure enough
    refused,          ///< the hold-out refutes what explains the training data
    motion,           ///< one sine or standstill: several effects look alike
    stuck_sensor,     ///< it was left out
    line_above_band,  ///< a narrow line above the compared frequencies
  };
  int joint;              ///< 0-based
  std::string signature;  ///< description
  Kind kind = Kind::rest;
  /// Of unnamed_effect: what is told of an effect with a name. Its joint need not be the one above, whose residual it
  /// explains a part of.
  std::optional<NamedEffect> effect = {};
};

/// An effect that these data could not have shown.
struct NotExcited {
  std::string effect;
  EffectPlace joint;
  std::string why;
};

/// Parts of the error of one signal, [n]: rms² = bias² + spread². NaN where there is no sensor or no such sample.
struct ErrorParts {
  std::vector<double> bias;                     ///< mean of measured minus predicted
  std::vector<double> spread;                   ///< standard deviation about that mean
  std::vector<double> moving_rms, resting_rms;  ///< over samples at which the joint's motor moves, and rests
};

/// Errors per joint, [n]; NaN where there is no sensor.
struct PredictionError {
  std::vector<double> joint_rms, joint_peak, torque_rms;
  ErrorParts joint, torque;
};

/// 95 % intervals of the predicted joint position on the hold-out, [n]; NaN where there is no sensor.
struct PredictionInterval {
  std::vector<double> half_width;  ///< median over the samples, rad | m
  std::vector<double> coverage;    ///< share of the samples that lie in their interval
};

/// Intermediate results of the diagnosis, for reports. Defined in diagnosis_details.h, which is not installed.
struct DiagnosisDetails;

struct Diagnosis {
  enum class Verdict { clean, effects, unknown } verdict = Verdict::clean;
  std::vector<NamedEffect> effects;
  std::vector<Estimated> refitted;
  /// The numbers of the model were refitted within so many times their tolerances. Above 1: the model is off by more
  /// than it states, and what lies beyond a tolerance need not be an effect.
  double tolerance_factor = 1;
  std::vector<Unexplained> unexplained;
  std::vector<NotExcited> not_excited;
  std::vector<LogFinding> log_findings;  ///< of check_log() about all logs, and what was corrected
  double probability_clean = 0;          ///< that the arm has no effect which the model lacks
  /// probability that none of the candidates is the right name for a remaining residual or for a named effect:
  /// outside_if_certain (decision_rule.h) of the largest of these probabilities
  double probability_none = 0;
  ArmModel given;  ///< the model as given, with unknown torque scales calibrated
  ArmModel revised;
  std::string holdout;  ///< description of the hold-out data
  /// Events of `revised`, such as a push, that did not happen in a hold-out log of its own: indices into its effects,
  /// the last first.
  std::vector<std::size_t> absent_events;
  PredictionError before, after;      ///< on the hold-out, with `given` and with revised_on_holdout()
  PredictionInterval joint_interval;  ///< of revised_on_holdout()
  std::shared_ptr<const DiagnosisDetails> details;

  /// False if `revised` is the model as it was given. It may contain effects that got no name.
  bool is_revised() const;
  /// `revised` without its absent events.
  ArmModel revised_on_holdout() const;
};

/// clean | effects | unknown
const char* verdict_word(Diagnosis::Verdict verdict);

/// Diagnoses a model from training logs. The hold-out can only veto: if the revised model predicts a joint worse there
/// than the given model, numbers return to their given values and the others are fitted again: first those that move
/// this joint and that the training hardly determines, then all that move joints (holdout/adoption.h). If a joint is
/// still worse, no effect is named. Without a hold-out, the last third of each training log is held out.
/// An event at an instant of the training says nothing about another log: the hold-out log is predicted with it, at the
/// same time of its own clock, or without it, whichever leaves less error.
/// Outliers of all logs are left out, and told in log_findings.
/// progress(what, fraction of it) is never called by two threads at once.
/// Throws InputError for logs that cannot be compared with the model, and for gross findings of check_log().
Diagnosis diagnose(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                   const DiagnosisOptions& options = {},
                   const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard
