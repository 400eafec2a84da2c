#pragma once
/// Whether sets and intervals hold, and what a revised model predicts.

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

/// Names whose set (the name and the alternatives that are in it) contains the truth, of all names: sets_with_truth().
Proportion set_coverage(const Results& ran);
/// Mean of the probabilities that these sets claim. A set ends with the name that brings it to 90 %, so it claims more.
double probability_of_sets(const Results& ran);
/// The true parameters of the effects that were named rightly. A diagnosis gives no interval to whole numbers, and
/// leaves out shapes of sizes that it did not find, and sizes that ended at a bound.
struct ParameterCounts {
  Proportion kept;         ///< intervals of 95 % that contain the truth, of parameters that are not neutral
  Proportion reset;        ///< the same of those that the diagnosis has reset to neutral
  Proportion whole;        ///< whole numbers that are right
  Proportion off_neutral;  ///< parameters that were left out whose truth is not neutral
  /// A parameter that was left out, and is not neutral, is a miss.
  Proportion intervals() const { return {kept.hits + reset.hits, kept.of + reset.of + off_neutral.hits}; }
};
ParameterCounts parameter_counts(const Results& ran);

/// Of each trial that tells it, the mean over its joints of the share of the hold-out's samples that lie in the
/// diagnosis' 95 % intervals. Joints without an interval do not count, nor does a trial all of whose joints have none.
std::vector<double> interval_coverages(const Results& ran);

/// Hold-out error over another one: the worst joint, and the geometric mean of the joints that have both; NaN if none.
struct ErrorRatio {
  double worst, mean;
};
ErrorRatio error_ratio(const std::vector<double>& error, const std::vector<double>& other);
/// A joint's error is above the given model's by at least 1 %, and by 3 standard deviations of the difference. They are
/// estimated from the 10 or 11 seconds of the hold-out: where the two models are equally good, Student's t brings 7 in
/// a thousand joints above 3.
bool rises_above_given(const Result& r);

}  // namespace halyard::blind
