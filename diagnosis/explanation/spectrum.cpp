#include "diagnosis/explanation/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace halyard {

Spectrum spectrum(const std::vector<double>& x, const std::vector<double>& y, double lowest, double highest,
                  double step) {
  if (x.size() != y.size()) throw std::invalid_argument("spectrum: x and y differ in length");
  if (!(step > 0)) throw std::invalid_argument("spectrum: the step has to be positive");
  std::vector<double> at, value;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) at.push_back(x[i]), value.push_back(y[i]);
  const double n = static_cast<double>(value.size());
  double mean = 0, power = 0;
  for (const double v : value) mean += v / n;
  for (double& v : value) v -= mean, power += v * v;
  Spectrum s;
  if (!(power > 0)) return s;

  // Each sample's phasor turns by the same angle from one frequency to the next.
  std::vector<std::complex<double>> phasor, turn;
  for (const double x_i : at) {
    phasor.push_back(std::polar(1.0, 2 * std::numbers::pi * lowest * x_i));
    turn.push_back(std::polar(1.0, 2 * std::numbers::pi * step * x_i));
  }
  const auto count = static_cast<std::size_t>(std::max(0.0, std::floor((highest - lowest) / step + 1e-9) + 1));
  for (std::size_t f = 0; f < count; ++f) {
    double c = 0, q = 0, cc = 0, cs = 0, yc = 0, ys = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const double re = phasor[i].real(), im = phasor[i].imag();
      c += re, q += im, cc += re * re, cs += re * im;
      yc += value[i] * re, ys += value[i] * im;
      phasor[i] = {re * turn[i].real() - im * turn[i].imag(), re * turn[i].imag() + im * turn[i].real()};
    }
    const double ss = n - cc - q * q / n;
    cc -= c * c / n, cs -= c * q / n;
    const double det = cc * ss - cs * cs;
    // Samples that all see the same phase tell nothing of this frequency.
    const bool told = det > 1e-9 * n * n;
    const double a = told ? (ss * yc - cs * ys) / det : 0, b = told ? (cc * ys - cs * yc) / det : 0;
    s.frequency.push_back(lowest + step * static_cast<double>(f));
    s.share.push_back((a * yc + b * ys) / power);
    s.amplitude.push_back(std::hypot(a, b));
  }
  return s;
}

Line strongest_line(const Spectrum& s) {
  Line best;
  for (std::size_t f = 0; f < s.frequency.size(); ++f)
    if (s.share[f] > best.share) best = {s.frequency[f], s.share[f], s.amplitude[f]};
  return best;
}

}  // namespace halyard
