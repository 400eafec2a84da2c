#pragma once
/// What a diagnosis is told with: why each effect was named, and how estimators do with the revised model.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnose.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// The residuals behind the sentences, for drawing: diagnosis_evidence.h, which is not installed.
struct DiagnosisEvidence;

struct DiagnosisEvaluation {
  /// As Diagnosis::effects: a sentence that says why the effect was named: what the residual does without it, how much
  /// is left with it, and which effects these data cannot tell it from.
  std::vector<std::string> why;
  std::vector<EstimatorComparison> estimators;  ///< none if the hold-out has no joint sensor
  std::shared_ptr<const DiagnosisEvidence> evidence;
};

/// training and holdout as diagnose() had them. progress(text, fraction) may be called from several threads, one at a
/// time.
DiagnosisEvaluation evaluate_diagnosis(const ArmModel& model, const Diagnosis& diagnosis,
                                       const std::vector<Log>& training, const std::optional<Log>& holdout,
                                       const std::function<void(const std::string&, double)>& progress = {});

/// " These data cannot tell it from hysteresis of joint 2."; empty without alternatives.
std::string alternatives_sentence(const NamedEffect& effect);

}  // namespace halyard
