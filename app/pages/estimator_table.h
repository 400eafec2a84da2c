#pragma once
/// Errors of estimators on held-out logs, with the given and with another model.

#include <string>
#include <vector>

#include "app/report/page.h"
#include "evaluation/studies/holdout_errors.h"

namespace halyard {

/// Adds a table with a row for each joint and estimator, and a sentence about estimators that failed.
/// other: the word for the other model, "revised" or "identified".
void add_estimator_table(report::Page& page, const ArmModel& given, const std::vector<EstimatorComparison>& estimators,
                         const std::string& other, const std::string& caption);

}  // namespace halyard
