#pragma once
/// The second-order Runge-Kutta-Chebyshev method with s stages. It is explicit, and on the negative real axis it is
/// stable for λ h >= -2/3 (s² - 1). Friction and cable damping put the arm's fast eigenvalues λ there. It is not stable
/// away from that axis: an arm with oscillating modes needs several steps for each sample.
///
///   growth of a mode over a step h, z = λ h:   |1 - b_s T_s(w0) + b_s T_s(w0 + w1 z)|
///
///   T_s        Chebyshev polynomial
///   w0, w1     1 + 2/13 / s²;  T_s'(w0) / T_s''(w0)
///   b_s        T_s''(w0) / T_s'(w0)²
///
/// Source: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88 (1998).

#include <complex>
#include <vector>

namespace halyard {

/// Coefficients of the method, as in the source.
struct RungeKuttaChebyshev {
  static constexpr int kUsualStages = 48, kMostStages = 256;
  int stages, steps;  ///< stages for each step, steps for each sample
  double mu[kMostStages + 1], nu[kMostStages + 1], mu_h[kMostStages + 1], gamma_h[kMostStages + 1],
      node[kMostStages + 1];
};

/// Eigenvalues of a system's Jacobian, 1/s.
using Eigenvalues = std::vector<std::complex<double>>;

/// Number of stages that keeps steps of h stable along the real axis, with a margin of a fifth; 0 if more than `most`
/// are needed, which is at most kMostStages.
int stages_for(const std::vector<Eigenvalues>& spectra, double h, int most);

/// The fastest eigenvalue for which kUsualStages are enough, 1/s.
double fastest_stable(double h);

/// The method that suits several systems at once with the fewest steps for each sample, and then with the fewest stages
/// for each step. Each system is given by the spectra at some of its states.
RungeKuttaChebyshev scheme_for(const std::vector<std::vector<Eigenvalues>>& systems, double sample_s);

}  // namespace halyard
