#pragma once
/// Identifies numbers of a model, and judges on logs that were held out whether they make it better.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "estimators/identification/identify.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// An identification, and errors of estimators that have motor signals alone, with the given model and with its.
struct IdentificationStudy {
  ArmModel given;
  std::string data, holdout;  ///< logs, for the reader
  Identification identification;
  std::vector<EstimatorComparison> estimators;  ///< kinematics, sr_ukf
};

/// Identifies the numbers of these keys (identified_keys() lists them) from the logs. Without a hold-out the last third
/// of each log is held out. progress(text, fraction) is called now and then.
/// Throws as identify() does; an estimator that fails on the hold-out says so in its EstimatorErrors.
IdentificationStudy study_identification(const ArmModel& model, const std::vector<Log>& logs,
                                         const std::optional<Log>& holdout, const std::vector<std::string>& keys,
                                         const std::function<void(const std::string&, double)>& progress = {});

/// Whether the identified numbers are the model's from now on. Not if sr_ukf with them fails on the hold-out, or has
/// the error of a joint grow by more than a tenth without making up for it at others: if the product of after / before
/// over the joints' RMS errors is above 1. Kinematics takes cables as rigid, and is no judge.
bool adopted(const IdentificationStudy& study);

/// What the identified numbers cannot be trusted for: other numbers pulled far, joints that they predict worse on the
/// hold-out, and if they are not adopted. One sentence each; none if all is well.
std::vector<std::string> doubts(const IdentificationStudy& study);

}  // namespace halyard
