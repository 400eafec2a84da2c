#include "transmission/transmission.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>

#include "tests/support/random_arm.h"
#include "transmission/effects/library.h"
#include "transmission/path_matrix.h"

namespace halyard {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
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

/// All effects of the library at all places of the arm, and none.
std::vector<PlacedEffect> every_effect(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all = {PlacedEffect{}};
  for (const Effect* effect : effect_library())
    for (const int joint : effect_places(*effect, arm)) all.push_back(place_effect(*effect, arm, joint));
  return all;
}

std::string name_of(const PlacedEffect& e) {
  return e.effect ? e.effect->name() + " at joint " + std::to_string(e.joint + 1) : "no effect";
}

// ------------------------------------------------------------------------------------ cable laws

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

// ----------------------------------------------------------------------------- coupling, friction

TEST(Coupling, MotorPowerIsJointPowerAndWhatStretchesTheCables) {
  std::mt19937_64 random(5);
  for (const CableLaw law : kLaws) {
    ArmParameters<double> arm = random_arm(3, law);
    for (int k = 0; k < arm.n; ++k) {
      JointParameters<double>& j = arm.joint[k];
      j.motor_coulomb = j.motor_viscous = j.joint_coulomb = j.joint_viscous = 0;
    }
    const Transmission<double> transmission(arm, {});
    const EvaluatedArm<double> inputs{arm, {}};
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<double> u = random_inputs(inputs, random);
      JointSignals<double> s[kMaxJoints];
      for (int k = 0; k < arm.n; ++k) {
        s[k].motor_angle = u[6 * k + 1];
        s[k].motor_rate = u[6 * k + 2];
        s[k].joint_position = u[6 * k + 3];
        s[k].joint_rate = u[6 * k + 4];
      }
      transmission.evaluate(0, nullptr, nullptr, s, nullptr);
      double motors = 0, joints = 0, cables = 0, size = 0;
      for (int k = 0; k < arm.n; ++k) {
        motors += arm.joint[k].motor_travel() * s[k].cable_force_motor * s[k].motor_rate;
        joints += s[k].joint_force * s[k].joint_rate;
        cables += s[k].cable_force_motor * s[k].stretch_rate;
        size += std::abs(s[k].cable_force_motor) * (std::abs(s[k].motor_rate) + 2);
      }
      // About 10 roundings of terms no larger than |g| (|ω| + Σ|C q'|).
      EXPECT_NEAR(motors, joints + cables, 10 * kEps * size);
      // The balance is one of powers that are there.
      EXPECT_GT(std::abs(joints), 1e3 * 10 * kEps * size);
    }
  }
}

TEST(Coupling, PathAndReactionAreTheMatrixAndItsTranspose) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::paper);
  const Eigen::MatrixXd R = path_matrix(arm);
  const Eigen::Vector3d q(0.3, -0.7, 0.2), g(5, -3, 2);
  double s[kMaxJoints], force[kMaxJoints];
  cable_path(arm, q.data(), s);
  joint_reaction(arm, g.data(), force);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(s[i], (R * q)(i), 6 * kEps);
    EXPECT_NEAR(force[i], (R.transpose() * g)(i), 6 * kEps * 10);
  }
}

TEST(PathMatrix, JointsAndMotorsWithoutStretchAreInverseToEachOther) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    ArmParameters<double> arm = random_arm(seed, CableLaw::paper);
    if (seed % 2) arm.joint[1].drive = Drive::none;
    if (seed % 3 == 0) arm.joint[0].drive = Drive::rigid;
    const Eigen::Vector3d q(0.4, -0.9, 0.15);
    const Eigen::VectorXd back = unstretched_joints(arm, unstretched_motors(arm, q), q);
    // Couplings within ±0.2 make C well-conditioned: a handful of roundings.
    EXPECT_LT((back - q).norm(), 40 * kEps) << seed;
  }
}

TEST(PathMatrix, UnstretchedMeansThatTheTransmissionSeesNoStretch) {
  const ArmParameters<double> arm = random_arm(6, CableLaw::linear);
  const Eigen::Vector3d q(0.4, -0.9, 0.15);
  const Eigen::VectorXd q_m = unstretched_motors(arm, q);
  JointSignals<double> s[kMaxJoints];
  for (int k = 0; k < 3; ++k) s[k].motor_angle = q_m(k), s[k].joint_position = q(k);
  Transmission<double>(arm, {}).evaluate(0, nullptr, nullptr, s, nullptr);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s[k].stretch, 0, 8 * kEps);
}

TEST(PathMatrix, SaysThatSingularCouplingLeavesAJointDirectionWithoutMotor) {
  ArmParameters<double> arm = random_arm(1, CableLaw::paper);
  arm.n = 2;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) arm.joint[i].coupling[k] = 1;
  try {
    unstretched_joints(arm, Eigen::Vector2d(1, 2), Eigen::Vector2d::Zero());
    FAIL() << "no exception";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "coupling matrix [2 x 2] has rank 1: some joint direction moves no motor; "
                 "correct the coupling coefficients");
  }
}

TEST(Friction, OpposesMotionIsOddAndReachesTheCoulombLevel) {
  const double coulomb = 0.5, viscous = 0.01, v_s = 5e-3;
  for (const double v : {1e-4, 5e-3, 0.3, 4.0}) {
    EXPECT_GT(friction(coulomb, viscous, v_s, v), 0);
    // The compiler's tanh of a constant and the library's may differ in the last place.
    EXPECT_NEAR(friction(coulomb, viscous, v_s, -v), -friction(coulomb, viscous, v_s, v), 2 * kEps * coulomb);
  }
  EXPECT_NEAR(friction(coulomb, 0.0, v_s, v_s), coulomb * std::tanh(1.0), kEps);
  EXPECT_NEAR(std::tanh(1.0), 0.76, 0.002);                                  // as the header says
  EXPECT_EQ(friction(coulomb, viscous, v_s, 4.0), coulomb + viscous * 4.0);  // tanh(800) is 1
  const Dual f = friction(Dual(coulomb), Dual(viscous), Dual(v_s), Dual::seed(0, 0));
  EXPECT_NEAR(f.d[0], coulomb / v_s + viscous, 4 * kEps * coulomb / v_s);
}

// ----------------------------------------------------------------------------------- scalar types

struct OneArgument {
  const char* name;
  double (*plain)(double);
  Dual (*dual)(Dual);
  Lanes (*lanes)(Lanes);
  double lower, upper;
  bool of_library;  ///< computed by the C library, whose vector functions are good to 4 ulp
};
#define HALYARD_ONE(expression)                                                             \
  [](double x) -> double { return expression; }, [](Dual x) -> Dual { return expression; }, \
      [](Lanes x) -> Lanes { return expression; }
const OneArgument kOneArgument[] = {
    {"sin", HALYARD_ONE(sin(x)), -3, 3, true},   {"cos", HALYARD_ONE(cos(x)), -3, 3, true},
    {"tanh", HALYARD_ONE(tanh(x)), -3, 3, true}, {"exp", HALYARD_ONE(exp(x)), -3, 3, true},
    {"log", HALYARD_ONE(log(x)), 0.5, 5, true},  {"sqrt", HALYARD_ONE(sqrt(x)), 0.5, 5, false},
    {"abs", HALYARD_ONE(abs(x)), -3, 3, false},  {"minus", HALYARD_ONE(-x), -3, 3, false},
};

struct TwoArguments {
  const char* name;
  double (*plain)(double, double);
  Dual (*dual)(Dual, Dual);
  Lanes (*lanes)(Lanes, Lanes);
};
#define HALYARD_TWO(expression)                                                                               \
  [](double x, double y) -> double { return expression; }, [](Dual x, Dual y) -> Dual { return expression; }, \
      [](Lanes x, Lanes y) -> Lanes { return expression; }
const TwoArguments kTwoArguments[] = {
    {"sum", HALYARD_TWO(x + y)},
    {"difference", HALYARD_TWO(x - y)},
    {"product", HALYARD_TWO(x* y)},
    {"quotient", HALYARD_TWO(x / y)},
    {"max", HALYARD_TWO(max(x, y))},
    {"min", HALYARD_TWO(min(x, y))},
    {"select <", HALYARD_TWO(select(x < y, x* y, x + y))},
    {"select >", HALYARD_TWO(select(x > y, x* y, x + y))},
    {"select <=", HALYARD_TWO(select(x <= y, x* y, x + y))},
    {"select >=", HALYARD_TWO(select(x >= y, x* y, x + y))},
    {"select and", HALYARD_TWO(select(x > y && x * y < 1.0, x, y))},
    {"select or", HALYARD_TWO(select(x > y || x * y < 1.0, x, y))},
    {"chain", HALYARD_TWO(sin(x* y) / (exp(x) + y * y))},
};

// Central differences with step h err by h²/6 f''' and by the rounding of f, eps f / h. Here f, f''' < 60.
constexpr double kStep = 1e-5;
constexpr double kDifferenceError = 60 * (kStep * kStep / 6 + 2 * kEps / kStep);

TEST(Dual, DerivativesOfFunctionsAreThoseOfFiniteDifferences) {
  for (const OneArgument& f : kOneArgument)
    for (int i = 0; i < 40; ++i) {
      const double x = f.lower + (f.upper - f.lower) * (i + 0.5) / 40;
      const Dual y = f.dual(Dual::seed(x, 2));
      EXPECT_EQ(y.a, f.plain(x)) << f.name;
      const double difference = (f.plain(x + kStep) - f.plain(x - kStep)) / (2 * kStep);
      EXPECT_NEAR(y.d[2], difference, kDifferenceError) << f.name << " at " << x;
      EXPECT_EQ(y.d[0], 0) << f.name;
    }
}

TEST(Dual, DerivativesByBothArgumentsAreThoseOfFiniteDifferences) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(-3, 3);
  for (const TwoArguments& f : kTwoArguments)
    for (int i = 0; i < 40; ++i) {
      const double x = number(random);
      double y = number(random);
      y += std::copysign(0.5, y);  // away from the quotient's pole
      const Dual r = f.dual(Dual::seed(x, 0), Dual::seed(y, 3));
      EXPECT_NEAR(r.a, f.plain(x, y), 2 * kEps * std::abs(r.a)) << f.name;
      const double by_x = (f.plain(x + kStep, y) - f.plain(x - kStep, y)) / (2 * kStep);
      const double by_y = (f.plain(x, y + kStep) - f.plain(x, y - kStep)) / (2 * kStep);
      // A quotient's third derivative by y is 6 x / y⁴ < 300 here.
      EXPECT_NEAR(r.d[0], by_x, 5 * kDifferenceError) << f.name << " at " << x << ", " << y;
      EXPECT_NEAR(r.d[3], by_y, 5 * kDifferenceError) << f.name << " at " << x << ", " << y;
      EXPECT_EQ(r.d[1], 0) << f.name;
    }
}

TEST(Lanes, FunctionsAreThoseOfEachLane) {
  for (const OneArgument& f : kOneArgument)
    for (int i = 0; i < 500; ++i) {
      Lanes x;
      for (int l = 0; l < kLaneWidth; ++l)
        x.set(l, f.lower + (f.upper - f.lower) * (kLaneWidth * i + l + 0.5) / (500 * kLaneWidth));
      const Lanes y = f.lanes(x);
      for (int l = 0; l < kLaneWidth; ++l) {
        const double expected = f.plain(x[l]);
        // 4 ulp of the vector function, 1 of the scalar one; an ulp is at most eps times the value.
        EXPECT_NEAR(y[l], expected, f.of_library ? 5 * kEps * std::abs(expected) : 0) << f.name << " at " << x[l];
      }
    }
}

TEST(Lanes, ArithmeticAndChoicesAreThoseOfEachLane) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-3, 3);
  for (const TwoArguments& f : kTwoArguments)
    for (int i = 0; i < 50; ++i) {
      Lanes x, y;
      for (int l = 0; l < kLaneWidth; ++l) x.set(l, number(random)), y.set(l, l == 3 ? x[3] : number(random));
      const Lanes r = f.lanes(x, y);
      for (int l = 0; l < kLaneWidth; ++l) {
        const double expected = f.plain(x[l], y[l]);
        // "chain" calls the library twice and rounds four times; sin(x y) loses up to |x y| ulp by the argument.
        const double tolerance = f.name == std::string("chain") ? 25 * kEps * std::max(1.0, std::abs(expected)) : 0;
        EXPECT_NEAR(r[l], expected, tolerance) << f.name << " at " << x[l] << ", " << y[l];
      }
    }
}

TEST(Transmission, DerivativesAreThoseOfFiniteDifferencesWithEachEffect) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(11, law);
    for (const PlacedEffect& effect : every_effect(arm)) {
      const EvaluatedArm<double> plain{arm, effect};
      const EvaluatedArm<Dual> dual{arm, effect};
      std::mt19937_64 random(7);
      const std::vector<double> u = random_inputs(plain, random);
      const int size = static_cast<int>(u.size());
      for (int i = 0; i < size; ++i) {
        std::vector<Dual> seeded(u.begin(), u.end());
        seeded[i] = Dual::seed(u[i], i % kDualWidth);
        const std::vector<Dual> out = dual(seeded);
        // Parameters may be small numbers that something is divided by.
        const double step = i < 6 * arm.n ? kStep : 0.1 * kStep;
        std::vector<double> above = u, below = u;
        above[i] += step;
        below[i] -= step;
        const std::vector<double> high = plain(above), low = plain(below);
        for (std::size_t r = 0; r < out.size(); ++r) {
          const double difference = (high[r] - low[r]) / (2 * step);
          // Ten roundings of forces up to 100 are 2.2e-13 N; third derivatives reach 1000 by the inputs (T_0 a³ of the
          // exponential law) and 2e4 by the parameters (6 |x'| z / z_y⁴): at most 1.1e-7 from either.
          EXPECT_NEAR(out[r].d[i % kDualWidth], difference, 3e-7 * std::max(1.0, std::abs(difference) / 100))
              << name_of(effect) << ": output " << r << " by input " << i;
        }
      }
    }
  }
}

TEST(Transmission, LanesAreThePlainArmLaneByLaneWithEachEffect) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(12, law);
    for (const PlacedEffect& effect : every_effect(arm)) {
      const EvaluatedArm<double> plain{arm, effect};
      const EvaluatedArm<Lanes> lanes{arm, effect};
      std::mt19937_64 random(8);
      std::vector<std::vector<double>> u;
      for (int l = 0; l < kLaneWidth; ++l) u.push_back(random_inputs(plain, random));
      std::vector<Lanes> packed(u[0].size());
      for (std::size_t i = 0; i < packed.size(); ++i)
        for (int l = 0; l < kLaneWidth; ++l) packed[i].set(l, u[l][i]);
      const std::vector<Lanes> out = lanes(packed);
      for (int l = 0; l < kLaneWidth; ++l) {
        const std::vector<double> expected = plain(u[l]);
        for (std::size_t r = 0; r < out.size(); ++r)
          // Sums of forces up to 100 with about 10 roundings, and 5 eps for each transcendental function in them.
          EXPECT_NEAR(out[r][l], expected[r], 20 * kEps * 100) << name_of(effect) << ": output " << r << ", lane " << l;
      }
    }
  }
}

TEST(Transmission, PackedArmsKeepTheirOwnNumbers) {
  ArmParameters<double> arms[kLaneWidth];
  for (int l = 0; l < kLaneWidth; ++l) arms[l] = random_arm(20 + l, CableLaw::paper);
  const ArmParameters<Lanes> packed = pack(arms);
  EXPECT_EQ(packed.n, 3);
  for (int l = 0; l < kLaneWidth; ++l) {
    EXPECT_EQ(packed.joint[1].stiffness[l], arms[l].joint[1].stiffness);
    EXPECT_EQ(packed.joint[2].coupling[0][l], arms[l].joint[2].coupling[0]);
    EXPECT_EQ(packed.joint[0].inertia[5][l], arms[l].joint[0].inertia[5]);
  }
}

// --------------------------------------------------------------------------------- command history

TEST(CommandHistory, IsLinearBetweenTheMiddlesOfHoldsAndHeldOutside) {
  CommandHistory history(2, 10);
  EXPECT_EQ(history.at(0, 1.0), 0);  // nothing was ever commanded
  const double first[] = {1, -1}, second[] = {3, -2};
  history.push(0.5, first);
  EXPECT_EQ(history.at(1, 7.0), -1);
  history.push(1.0, second);
  EXPECT_EQ(history.at(0, 0.0), 1);
  EXPECT_EQ(history.at(0, 0.75), 1);  // held from 0.5 to 1
  EXPECT_EQ(history.at(0, 1.0), 2);
  EXPECT_EQ(history.at(1, 1.0), -1.5);
  EXPECT_EQ(history.at(0, 1.25), 3);  // the second hold is taken to be as long
  EXPECT_EQ(history.at(0, 9.0), 3);
}

TEST(CommandHistory, IsNeitherEarlyNorLateOnAverage) {
  CommandHistory history(1, 100);
  for (int i = 0; i <= 20; ++i) {
    const double value = 3.0 * i;  // a ramp, in steps
    history.push(i, &value);
  }
  double difference = 0;
  for (double t = 5 + 1.0 / 32; t < 9; t += 1.0 / 16) difference += history.at(0, t) - 3 * std::floor(t);
  EXPECT_NEAR(difference, 0, 64 * 27 * kEps);
}

TEST(CommandHistory, GivesTheSlopeToDualAndEachTimeToItsLane) {
  CommandHistory history(1, 10);
  const double values[] = {0, 2, 1};
  for (int i = 0; i < 3; ++i) history.push(i * 0.5, values + i);
  const Dual d = history.at(0, Dual::seed(0.7, 1) * 2.0);  // at 1.4: after the last
  EXPECT_EQ(d.a, 1);
  EXPECT_EQ(d.d[1], 0);
  const Dual inside = history.at(0, Dual(1.0) - Dual::seed(0.125, 3));  // at 0.875, a delay's derivative
  EXPECT_EQ(inside.a, 1.75);
  EXPECT_EQ(inside.d[3], 2);  // slope -2 N m/s, by minus the delay
  Lanes times;
  for (int l = 0; l < kLaneWidth; ++l) times.set(l, 0.15 * l);
  const Lanes at = history.at(0, times);
  for (int l = 0; l < kLaneWidth; ++l) EXPECT_EQ(at[l], history.at(0, times[l]));
}

TEST(CommandHistory, RemembersItsSpanAndForgetsWhatIsOlder) {
  const double span = 0.1, dt = 1e-3;
  CommandHistory history(1, span);
  for (int i = 0; i < 5000; ++i) {  // far beyond where memory is given back
    const double time = i * dt, command = time;
    history.push(time, &command);
    // Half a hold after a command was given it is in force on average.
    const double asked = std::max(0.5 * dt, time - span);
    ASSERT_NEAR(history.at(0, asked), asked - 0.5 * dt, 8 * kEps * time + 1e-300);
  }
  // What is older than the span is answered by the oldest that is left, at most two samples older.
  EXPECT_NEAR(history.at(0, 0.0), 4.999 - span, 2.01 * dt);
}

}  // namespace
}  // namespace halyard
