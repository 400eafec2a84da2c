#pragma once
/// Whether probabilities, sets and intervals hold, and what a revised model predicts.

#include <string>

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

/// A probability that a diagnosis gave, and whether it came true.
struct Claim {
  double probability;
  bool came_true;
};

/// Every probability of the trials: of names (true if the effect is hidden, or true beside it) and alternatives (true
/// if it is hidden); of `clean` (nothing is hidden), and of "none of these" (an effect outside the library is). Left
/// out is what may or may not be true: an alternative that is true beside the hidden effects, but need not be what was
/// named; the last two of effects that are too small to see, and of parameters beyond their tolerance.
std::vector<Claim> claims_of(const Results& ran);

/// Bins of a tenth with fewer claims say nothing.
inline constexpr int kFewestInBin = 20;
/// Largest distance between mean probability and observed frequency of a bin; 0 without a full bin.
double largest_distance(const std::vector<Claim>& claims);
/// Ten bins: mean probability against observed frequency, with its binomial interval. Empty without claims.
std::string calibration_table(const std::vector<Claim>& claims);

/// Names whose set (the name and the alternatives that are in it) contains the truth, of all names: sets_with_truth().
Proportion set_coverage(const Results& ran);
/// Mean of the probabilities that these sets claim. A set ends with the name that brings it to 90 %, so it claims more.
double probability_of_sets(const Results& ran);
/// Intervals of the effects that were named rightly, over their true parameters.
Proportion interval_coverage(const Results& ran);

/// Hold-out error over another one: the worst joint, and the geometric mean of the joints that have both; NaN if none.
struct ErrorRatio {
  double worst, mean;
};
ErrorRatio error_ratio(const std::vector<double>& error, const std::vector<double>& other);
/// A joint's error is above the given model's by at least 1 %, and by 3 standard deviations of the difference,
/// estimated from the hold-out's seconds: about one such joint in a thousand by chance.
bool rises_above_given(const Result& r);

}  // namespace halyard::blind
