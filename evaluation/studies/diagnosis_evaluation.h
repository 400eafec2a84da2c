#pragma once
/// What a diagnosis is told with: residuals that point, and how estimators do with the revised model.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/view_sentence.h"

namespace halyard {

/// Residuals of one joint over the training data, and the two or three views that say most.
struct EffectEvidence {
  int joint = 0;                  ///< 0-based, whose residuals these are
  ResidualSignals without, with;  ///< by the revised model without the effect, and with it; the same for a rest
  std::vector<View> views;        ///< best first; empty: no view says much
};

/// Errors of one estimator on the hold-out against the joints' sensors. [n]; NaN without a sensor.
struct EstimatorErrors {
  std::vector<double> rms, peak;  ///< empty if it failed
  std::vector<double> time;       ///< s, of what follows: all logs one after another
  Signals innovation;             ///< [motor] over its predicted deviation, ~ N(0, 1) if the model is right; NaN: none
  Signals joint_rate;             ///< [n] as estimated
  double mean_nis = 0;            ///< of its innovations, ~ 1 if the model is right; 0: it has none
  std::string failure;            ///< why it failed
};
/// A log, and the time from which its errors count: an estimator remembers what was before, as a cable does.
struct HeldOutLog {
  const Log* log;
  double from;
};
/// The errors over all logs together, of runs in processes of their own. A load that was measured is no part of the
/// model, and is handed on as to the prediction.
EstimatorErrors errors_of(const std::string& estimator, const ArmModel& model, const std::vector<HeldOutLog>& logs);

struct EstimatorComparison {
  std::string name;
  EstimatorErrors before, after;  ///< with the given and with the revised model
};

struct DiagnosisEvaluation {
  std::vector<EffectEvidence> effects;          ///< as Diagnosis::effects
  std::vector<EffectEvidence> unexplained;      ///< as Diagnosis::unexplained
  std::vector<EstimatorComparison> estimators;  ///< none if the hold-out has no joint sensor
};

/// training and holdout as diagnose() had them. progress(text, fraction) may be called from several threads, one at a
/// time.
DiagnosisEvaluation evaluate_diagnosis(const ArmModel& model, const Diagnosis& diagnosis,
                                       const std::vector<Log>& training, const std::optional<Log>& holdout,
                                       const std::function<void(const std::string&, double)>& progress = {});

/// " These data cannot tell it from hysteresis of joint 2."; empty without alternatives.
std::string alternatives_sentence(const NamedEffect& effect);

/// A sentence that says why effect `i` of the diagnosis was named: what its residual does without it, how much is left
/// with it, and which effects these data cannot tell it from.
std::string why_named(const Diagnosis& diagnosis, const DiagnosisEvaluation& evaluation, std::size_t i);

}  // namespace halyard
