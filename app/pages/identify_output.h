#pragma once
/// What an identification is told as: identify.json, convergence.csv, report.html and sentences.

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/page.h"
#include "estimators/identification/identify.h"
#include "evaluation/studies/diagnosis_evaluation.h"

namespace halyard {

/// An identification, and errors of estimators that have motor signals alone, with the given model and with its.
struct IdentifyResult {
  ArmModel given;
  std::string data, holdout;  ///< logs, for the reader
  Identification identification;
  std::vector<EstimatorComparison> estimators;  ///< kinematics, sr_ukf
};

/// "converged", "still drifting in the last third: a longer log, ..." and what to do about it.
std::string in_words(Convergence convergence);

/// Whether the identified numbers are the model's from now on. Not if sr_ukf with them fails on the hold-out, or has
/// the error of a joint grow by more than a tenth without making up for it at others: if the product of after / before
/// over the joints' RMS errors is above 1. Kinematics takes cables as rigid, and is no judge.
bool adopted(const IdentifyResult& result);

/// What the identified numbers cannot be trusted for: other numbers pulled far, joints that they predict worse on the
/// hold-out, and if they are not adopted. One sentence each; none if all is well.
std::vector<std::string> doubts(const IdentifyResult& result);

/// The text of identify.json.
std::string identify_json(const IdentifyResult& result);

report::Page identify_page(const IdentifyResult& result);

/// Writes model.xml, identify.json, convergence.csv and report.html into the folder. The model is the given one unless
/// the numbers are adopted.
void write_identification(const std::filesystem::path& folder, const IdentifyResult& result);

}  // namespace halyard
