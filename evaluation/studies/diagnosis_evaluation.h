#pragma once
/// Evidence for a diagnosis: reasons for each named effect, errors of estimators with the revised model, rehearsals.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/rehearse.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// The residuals on which the sentences of DiagnosisEvaluation::why are based, for charts. Defined in
/// diagnosis_evidence.h, which is not installed.
struct DiagnosisEvidence;

struct DiagnosisEvaluation {
  /// One entry for each of Diagnosis::effects: how the residual behaves without the effect, how much of it is left with
  /// the effect, and which other effects fit these data equally well.
  std::vector<std::string> why;
  std::vector<EstimatorComparison> estimators;  ///< none if the hold-out has no joint sensor
  std::shared_ptr<const DiagnosisEvidence> evidence;
  std::optional<Rehearsals> rehearsals;  ///< if they were asked for
};

/// training, holdout: the arguments of diagnose(). progress(text, fraction) may be called from several threads, but
/// never by two at once.
DiagnosisEvaluation evaluate_diagnosis(const ArmModel& model, const Diagnosis& diagnosis,
                                       const std::vector<Log>& training, const std::optional<Log>& holdout,
                                       const std::function<void(const std::string&, double)>& progress = {},
                                       const ContainmentOptions& containment = {});

/// Sentence about those alternatives that are in the smallest set which holds the right name: " These data cannot tell
/// it from hysteresis of joint 2."; empty if there are none.
std::string alternatives_sentence(const NamedEffect& effect);

}  // namespace halyard
