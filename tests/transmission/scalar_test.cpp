/// Dual numbers against finite differences, lanes against plain numbers.

#include "transmission/scalar.h"
#include "tests/support/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace halyard {
namespace {

struct OneArgument {
  const char* name;
  double (*plain)(double);
  Dual (*dual)(Dual);
  Lanes (*lanes)(Lanes);
  double lower, upper;
  bool of_library;  ///< a double's is the C library's; that of lanes is good to 4 ulp (lane_math.h)
};
#define HALYARD_ONE(expression)                                                             \
  [](double x) -> double { return expression; }, [](Dual x) -> Dual { return expression; }, \
      [](Lanes x) -> Lanes { return expression; }
const OneArgument kOneArgument[] = {
    {"sin", HALYARD_ONE(sin(x)), -3, 3, true},     {"cos", HALYARD_ONE(cos(x)), -3, 3, true},
    {"tanh", HALYARD_ONE(tanh(x)), -3, 3, true},   {"exp", HALYARD_ONE(exp(x)), -3, 3, true},
    {"sinh", HALYARD_ONE(sinh(x)), -3, 3, true},   {"log", HALYARD_ONE(log(x)), 0.5, 5, true},
    {"sqrt", HALYARD_ONE(sqrt(x)), 0.5, 5, false}, {"abs", HALYARD_ONE(abs(x)), -3, 3, false},
    {"minus", HALYARD_ONE(-x), -3, 3, false},
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
        // 4 ulp of the function of lanes, 1 of the scalar one; an ulp is at most eps times the value.
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

/// The largest error of f over x in [lower, upper], in ε, relative to scale(exact value).
template <class F, class Exact, class Scale>
double largest_error(const F& f, const Exact& exact, const Scale& scale, double lower, double upper) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(lower, upper);
  double most = 0;
  for (int i = 0; i < 5000; ++i) {
    Lanes x;
    for (int l = 0; l < kLaneWidth; ++l) x.set(l, number(random));
    const Lanes y = f(x);
    for (int l = 0; l < kLaneWidth; ++l) {
      const long double wanted = exact(static_cast<long double>(x[l]));
      most = std::max(most, static_cast<double>(std::abs(y[l] - wanted) / scale(wanted)) / kEps);
    }
  }
  return most;
}

TEST(Lanes, FunctionsKeepTheirErrorBoundsAgainstLongDouble) {
  const auto relative = [](long double wanted) { return std::abs(wanted); };
  const auto absolute = [](long double) { return 1.0L; };
  for (const double reach : {1e-9, 1e-3, 0.3, 1.0, 20.0, 700.0}) {
    EXPECT_LT(largest_error([](const Lanes& x) { return exp(x); }, [](long double x) { return std::exp(x); }, relative,
                            -reach, reach),
              4)
        << reach;
    EXPECT_LT(largest_error([](const Lanes& x) { return tanh(x); }, [](long double x) { return std::tanh(x); },
                            relative, -reach, reach),
              4)
        << reach;
    EXPECT_LT(largest_error([](const Lanes& x) { return sinh(x); }, [](long double x) { return std::sinh(x); },
                            relative, -reach, reach),
              4)
        << reach;
  }
  for (const double reach : {1e-9, 1e-3, 0.7, 3.0, 100.0, 1e5}) {
    EXPECT_LT(largest_error([](const Lanes& x) { return sin(x); }, [](long double x) { return std::sin(x); }, absolute,
                            -reach, reach),
              2)
        << reach;
    EXPECT_LT(largest_error([](const Lanes& x) { return cos(x); }, [](long double x) { return std::cos(x); }, absolute,
                            -reach, reach),
              2)
        << reach;
  }
}

TEST(Lanes, AnEntryDoesNotDependOnTheOthers) {
  for (const auto& f : {+[](Lanes x) { return exp(x); }, +[](Lanes x) { return tanh(x); },
                        +[](Lanes x) { return sinh(x); }, +[](Lanes x) { return sin(x); }})
    for (const double x : {-30.0, -20.0, -19.9, -0.6, -0.49, 1e-3, 0.3, 0.5, 2.0, 18.0, 19.0, 20.0, 25.0})
      for (const double other : {0.0, 0.7, 22.0}) {
        Lanes mixed(x);
        mixed.set(3, other);
        EXPECT_EQ(f(mixed)[0], f(Lanes(x))[0]) << x << " beside " << other;
      }
}

TEST(Lanes, FunctionsKeepNotANumberAndSaturate) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const auto& f : {+[](Lanes x) { return exp(x); }, +[](Lanes x) { return tanh(x); },
                        +[](Lanes x) { return sinh(x); }, +[](Lanes x) { return sin(x); }})
    EXPECT_TRUE(std::isnan(f(Lanes(nan))[2]));
  EXPECT_EQ(tanh(Lanes(inf))[1], 1);
  EXPECT_EQ(tanh(Lanes(-inf))[1], -1);
  EXPECT_EQ(tanh(Lanes(0.0))[1], 0);
  EXPECT_LT(exp(Lanes(-inf))[1], 1e-300);
  EXPECT_GT(sinh(Lanes(inf))[1], 1e300);
}

TEST(Dual, EqualValuesCompareAsPlainNumbersWhateverTheirDerivatives) {
  const Dual one = Dual::seed(1, 0), same = Dual::seed(1, 3);
  EXPECT_FALSE(one < same);
  EXPECT_FALSE(one > same);
  EXPECT_TRUE(one <= same);
  EXPECT_TRUE(one >= same);
}

TEST(Lanes, ThePlainValueIsThatOfTheFirstLane) {
  Lanes lanes(2.0);
  lanes.set(0, 7);
  EXPECT_EQ(value(lanes), 7);
  EXPECT_EQ(value(Dual::seed(3, 1)), 3);
  EXPECT_EQ(value(4.0), 4);
}

TEST(Lanes, ExponentialsStayWhatTheyAreBeyondTheBoundOfTheirArgument) {
  constexpr double kBound = 708;
  for (const auto& f : {+[](Lanes x) { return exp(x); }, +[](Lanes x) { return sinh(x); }})
    for (const double way : {1.0, -1.0})
      for (const double x : {708.5, 1e3}) EXPECT_EQ(f(Lanes(way * x))[0], f(Lanes(way * kBound))[0]) << way * x;
}

TEST(Lanes, AMaskHasAllEntriesOnlyIfItHasEach) {
  // Wider than a register of this file, whose entries are then looked at one by one.
  typedef long long Entries __attribute__((vector_size(8 * kLaneWidth)));
  EXPECT_TRUE(lane_math::all(~Entries{}));
  EXPECT_FALSE(lane_math::all(Entries{}));
  for (int i = 0; i < kLaneWidth; ++i) {
    Entries one_less = ~Entries{};
    one_less[i] = 0;
    EXPECT_FALSE(lane_math::all(one_less)) << i;
  }
}

}  // namespace
}  // namespace halyard
