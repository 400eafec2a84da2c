#pragma once
/// A signal as a function of another: least squares with hat functions. Knots are quantiles, with equal numbers of
/// samples between them.
///
///   ŷ(x) = Σ_b c_b h_b(x),   h_b(x_b) = 1, linear to 0 at the neighbours' knots
///
/// One curve, or one for each direction of motion; over an angle, periodic.

#include <vector>

namespace halyard {

/// Knots of one curve, and its values there.
struct Curve {
  double direction = 0;  ///< 1 | -1: direction of the motion for which the curve holds; 0: both directions
  std::vector<double> x, y;
};

struct CurveFit {
  std::vector<Curve> curves;
  double explained = 0;  ///< R², of the variance of y
  int numbers = 0;       ///< of fitted coefficients, B
  double swing() const;  ///< largest value minus smallest value
};

/// x, y, and direction (1 | -1; empty: one curve for both) have equal lengths; samples that are not finite do not
/// count. Equal knots are merged: two are left if x is a direction. `period` 0: not periodic; otherwise x is in
/// [0, period).
CurveFit fit_curve(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& direction,
                   int knots, double period);

}  // namespace halyard
