#include "diagnosis/motion/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halyard {
namespace {

struct ChebyshevPolynomial {
  std::vector<double> T, d, dd;  ///< Chebyshev polynomials and their first two derivatives at w0
  double w0, w1;

  explicit ChebyshevPolynomial(int stages) : w0(1 + 2.0 / 13 / (stages * stages)) {
    T = {1, w0}, d = {0, 1}, dd = {0, 0};
    for (int j = 2; j <= stages; ++j) {
      T.push_back(2 * w0 * T[j - 1] - T[j - 2]);
      d.push_back(2 * T[j - 1] + 2 * w0 * d[j - 1] - d[j - 2]);
      dd.push_back(4 * d[j - 1] + 2 * w0 * dd[j - 1] - dd[j - 2]);
    }
    w1 = d[stages] / dd[stages];
  }
  /// By how much a step grows a mode, z = λ h.
  double growth(std::complex<double> z) const {
    const int s = static_cast<int>(T.size()) - 1;
    std::complex<double> before = 1, now = w0 + w1 * z;
    for (int j = 2; j <= s; ++j) before = std::exchange(now, 2.0 * (w0 + w1 * z) * now - before);
    const double b = dd[s] / (d[s] * d[s]);
    return std::abs(1 - b * T[s] + b * now);
  }
};

/// The modes change along the motion: a fifth in reserve.
constexpr double kReserve = 1.2;

/// True if no mode grows that does not grow by itself.
bool is_stable(const std::vector<Eigenvalues>& spectra, const ChebyshevPolynomial& method, double h) {
  constexpr double kSlight = 1e-6;
  for (const Eigenvalues& spectrum : spectra)
    for (const std::complex<double>& rate : spectrum)
      for (const std::complex<double>& z : {rate * h, kReserve * rate * h})
        if (method.growth(z) > std::max(1.0, std::exp(z.real())) + kSlight) return false;
  return true;
}

}  // namespace

int stages_for(const std::vector<Eigenvalues>& spectra, double h, int most) {
  double fastest = 0;
  for (const Eigenvalues& spectrum : spectra)
    for (const std::complex<double>& rate : spectrum) fastest = std::max(fastest, std::abs(rate));
  const double stages = std::ceil(std::sqrt(1 + 1.5 * kReserve * fastest * h)) + 1;
  return stages > most ? 0 : static_cast<int>(stages);
}

double fastest_stable(double h) {
  constexpr int kStages = RungeKuttaChebyshev::kUsualStages - 1;
  constexpr double kRounding = 1e-9;
  return (1 - kRounding) * (kStages * kStages - 1) / (1.5 * kReserve * h);
}

RungeKuttaChebyshev scheme_for(const std::vector<std::vector<Eigenvalues>>& systems, double sample_s) {
  constexpr int kMostSteps = 8;
  RungeKuttaChebyshev c;
  for (c.steps = 1;; ++c.steps) {
    const double h = sample_s / c.steps;
    c.stages = 2;
    for (const auto& spectra : systems)
      c.stages = std::max(c.stages, stages_for(spectra, h, RungeKuttaChebyshev::kMostStages));
    const ChebyshevPolynomial method(c.stages);
    if (c.steps == kMostSteps || std::ranges::all_of(systems, [&](const auto& s) { return is_stable(s, method, h); }))
      break;
  }
  const ChebyshevPolynomial method(c.stages);
  const std::vector<double>&T = method.T, &d = method.d, &dd = method.dd;
  std::vector<double> b(c.stages + 1), a(c.stages + 1);
  for (int j = 2; j <= c.stages; ++j) b[j] = dd[j] / (d[j] * d[j]);
  b[0] = b[1] = b[2];
  for (int j = 0; j <= c.stages; ++j) a[j] = 1 - b[j] * T[j];
  c.mu_h[1] = b[1] * method.w1;
  for (int j = 2; j <= c.stages; ++j) {
    c.mu[j] = 2 * b[j] * method.w0 / b[j - 1];
    c.nu[j] = -b[j] / b[j - 2];
    c.mu_h[j] = 2 * b[j] * method.w1 / b[j - 1];
    c.gamma_h[j] = -a[j - 1] * c.mu_h[j];
    c.node[j] = method.w1 * dd[j] / d[j];
  }
  c.node[1] = c.node[2] / d[2];
  return c;
}

}  // namespace halyard
