#pragma once
/// Least-squares spectrum of samples that need not be evenly spaced, over time or over an angle: at each frequency, the
/// share of the variance that a sine plus a constant explains.
///
///   y_i ≈ c + a cos(2π f x_i) + b sin(2π f x_i),   share = 1 - |y - ŷ|² / |y - ȳ|²
///
/// Source: Lomb, Astrophys. Space Sci. 39 (1976); with the floating constant Zechmeister, Kürster, A&A 496 (2009).

#include <vector>

namespace halyard {

struct Spectrum {
  std::vector<double> frequency;  ///< per unit of x
  std::vector<double> share;      ///< [frequency] 0 to 1
  std::vector<double> amplitude;  ///< [frequency] of that sine, unit of y
};

/// The strongest line; share 0 if there is none.
struct Line {
  double frequency = 0, share = 0, amplitude = 0;
};

/// Frequencies lowest, lowest + step, ... up to highest. Samples where x or y is not finite do not count. Throws
/// std::invalid_argument if x and y differ in length or step is not positive.
Spectrum spectrum(const std::vector<double>& x, const std::vector<double>& y, double lowest, double highest,
                  double step);

Line strongest_line(const Spectrum& spectrum);

}  // namespace halyard
