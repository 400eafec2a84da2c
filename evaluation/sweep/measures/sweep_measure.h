#pragma once
/// What a sweep measures. A sweep file names one or more of these groups of numbers, which are computed for every run
/// of an estimator:
///
///   errors   ErrorStatistics of each joint                               judgement/error_statistics.h
///   nees     mean NEES of each joint, and its 95 % band                  judgement/consistency.h
///   counts   steps, measurements not accepted, square-root factors that were rebuilt   estimators/estimator.h
///   time     wall time of a step, us
///
/// A sweep of detection limits measures instead, for every effect,
///
///   limits   the sizes from which a diagnosis sees and names it          sweep_limits.h

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halyard {

struct Comparison;

/// A column of numbers, one for each run of an estimator, or each effect, and each joint.
struct MeasuredColumn {
  std::string name;  ///< in the header of the table
  /// The number at joint k; the comparison has one run. Null of limits.
  double (*value)(const Comparison& comparison, std::size_t k) = nullptr;
  double after_failure = std::numeric_limits<double>::quiet_NaN();
};

struct SweepMeasure {
  std::string name;  ///< in sweep files
  std::vector<MeasuredColumn> columns;
  std::size_t shown = 0;                 ///< the column that curves, heat maps and reports show
  std::string shown_as;                  ///< its name in them
  std::string meaning;                   ///< what it is, for readers of a report
  std::optional<std::string> unit = {};  ///< of the shown column, empty for a pure number; none: that of the joint
  bool is_of_joint = true;               ///< false: the columns are of the whole run, equal for all joints
  bool is_repeatable = true;  ///< false: differs from run to run, so that it is in a file of its own, and in no picture
};

/// All measures of estimators; the first is the default.
const std::vector<SweepMeasure>& sweep_measures();
/// The measure of detection limits.
const SweepMeasure& limits_measure();

/// Splits a list such as "errors,nees" at the commas.
/// Throws InputError for a name that is unknown or listed twice, and for a list without a repeatable measure.
std::vector<const SweepMeasure*> parse_measures(std::string_view text);

}  // namespace halyard
