/// Statistics that judge estimators: what they say of data whose answer is known.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include "evaluation/judgement/consistency.h"
#include "evaluation/judgement/error_statistics.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

/// x_i = rho x_i-1 + √(1 - rho²) w_i: unit variance, ρ_l = rho^l.
std::vector<double> autoregressive(std::size_t n, double rho, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> x = {normal(random)};
  while (x.size() < n) x.push_back(rho * x.back() + std::sqrt(1 - rho * rho) * normal(random));
  return x;
}

std::vector<double> squared(std::vector<double> x, double scale = 1) {
  for (double& v : x) v = scale * v * v;
  return x;
}

TEST(ErrorStatistics, OfAHundredErrors) {
  std::vector<double> estimate, truth(100, 1);
  for (int i = 0; i < 100; ++i) estimate.push_back(1 + (i % 2 ? -1 : 1) * (100 - i));  // sizes 1 to 100
  estimate.push_back(std::nan("")), truth.push_back(1);
  const ErrorStatistics e = error_statistics(estimate, truth);
  EXPECT_EQ(e.samples, 100);
  EXPECT_EQ(e.median_absolute, 50);
  EXPECT_EQ(e.percentile_95, 95);
  EXPECT_EQ(e.peak, 100);
  EXPECT_EQ(e.mean_absolute, 50.5);
  EXPECT_EQ(e.bias, 0.5);
  EXPECT_TRUE(std::isnan(error_statistics({}, {}).percentile_95));
}

TEST(EffectiveSamples, OfAnAutoregressionAreThoseOfTheory) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    const double expected = 40000 * (1 - rho) / (1 + rho);
    EXPECT_NEAR(effective_samples(autoregressive(40000, rho, 3)) / expected, 1, 0.15) << rho;
  }
  EXPECT_EQ(effective_samples(std::vector<double>(50, 2.0)), 50);
}

TEST(Autocorrelation, OfManyLagsIsThatOfFew) {
  std::vector<double> x = autoregressive(3000, 0.9, 8);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 1e-3 * static_cast<double>(i);
  const std::vector<double> few = autocorrelation(x, 200), many = autocorrelation(x, 2000);
  ASSERT_EQ(many.size(), 2001u);
  for (std::size_t lag = 0; lag < few.size(); ++lag) EXPECT_NEAR(many[lag], few[lag], 1e-12) << lag;
  double sum = 0;  // of all lags on both sides: (Σ (x - mean))² = 0
  for (const double rho : autocorrelation(x, x.size() - 1)) sum += 2 * rho;
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(Autocorrelation, LeavesGapsOut) {
  std::vector<double> x = autoregressive(20000, 0.8, 1);
  const double whole = autocorrelation(x, 1)[1];
  for (std::size_t i = 0; i < x.size(); i += 500) x[i] = kNan;
  EXPECT_NEAR(whole, 0.8, 0.02);
  EXPECT_NEAR(autocorrelation(x, 1)[1], whole, 0.01);
}

TEST(PairedRatio, ContainsTheTruthAsOftenAsItSays) {
  int contained = 0, said_better = 0;
  constexpr int kTrials = 200;
  for (int t = 0; t < kTrials; ++t) {
    // Errors that share most of what they are, and each follow themselves.
    const std::vector<double> shared = autoregressive(3000, 0.9, 3 * t), own_a = autoregressive(3000, 0.9, 3 * t + 1),
                              own_b = autoregressive(3000, 0.9, 3 * t + 2);
    std::vector<double> a, b;
    for (std::size_t i = 0; i < shared.size(); ++i)
      a.push_back(shared[i] + 0.5 * own_a[i]), b.push_back(shared[i] + 0.5 * own_b[i]);
    const PairedRatio r = paired_ratio(a, b);
    contained += r.lower <= 1 && r.upper >= 1;
    for (double& v : a) v *= 0.8;
    said_better += paired_ratio(a, b).better();
  }
  EXPECT_GE(contained, 0.89 * kTrials);
  EXPECT_LE(contained, 0.99 * kTrials);
  EXPECT_GE(said_better, 0.95 * kTrials);
}

/// How often two equal estimators are told apart, of so many records.
int verdicts(int records, std::size_t samples, double rho) {
  int told = 0;
  for (int t = 0; t < records; ++t) {
    const PairedRatio r = paired_ratio(autoregressive(samples, rho, 2 * t), autoregressive(samples, rho, 2 * t + 1));
    told += r.better() || r.worse();
  }
  return told;
}

TEST(PairedRatio, SeldomTellsEqualErrorsApart) {
  constexpr int kRecords = 400;
  // 300, 30 and 8 independent samples. A binomial of the share that the header states, four deviations.
  for (const auto& [samples, rho, share] : {std::tuple(300, 0.0, 0.06), {570, 0.95, 0.08}, {800, 0.99, 0.09}})
    EXPECT_LE(verdicts(kRecords, samples, rho), share * kRecords + 4 * std::sqrt(share * (1 - share) * kRecords))
        << rho;
}

TEST(PairedRatio, HasNoIntervalIfOneErrorIsZeroInABlock) {
  const PairedRatio r = paired_ratio(std::vector{1.0, 1.0}, std::vector{0.0, 3.0});
  EXPECT_EQ(r.lower, 0);
  EXPECT_TRUE(std::isinf(r.upper));
  EXPECT_FALSE(r.better() || r.worse());
}

TEST(PairedRatio, IsTheSameAgainAndNeedsBothErrors) {
  const std::vector<double> a = autoregressive(500, 0.5, 1);
  std::vector<double> b = a;
  for (double& v : b) v *= 2;
  b[7] = kNan;
  const PairedRatio first = paired_ratio(a, b), again = paired_ratio(a, b);
  EXPECT_EQ(first.lower, again.lower);
  EXPECT_NEAR(first.ratio, 0.5, 1e-12);
  EXPECT_NEAR(first.upper, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(paired_ratio({}, {}).ratio));
}

TEST(PairedRatioOfRuns, TellsEqualEstimatorsApartAsSeldomAsItSays) {  // within 0.6 %, of squares like these
  constexpr int kStudies = 1000;
  std::mt19937_64 random(4);
  std::chi_squared_distribution<double> square(20);
  for (const int runs : {2, 3, 5, 10}) {
    int told = 0;
    for (int s = 0; s < kStudies; ++s) {
      std::vector<std::pair<double, double>> squares;
      for (int i = 0; i < runs; ++i) squares.push_back({square(random), square(random)});
      const PairedRatio r = paired_ratio_of_runs(squares);
      told += r.better() || r.worse();
    }
    EXPECT_NEAR(told, 0.05 * kStudies, 4 * std::sqrt(0.05 * 0.95 * kStudies)) << runs;
  }
}

TEST(PairedRatioOfRuns, IsThatOfTheirMeanSquares) {
  std::vector<std::pair<double, double>> squares;
  for (int i = 0; i < 50; ++i) squares.push_back({1 + 0.1 * (i % 5), 4});
  const PairedRatio r = paired_ratio_of_runs(squares);
  EXPECT_NEAR(r.ratio, std::sqrt(1.2 / 4), 1e-12);
  EXPECT_TRUE(r.better());
  EXPECT_LT(r.upper - r.lower, 0.05);
}

TEST(Consistency, PassesAtTheRightNoiseAndFailsAtAWrongOne) {
  int right = 0;
  constexpr int kTrials = 200;
  for (int t = 0; t < kTrials; ++t) {
    const std::vector<double> x = autoregressive(5000, 0.8, t);
    right += consistency(squared(x)).confidence() == Confidence::consistent;
    EXPECT_EQ(consistency(squared(x, 4)).confidence(), Confidence::overconfident);
    EXPECT_EQ(consistency(squared(x, 0.25)).confidence(), Confidence::underconfident);
  }
  EXPECT_GE(right, 0.9 * kTrials);
  EXPECT_EQ(consistency(std::vector<double>(9, kNan)).confidence(), Confidence::unstated);
}

TEST(Consistency, OfUpdatesByThreeMotorsHasABandForThree) {
  int right = 0;
  constexpr int kTrials = 400, kMotors = 3;
  for (int t = 0; t < kTrials; ++t) {
    const std::vector<double> x = autoregressive(kMotors * 1000, 0, t);
    std::vector<double> nis(1000, 0);
    for (std::size_t i = 0; i < x.size(); ++i) nis[i / kMotors] += x[i] * x[i] / kMotors;
    const Consistency c = consistency(nis, kMotors);
    EXPECT_NEAR((c.upper - c.lower) / 2, 1.96 * std::sqrt(2 / (kMotors * c.samples)), 1e-3);
    right += c.confidence() == Confidence::consistent;
    EXPECT_EQ(consistency_of_runs(std::vector{c}).upper, c.upper);
  }
  EXPECT_NEAR(right, 0.95 * kTrials, 4 * std::sqrt(0.95 * 0.05 * kTrials));
}

TEST(Consistency, OfRunsHasTheBandOfAllTheirSamples) {
  const std::vector<Consistency> runs(10, consistency(squared(autoregressive(1000, 0, 5))));
  const Consistency all = consistency_of_runs(runs);
  EXPECT_DOUBLE_EQ(all.samples, 10 * runs[0].samples);
  EXPECT_LT(all.upper - all.lower, 0.5 * (runs[0].upper - runs[0].lower));
  EXPECT_EQ(in_words(consistency(squared(autoregressive(2000, 0, 2), 9))).rfind("too sure: errors are 3", 0), 0u);
}

TEST(Consistency, OfRunsHoldsAsOftenAsItSays) {
  int right = 0;
  constexpr int kTrials = 200, kRuns = 20;
  for (int t = 0; t < kTrials; ++t) {
    std::vector<Consistency> runs;
    for (int r = 0; r < kRuns; ++r) runs.push_back(consistency(squared(autoregressive(1000, 0.9, kRuns * t + r))));
    right += consistency_of_runs(runs).confidence() == Confidence::consistent;
  }
  // Binomial at 95 %, four deviations.
  EXPECT_NEAR(right, 0.95 * kTrials, 4 * std::sqrt(0.95 * 0.05 * kTrials));
}

TEST(Whiteness, SeesNeighboursAndTorques) {
  const std::vector<double> white = autoregressive(5000, 0, 1), torque = autoregressive(5000, 0.99, 2);
  EXPECT_TRUE(whiteness(white, torque).is_white());
  EXPECT_NEAR(whiteness(autoregressive(5000, 0.3, 4), torque).correlation, 0.3, 0.05);
  std::vector<double> follows = white;
  for (std::size_t i = 5; i < white.size(); ++i) follows[i] += 0.3 * torque[i - 5];
  EXPECT_NEAR(whiteness(follows, torque).with_torque, 0.3 / std::sqrt(1.09), 0.06);
  EXPECT_FALSE(whiteness(follows, torque).is_white());
}

TEST(Whiteness, OfAMotorThatIsReadInEverySecondSampleIsThatOfItsInnovations) {
  const std::vector<double> own = autoregressive(3000, 0.5, 4), driving = autoregressive(3000, 0, 5);
  std::vector<double> innovation, torque;
  for (std::size_t i = 0; i < own.size(); ++i) {
    innovation.insert(innovation.end(), {own[i], kNan});
    torque.insert(torque.end(), {driving[i], 100.0});
  }
  const Whiteness sparse = whiteness(innovation, torque), dense = whiteness(own, driving);
  EXPECT_EQ(sparse.correlation, dense.correlation);
  EXPECT_EQ(sparse.with_torque, dense.with_torque);
  EXPECT_EQ(sparse.chance, dense.chance);
}

TEST(Whiteness, SaysWhatItSees) {
  EXPECT_EQ(in_words(Whiteness{.correlation = kNan}), "-");
  EXPECT_EQ(in_words(Whiteness{.correlation = 0.01, .with_torque = -0.01, .chance = 0.05}), "white");
  EXPECT_EQ(in_words(Whiteness{.correlation = -0.3, .with_torque = 0.01, .chance = 0.05}),
            "neighbours correlate, -0.30");
  EXPECT_EQ(in_words(Whiteness{.correlation = 0.01, .with_torque = 0.2, .chance = 0.05}), "with the torque, 0.20");
  EXPECT_EQ(in_words(Whiteness{.correlation = 0.3, .with_torque = 0.2, .chance = 0.05}),
            "neighbours correlate, 0.30; with the torque, 0.20");
}

TEST(ErrorStatistics, NeedSamplesThatBelongTogether) {
  EXPECT_THROW(error_statistics(std::vector{1.0, 2.0}, std::vector{1.0}, {}), std::invalid_argument);
  EXPECT_THROW(error_statistics(std::vector{1.0}, std::vector{1.0}, std::vector{1.0, 1.0}), std::invalid_argument);
}

TEST(NormalisedSquares, NeedADeviation) {
  const std::vector<double> z =
      normalised_squares(std::vector{1.0, 2.0, kNan}, std::vector{0.0, 2.0, 1.0}, std::vector{0.5, 0.0, 1.0});
  EXPECT_EQ(z[0], 4);
  EXPECT_TRUE(std::isnan(z[1]));
  EXPECT_TRUE(std::isnan(z[2]));
}

}  // namespace
}  // namespace halyard
