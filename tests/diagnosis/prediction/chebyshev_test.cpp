/// The Runge-Kutta-Chebyshev method against the polynomial that it is made of.

#include "diagnosis/motion/chebyshev.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/limits.h"

namespace halyard {
namespace {

/// The method for y' = -rate y over a sample of 1 s: one step, with stages enough for it.
RungeKuttaChebyshev method_for_decay(double rate) { return scheme_for({{{-rate}}}, 1); }

/// T_s and its first two derivatives beyond 1, with w = cosh θ.
struct ChebyshevAbove {
  double T, d, dd;
  ChebyshevAbove(int s, double w) {
    const double theta = std::acosh(w), ratio = s * std::sinh(s * theta) / std::sinh(theta);
    T = std::cosh(s * theta);
    d = ratio;
    dd = (s * s * T - ratio * w) / (w * w - 1);
  }
};

double chebyshev(int s, double w) {
  if (std::abs(w) <= 1) return std::cos(s * std::acos(w));
  return (w < 0 && s % 2 == 1 ? -1 : 1) * std::cosh(s * std::acosh(std::abs(w)));
}

/// Growth of a mode over a step by the header's formula.
struct StabilityPolynomial {
  int s;
  double w0, w1, b, T;
  explicit StabilityPolynomial(int stages) : s(stages), w0(1 + 2.0 / 13 / (stages * stages)) {
    const ChebyshevAbove at(s, w0);
    w1 = at.d / at.dd, b = at.dd / (at.d * at.d), T = at.T;
  }
  double operator()(double z) const { return 1 - b * T + b * chebyshev(s, w0 + w1 * z); }
  /// Where the polynomial leaves the band of its ripples.
  double end() const { return (w0 + 1) / w1; }
};

/// A step of y' = f(t, y) by the recurrence of the source, equation 2.3.
double step(const RungeKuttaChebyshev& c, const std::function<double(double, double)>& f, double t, double y,
            double h) {
  const double f0 = f(t, y);
  double before = y, now = y + c.mu_h[1] * h * f0;
  for (int j = 2; j <= c.stages; ++j) {
    const double rate = f(t + c.node[j - 1] * h, now);
    const double next =
        (1 - c.mu[j] - c.nu[j]) * y + c.mu[j] * now + c.nu[j] * before + c.mu_h[j] * h * rate + c.gamma_h[j] * h * f0;
    before = now, now = next;
  }
  return now;
}

TEST(Chebyshev, GrowsTheLinearTestEquationByItsPolynomial) {
  for (const double rate : {1.0, 10.0, 100.0, 1000.0}) {
    const RungeKuttaChebyshev c = method_for_decay(rate);
    const StabilityPolynomial growth(c.stages);
    for (double z = 0; z >= -growth.end(); z -= growth.end() / 50) {
      const double y = step(
          c, [&](double, double y) { return z * y; }, 0, 1, 1);
      // A stage rounds some ten times, terms of up to 4, and what it errs by grows with the square of the stages that
      // follow (Verwer, Hundsdorfer, Sommeijer 1990). Observed: half of this.
      EXPECT_NEAR(y, growth(z), 40 * c.stages * c.stages * kEps) << c.stages << " stages, z = " << z;
    }
  }
}

TEST(Chebyshev, IsStableAsFarAsItsStagesReachAndNoFurther) {
  for (const double rate : {10.0, 30.0, 1000.0, 30000.0}) {  // 6, 9, 44, 234 stages
    const RungeKuttaChebyshev c = method_for_decay(rate);
    const StabilityPolynomial growth(c.stages);
    const auto after = [&](double z) {
      return step(
          c, [&](double, double y) { return z * y; }, 0, 1, 1);
    };
    // 2/3 (s² - 1), less the 2/15 of the damping 2/13 that the ripples are held below 1 by.
    EXPECT_NEAR(growth.end() / (2.0 / 3 * (c.stages * c.stages - 1)), 1 - 2.0 / 15 * 2 / 13, 0.01);
    for (double part = 0.01; part <= 1; part += 0.01) EXPECT_LT(std::abs(after(-part * growth.end())), 1) << part;
    EXPECT_GT(std::abs(after(-1.05 * growth.end())), 1) << c.stages << " stages";
  }
}

TEST(Chebyshev, IsOfSecondOrder) {
  const RungeKuttaChebyshev c = method_for_decay(20);
  // y' = -20 (y² - cos² t) - sin t, solved by cos t: nonlinear, and the right side depends on time.
  const auto f = [](double t, double y) { return -20 * (y * y - std::cos(t) * std::cos(t)) - std::sin(t); };
  const auto error = [&](int steps) {
    double y = 1;
    for (int i = 0; i < steps; ++i) y = step(c, f, i / double(steps), y, 1.0 / steps);
    return std::abs(y - std::cos(1.0));
  };
  const double coarse = error(200), middle = error(400), fine = error(800);
  // 2 in the limit of small steps; the next term of the error is a few percent of it here.
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.15);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.08);
}

TEST(Chebyshev, TakesStagesForTheFastestModeAndAFifthMore) {
  for (const double rate : {0.5, 5.0, 50.0, 500.0}) {
    const int stages = stages_for({{-rate}, {-rate / 7}}, 1, RungeKuttaChebyshev::kMostStages);
    EXPECT_GE(StabilityPolynomial(stages).end(), 1.2 * rate);
    // One stage is spare, and rounding up takes another.
    if (stages > 4) {
      EXPECT_LT(StabilityPolynomial(stages - 2).end(), 1.2 * rate);
    }
  }
  EXPECT_EQ(stages_for({{-1e6}}, 1, RungeKuttaChebyshev::kMostStages), 0) << "more than the method has room for";
}

TEST(Chebyshev, HasStagesForTheFastestModeThatItCallsStable) {
  for (const double h : {0.0005, 0.001, 0.002, 0.003, 0.004, 0.005, 0.01, 0.03}) {
    const double fastest = fastest_stable(h);
    for (const std::complex<double> direction : {std::polar(1.0, 2.3), std::polar(1.0, 3.0), {-1.0, 0.0}})
      EXPECT_GT(stages_for({{fastest * direction}}, h, RungeKuttaChebyshev::kUsualStages), 0) << h << " " << direction;
    EXPECT_EQ(stages_for({{-1.01 * fastest}}, h, RungeKuttaChebyshev::kUsualStages), 0) << h;
  }
}

TEST(Chebyshev, TakesSeveralStepsForAModeThatRings) {
  EXPECT_EQ(scheme_for({{{{-50, 0}}}}, 1).steps, 1);
  const RungeKuttaChebyshev ringing = scheme_for({{{{-1, 20}, {-1, -20}}}}, 1);
  EXPECT_GT(ringing.steps, 1);
  // Several systems at once: enough for each.
  const RungeKuttaChebyshev both = scheme_for({{{{-1, 20}, {-1, -20}}}, {{{-400, 0}}}}, 1);
  EXPECT_GE(both.steps, ringing.steps);
  EXPECT_GE(StabilityPolynomial(both.stages).end(), 400.0 / both.steps);
}

}  // namespace
}  // namespace halyard
