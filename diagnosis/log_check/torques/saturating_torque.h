#pragma once
/// A wrong unit or a motor that saturates? Either makes the torque that a motion requires much smaller than the
/// recorded one. A wrong unit makes every torque smaller by the same factor. A motor that saturates follows small
/// commands and loses what is above its limit.
///
///   wrong unit:  y = f x + c sgn(x),                   f within a range, any c
///   saturation:  y = x - ρ (x - clamp(x, -L, L)),      0 <= ρ <= 1, L > 0
///
///   x, y   recorded torque, required torque                              N m
///   f      SI unit per unit                                              1
///   c      error of the friction of the model                            N m
///   L, ρ   limit; share of the torque above it that is lost              N m, 1
///
/// Both have two numbers, so their sums of squares S compare directly:
///
///   evidence = ½ N ln(S_unit / S_saturation)

#include <vector>

namespace halyard {

/// independent: N, number of independent samples. NaN in x or y counts as missing. Without samples: 0.
double evidence_of_saturation(const std::vector<double>& x, const std::vector<double>& y, double least_factor,
                              double largest_factor, double independent);

}  // namespace halyard
