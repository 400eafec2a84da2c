#pragma once
/// How well a joint's reading agrees with the reading that its motor and those inboard give.

#include <limits>
#include <optional>
#include <vector>

#include "diagnosis/log_check/log_under_check.h"
#include "diagnosis/log_check/robust.h"

namespace halyard {

/// Slope of joint k's reading over its expectation, or, if that explains more, of the reading plus coupling over what
/// its own motor gives. The first suits a wrong reading; the second a wrong motor, whose coupling is right.
Slope slope_at(const SampledMotion& m, int k);

/// Whether a ratio has the sign of the expected one, and its size within a factor.
bool is_near(double ratio, double expected, double within);

/// Whether joint k moves by enough to conclude something from it.
bool moves(const LogUnderCheck& c, int k, const std::vector<double>& position);

/// How badly joint k's reading agrees with its expectation: by its slope, by what the slope leaves, and by its zero if
/// that is known. kDisagrees if the slope explains less than least_explained, or is farther from 1 than any effect
/// makes it.
inline constexpr double kDisagrees = std::numeric_limits<double>::infinity();
double disagreement(const LogUnderCheck& c, const SampledMotion& m, int k, double least_explained);

/// An explanation of a slope: which of two columns is wrong, and by what factor.
struct Explanation {
  Signals Log::*signal;
  UnitGuess unit;
  double misfit;  ///< smaller is better
};
/// The best explanation of |slope| at joint k by a unit of either column, by a scale of its map that it should not
/// have, or by a motor's angle that is not one at its shaft.
std::optional<Explanation> unit_that_explains(const LogUnderCheck& c, const SampledMotion& m, int k, double slope);

/// How far a slope is from the one that a correction would leave: 1 at the largest deviation that a unit explains.
double misfit_of_slope(const LogUnderCheck& c, double slope, double expected);

}  // namespace halyard
