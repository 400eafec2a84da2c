/// The tension of a cable over its stretch.

#include "transmission/cable_law.h"
#include "tests/support/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "transmission/arm_parameters.h"

namespace halyard {
namespace {

constexpr CableLaw kLaws[] = {CableLaw::paper, CableLaw::exponential, CableLaw::linear};

/// Joint 2 of the RAVEN-II.
JointParameters<double> cable(CableLaw law) {
  JointParameters<double> j;
  j.law = law;
  j.stiffness = 88e3;
  j.damping = 1380;
  j.tension = 43.1;
  return j;
}

JointParameters<Dual> dual_cable(CableLaw law) {
  ArmParameters<double> arm;
  arm.n = 1;
  arm.joint[0] = cable(law);
  return lift<Dual>(arm).joint[0];
}

TEST(CableLaw, HasTheSlopeOfBothRunsAtRestAndTwiceTheirDamping) {
  for (const CableLaw law : kLaws) {
    const JointParameters<Dual> j = dual_cable(law);
    const Dual g = cable_force(j, Dual::seed(0, 0), Dual::seed(0, 1));
    // Two products, a quotient and a sum.
    EXPECT_NEAR(g.d[0], 2 * 88e3, 4 * kEps * 2 * 88e3);
    EXPECT_NEAR(g.d[1], 2 * 1380, 4 * kEps * 2 * 1380);
    EXPECT_EQ(g.a, 0);
  }
}

TEST(CableLaw, IsOdd) {
  for (const CableLaw law : kLaws) {
    const JointParameters<double> j = cable(law);
    for (const double x : {1e-5, 2e-4, 1e-3})
      for (const double rate : {-0.05, 0.0, 0.01}) EXPECT_EQ(cable_force(j, -x, -rate), -cable_force(j, x, rate));
  }
}

TEST(CableLaw, RunsPullApartByTheForceDifference) {
  for (const CableLaw law : kLaws) {
    const JointParameters<double> j = cable(law);
    for (const double x : {-3e-3, -1e-4, 0.0, 2e-4, 1e-3}) {
      const RunTensions<double> t = run_tensions(j, x, 0.01);
      const double g = cable_force(j, x, 0.01);
      EXPECT_NEAR(t.forward - t.backward, g, 4 * kEps * std::max(std::abs(g), 2 * j.tension));
    }
  }
}

TEST(CableLaw, LinearCableGoesSlackWhereTheRestTensionIsUsedUp) {
  const JointParameters<double> j = cable(CableLaw::linear);
  const double slack = j.tension / j.stiffness;
  EXPECT_GT(run_tensions(j, 0.99 * slack, 0.0).backward, 0);
  EXPECT_EQ(run_tensions(j, 1.01 * slack, 0.0).backward, 0);
  EXPECT_EQ(run_tensions(j, -1.01 * slack, 0.0).forward, 0);
  // One run carries on alone: half the slope.
  const double beyond = cable_force(j, 3 * slack, 0.0) - cable_force(j, 2 * slack, 0.0);
  EXPECT_NEAR(beyond, j.stiffness * slack, 8 * kEps * 4 * j.tension);
}

TEST(CableLaw, NoRunOfAnExponentialOrLinearCablePushesHoweverFastItIsLetGo) {
  for (const CableLaw law : {CableLaw::exponential, CableLaw::linear})
    for (const double x : {-1e-3, 0.0, 1e-3})
      for (const double rate : {-10.0, 10.0}) {
        const RunTensions<double> t = run_tensions(cable(law), x, rate);
        EXPECT_GE(t.forward, 0);
        EXPECT_GE(t.backward, 0);
      }
}

TEST(CableLaw, PaperLawCarriesNoTensionAndNeverGoesSlack) {
  JointParameters<double> j = cable(CableLaw::paper);
  const double g = cable_force(j, 2e-3, 0.0);
  EXPECT_LT(run_tensions(j, 2e-3, 0.0).backward, 0);
  j.tension = 0;
  EXPECT_EQ(cable_force(j, 2e-3, 0.0), g);
}

TEST(CableLaw, ExponentialCableStaysFiniteAtStretchesThatNoCableSurvives) {
  const JointParameters<double> j = cable(CableLaw::exponential);
  EXPECT_TRUE(std::isfinite(cable_force(j, 1e3, 0.0)));
  EXPECT_EQ(cable_force(j, 1e3, 0.0), cable_force(j, 30 * j.tension / j.stiffness, 0.0));
}

TEST(CableLaw, StoredEnergyIsTheIntegralOfTheForce) {
  for (const CableLaw law : kLaws) {
    const JointParameters<double> j = cable(law);
    const double slack = j.tension / j.stiffness;  // a kink of the linear law: a piece on either side
    const auto force = [&](double x) { return cable_force(j, x, 0.0); };
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 15>;
    for (const double x : {0.3 * slack, 2.5 * slack, -2.5 * slack}) {
      const double middle = std::clamp(x, -slack, slack);
      const double work = Quadrature::integrate(force, 0.0, middle, 5, 1e-13) +
                          (middle == x ? 0 : Quadrature::integrate(force, middle, x, 5, 1e-13));
      // cosh(x) - 1 of the paper's law has lost 2 eps / x² of itself: 1e-8 at 0.15 mm.
      const double cancelled = law == CableLaw::paper ? 2 * kEps / (x * x) : 0;
      EXPECT_NEAR(cable_energy(j, x), work, (1e-12 + cancelled) * work);
    }
  }
}

TEST(CableLaw, ARunThatIsLetGoFastHasNoTensionAtAll) {
  for (const CableLaw law : {CableLaw::exponential, CableLaw::linear}) {
    // The damper would take 1380 N off a tension of 43 N.
    EXPECT_EQ(run_tensions(cable(law), 0.0, 1.0).backward, 0);
    EXPECT_EQ(run_tensions(cable(law), 0.0, -1.0).forward, 0);
  }
}

TEST(CableLaw, ExponentialCableIsOddAlsoBeyondItsBound) {
  const JointParameters<double> j = cable(CableLaw::exponential);
  for (const double exponent : {29.5, 30.5, 1e3}) {
    const double x = exponent * j.tension / j.stiffness;
    EXPECT_EQ(cable_force(j, -x, 0.0), -cable_force(j, x, 0.0)) << exponent;
  }
}

}  // namespace
}  // namespace halyard
