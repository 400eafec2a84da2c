#pragma once
/// The parts of a comparison that show which estimator is better, and whether each agrees with its stated covariances.

#include <nlohmann/json.hpp>

#include "app/report/page.h"
#include "evaluation/comparison/compare.h"
#include "evaluation/comparison/monte_carlo.h"

namespace halyard {

/// "0.0123 (95 %: 0.011 to 0.014): better".
std::string in_words(const PairedRatio& ratio);

/// NIS, NEES of each joint, whiteness of each motor's innovation, with verdicts.
report::Table consistency_table(const Comparison& comparison);
/// One row for each pair of estimators and each joint.
report::Table paired_table(const Comparison& comparison);
/// Errors and failures over many runs; one row per joint and estimator.
report::Table runs_error_table(const MonteCarlo& runs, const std::vector<JointUnit>& units);
/// Consistency over many runs; one row per joint and estimator.
report::Table runs_consistency_table(const MonteCarlo& runs);

nlohmann::ordered_json to_json(const Consistency& c);
nlohmann::ordered_json to_json(const PairedRatio& ratio);
nlohmann::ordered_json to_json(const MonteCarlo& runs);

}  // namespace halyard
