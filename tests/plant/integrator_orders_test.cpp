/// Observed orders of the integrators on a smooth motion.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/plant/smooth_arm.h"

namespace halyard {
namespace {

struct Reached {
  Eigen::VectorXd y;     ///< at the end
  long derivatives = 0;  ///< evaluated
};

/// One second, in equal stretches between ticks.
Reached run(const IntegratorOptions& options, int ticks) {
  SmoothMotion motion;
  const auto integrator = make_integrator(motion.plant, options, 0, motion.start);
  const long before = motion.plant.derivative_evaluations();
  for (int tick = 1; tick <= ticks; ++tick) integrator->advance(static_cast<double>(tick) / ticks);
  return {integrator->state(), motion.plant.derivative_evaluations() - before};
}

/// Error of all states but the meters, against steps so short that they err by 4e-12 (two methods differ by that).
double error_of(const Reached& reached) {
  static const Eigen::VectorXd exact = run({IntegratorKind::explicit_rk, 1e-13, 1e-15}, 1).y;
  return (reached.y - exact).head(exact.size() - 2).norm();
}

/// Slope of log y over log x, by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double a = 0, b = 0, aa = 0, ab = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    a += u, b += v, aa += u * u, ab += u * v;
  }
  return (n * ab - a * b) / (n * aa - a * a);
}

/// With tolerances that no step misses, explicit and linearly implicit methods take one step a tick.
TEST(IntegratorOrder, IsFourOverEqualSteps) {
  for (const IntegratorKind kind :
       {IntegratorKind::rosenbrock, IntegratorKind::explicit_rk, IntegratorKind::simbody_rkm}) {
    std::vector<double> step, error;
    for (const int ticks : {100, 200, 400}) {
      step.push_back(1.0 / ticks);
      // Simbody takes no accuracy of 1 or more; its steps err by less than a thousandth of this one.
      error.push_back(error_of(run({kind, kind == IntegratorKind::simbody_rkm ? 0.99 : 1e6, 1e6}, ticks)));
    }
    std::printf("%s: order %.2f\n", integrator_names().at(kind).c_str(), slope(step, error));
    // The next term of the error is a hundredth of the first at these steps. Observed: 3.96 to 4.03.
    EXPECT_NEAR(slope(step, error), 4, 0.1) << integrator_names().at(kind);
  }
}

/// Newton's method ends by the tolerance of a step. So the steps of implicit methods are chosen by that tolerance, and
/// the number of derivatives stands for that of steps.
TEST(IntegratorOrder, OfImplicitMethodsIsSeenOverTheirDerivatives) {
  for (const auto& [kind, order] : {std::pair(IntegratorKind::dirk, 3), std::pair(IntegratorKind::imex, 4),
                                    std::pair(IntegratorKind::imex_link1, 4)}) {
    std::vector<double> derivatives, error;
    for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      const Reached at = run({kind, tolerance, 0.01 * tolerance}, 1);
      derivatives.push_back(static_cast<double>(at.derivatives)), error.push_back(error_of(at));
    }
    std::printf("%s: order %.2f\n", integrator_names().at(kind).c_str(), -slope(derivatives, error));
    // Empirical: 3.3, 3.9 and 4.2. A step takes more iterations of Newton's method the longer it is.
    EXPECT_NEAR(-slope(derivatives, error), order, 0.4) << integrator_names().at(kind);
  }
}

TEST(IntegratorOrder, ErrorsAreProportionalToTheTolerance) {
  for (const auto& [kind, name] : integrator_names()) {
    // bdf sets its own tolerances to 1e-5 times these.
    const double unit = kind == IntegratorKind::bdf ? 1e5 : 1;
    std::vector<double> tolerances, error;
    for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      tolerances.push_back(tolerance);
      error.push_back(error_of(run({kind, unit * tolerance, 0.01 * unit * tolerance}, 1)));
    }
    std::printf("%s: error ~ tolerance^%.2f, %.1e at 1e-6\n", name.c_str(), slope(tolerances, error), error[2]);
    // Empirical: 0.77 to 1.02. Methods of variable order gain less, because their order rises with the tolerance.
    EXPECT_NEAR(slope(tolerances, error), 0.9, 0.25) << name;
    EXPECT_LT(error[2], 2e-4) << name;  // of rates of 10 rad/s at tolerances of 1e-6; bdf: 1.2e-4
  }
}

}  // namespace
}  // namespace halyard
