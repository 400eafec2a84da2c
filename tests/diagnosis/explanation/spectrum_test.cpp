/// Spectra in closed form: shares, amplitudes and frequencies of sines at even and uneven places.

#include "diagnosis/explanation/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace halyard {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

/// y = Σ amplitude sin(2 π frequency x + phase) at 1000 places over 10.
struct Sines {
  std::vector<double> x, y;
  explicit Sines(const std::vector<std::array<double, 3>>& parts, double constant = 0) {
    for (int i = 0; i < 1000; ++i) {
      x.push_back(0.01 * i);
      double sum = constant;
      for (const auto& [amplitude, frequency, phase] : parts)
        sum += amplitude * std::sin(kTwoPi * frequency * x.back() + phase);
      y.push_back(sum);
    }
  }
};

TEST(Spectrum, OfTwoSinesSharesTheVarianceByTheirSquares) {
  const Sines s({{3, 1, 0.4}, {4, 2.5, 1.1}}, 20);  // whole periods: orthogonal
  const Spectrum found = spectrum(s.x, s.y, 0.5, 3, 0.5);
  ASSERT_EQ(found.frequency.size(), 6u);
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_NEAR(found.frequency[f], 0.5 * (static_cast<double>(f) + 1), 1e-12);
    const double amplitude = f == 1 ? 3 : f == 4 ? 4 : 0;
    // A thousand roundings of numbers of 20, and what they leave of the share at its square root.
    EXPECT_NEAR(found.amplitude[f], amplitude, 1e-10) << f;
    EXPECT_NEAR(found.share[f], amplitude * amplitude / 25, 1e-10) << f;
  }
  const Line line = strongest_line(found);
  EXPECT_NEAR(line.frequency, 2.5, 1e-12);
  EXPECT_NEAR(line.share, 16.0 / 25, 1e-10);
}

TEST(Spectrum, ShareOfASineIsWholeWhateverItsPhaseAndHoweverFewItsPeriods) {
  // Over 0.3 of a period sine, cosine and constant are not orthogonal.
  for (const double phase : {0.0, 0.7, 1.6, 3.0, 4.4}) {
    const Sines s({{2, 0.03, phase}}, -5);
    const Spectrum found = spectrum(s.x, s.y, 0.03, 0.03, 0.01);
    ASSERT_EQ(found.frequency.size(), 1u);
    EXPECT_NEAR(found.share[0], 1, 1e-8) << phase;
    EXPECT_NEAR(found.amplitude[0], 2, 1e-6) << phase;
  }
}

TEST(Spectrum, WhereAllSamplesSeeOnePhaseNothingIsTold) {
  std::vector<double> x, y;
  for (int i = 0; i < 50; ++i) x.push_back(i), y.push_back(i % 2);
  const Spectrum found = spectrum(x, y, 1, 2, 0.5);  // sampled once a period, and at two of a half
  EXPECT_EQ(found.amplitude[0], 0);
  EXPECT_EQ(found.share[0], 0);
  EXPECT_EQ(found.amplitude[2], 0);
}

TEST(Spectrum, EndsWithItsHighestFrequencyAndIsEmptyBelowItsLowest) {
  const Sines s({{1, 1, 0}});
  EXPECT_EQ(spectrum(s.x, s.y, 0.1, 1, 0.1).frequency.size(), 10u);
  EXPECT_EQ(spectrum(s.x, s.y, 0.1, 0.99, 0.1).frequency.size(), 9u);
  EXPECT_TRUE(spectrum(s.x, s.y, 1, 0.5, 0.1).frequency.empty());
  EXPECT_TRUE(spectrum({1, 2}, {5, 5}, 0.1, 1, 0.1).frequency.empty()) << "a constant";
  EXPECT_TRUE(spectrum({}, {}, 0.1, 1, 0.1).frequency.empty());
  EXPECT_EQ(strongest_line({}).share, 0);
}

TEST(Spectrum, RefusesColumnsOfTwoLengthsAndAStepOfZero) {
  EXPECT_THROW(spectrum({1, 2}, {1}, 0.1, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(spectrum({1, 2}, {1, 2}, 0.1, 1, 0), std::invalid_argument);
}

TEST(Spectrum, EndsWithItsHighestFrequencyHoweverStepsRound) {
  const Sines s({{1, 1, 0}});
  ASSERT_LT((0.7 - 0.1) / 0.1, 6) << "the test shows nothing";
  EXPECT_EQ(spectrum(s.x, s.y, 0.1, 0.7, 0.1).frequency.size(), 7u);
}

}  // namespace
}  // namespace halyard
