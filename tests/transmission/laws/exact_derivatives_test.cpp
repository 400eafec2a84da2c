/// Derivatives by dual numbers against differences of so high an order that they are as exact, with each effect.
/// Effects cannot be evaluated in long double: they are compiled for the scalars of scalar.h alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/effect_runs.h"
#include "transmission/effects/library.h"

namespace halyard {
namespace {

using Outputs = std::vector<double>;

/// Symmetric difference of eighth order: off by h⁸ / 630 of the ninth derivative, and by some two roundings over h.
Outputs difference(const EvaluatedArm<double>& f, const std::vector<double>& u, int i, double h) {
  constexpr double kWeight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Outputs sum;
  for (int k = 1; k <= 4; ++k) {
    std::vector<double> above = u, below = u;
    above[i] += k * h, below[i] -= k * h;
    const Outputs high = f(above), low = f(below);
    sum.resize(high.size());
    for (std::size_t r = 0; r < sum.size(); ++r) sum[r] += kWeight[k - 1] * (high[r] - low[r]) / h;
  }
  return sum;
}

struct Derivative {
  double value = 0, error = INFINITY;
};

/// Of each output: of several steps, each a third of the one before, the best. The error of a step is what it differs
/// by from the one before, and rounding of the outputs, `value` in size.
std::vector<Derivative> differentiated(const EvaluatedArm<double>& f, const std::vector<double>& u, int i,
                                       const Outputs& value) {
  // A parameter may be a small number that something is divided by.
  const bool is_parameter = i >= 6 * f.nominal.n + f.n_states();
  const double first = is_parameter && u[i] != 0 ? 0.05 * std::abs(u[i]) : 0.02;
  Outputs before = difference(f, u, i, first);
  std::vector<Derivative> best(before.size());
  for (double h = first / 3; h > 1e-3 * first; h /= 3) {
    const Outputs now = difference(f, u, i, h);
    for (std::size_t r = 0; r < now.size(); ++r) {
      const double error = std::abs(now[r] - before[r]) + 4 * kEps * std::abs(value[r]) / h;
      if (error < best[r].error) best[r] = {now[r], error};
    }
    before = now;
  }
  return best;
}

struct Tally {
  int all = 0, told = 0;
  double largest = 0;  ///< relative error
};

void compare(const ArmParameters<double>& arm, const PlacedEffect& effect, std::mt19937_64& random, Tally& tally) {
  constexpr double kBound = 1e-10;
  const EvaluatedArm<double> plain{arm, effect};
  const EvaluatedArm<Dual> dual{arm, effect};
  const std::vector<double> u = random_inputs(plain, random);
  const Outputs value = plain(u);
  for (int i = 0; i < static_cast<int>(u.size()); ++i) {
    std::vector<Dual> seeded(u.begin(), u.end());
    seeded[i] = Dual::seed(u[i], i % kDualWidth);
    const std::vector<Dual> out = dual(seeded);
    const std::vector<Derivative> wanted = differentiated(plain, u, i, value);
    for (std::size_t r = 0; r < out.size(); ++r) {
      const double found = out[r].d[i % kDualWidth];
      // Outputs round relative to themselves; a derivative by a small parameter is as large as output over parameter.
      const double scale = std::max({1.0, std::abs(value[r]), std::abs(found)});
      ++tally.all;
      if (!(wanted[r].error < 0.3 * kBound * scale)) continue;  // a kink is near
      ++tally.told;
      tally.largest = std::max(tally.largest, std::abs(found - wanted[r].value) / scale);
      EXPECT_NEAR(found, wanted[r].value, kBound * scale)
          << effect_label(effect) << ": output " << r << " by input " << i;
    }
  }
}

TEST(ExactDerivatives, OfEveryEffectAreThoseOfDifferencesToTenDigits) {
  std::mt19937_64 random(7);
  Tally tally;
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(11, law);
    for (const auto& effect : built_in_effects())
      for (const EffectPlace place : effect_places(*effect, arm)) {
        const std::string name = effect->name();
        Tally own;
        for (int trial = 0; trial < 3; ++trial) compare(arm, placed(name, arm, place, {}), random, own);
        EXPECT_GT(own.told, 0.9 * own.all) << name;
        tally.all += own.all, tally.told += own.told, tally.largest = std::max(tally.largest, own.largest);
      }
  }
  std::printf("%d of %d derivatives told, largest error %.1e\n", tally.told, tally.all, tally.largest);
}

}  // namespace
}  // namespace halyard
