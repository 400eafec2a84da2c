#include "diagnosis/noise/channel_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace {

using halyard::ChannelNoise;

constexpr double kInterval = 1e-3;  // s
constexpr int kSegment = 1000;
constexpr double kFilter = 8.4e-3;  // s

/// 30 s of white noise.
std::vector<double> white_noise(double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> x(30000);
  for (double& v : x) v = normal(random);
  return x;
}

void add_sine(std::vector<double>& x, double amplitude, double frequency_hz) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += amplitude * std::sin(2 * std::numbers::pi * frequency_hz * kInterval * static_cast<double>(i));
}

ChannelNoise noise_of(const std::vector<double>& x) {
  return halyard::noise_of_density(halyard::median_density({x}, kInterval, kSegment), 1 / (kInterval * kSegment),
                                   0.5 / kInterval, kFilter);
}

// The least of three bands of 10 bins and more, each bin the median of 59 overlapping segments: a bin scatters by some
// 17 %, the narrowest band by 5 %, so that the least of three is 5 % low: 3 % of the deviation, and two deviations
// more.
constexpr double kScatter = 0.08;

TEST(ChannelNoise, IsTheDeviationOfWhiteNoise) {
  const ChannelNoise noise = noise_of(white_noise(3e-4, 1));
  EXPECT_NEAR(noise.white, 3e-4, kScatter * 3e-4);
  // Variance of white noise after a Gaussian filter: σ² Δ / (2 √π σ_t).
  const double in_band = 3e-4 * std::sqrt(kInterval / (2 * std::sqrt(std::numbers::pi) * kFilter));
  EXPECT_NEAR(noise.in_band, in_band, kScatter * in_band);
}

TEST(ChannelNoise, IsNotRaisedByAModelsSlowErrorsAndRareImpacts) {
  std::vector<double> x = white_noise(3e-4, 2);
  const double alone = noise_of(x).white;
  add_sine(x, 3e-2, 0.7);
  for (std::size_t i = 12000; i < x.size(); ++i) x[i] += 5e-3;
  EXPECT_NEAR(noise_of(x).white, alone, kScatter * alone);
}

TEST(ChannelNoise, FindsALineAboveTheComparedBandWithItsAmplitude) {
  std::vector<double> x = white_noise(1e-3, 3);
  add_sine(x, 2e-3, 50);
  const ChannelNoise noise = noise_of(x);
  ASSERT_EQ(noise.lines.size(), 1U);
  EXPECT_NEAR(noise.lines[0].frequency, 50, 1);  // the resolution
  EXPECT_NEAR(noise.lines[0].amplitude, 2e-3, 0.1 * 2e-3);
}

TEST(ChannelNoise, SeesNoLineInWhiteNoise) {
  for (unsigned seed = 1; seed <= 20; ++seed) EXPECT_TRUE(noise_of(white_noise(1, seed)).lines.empty()) << seed;
}

TEST(ChannelNoise, OfASlowSensorIsThatOfItsSamples) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, 1e-4);
  std::vector<double> x(900);  // 30 s at 30 Hz
  for (double& v : x) v = normal(random);
  const double nyquist = 15, resolution = 30.0 / 64;
  const ChannelNoise noise =
      halyard::noise_of_density(halyard::median_density({x}, 1.0 / 30, 64), resolution, nyquist, kFilter);
  // Ten bins of 27 segments each scatter by 8 %, two deviations.
  EXPECT_NEAR(noise.white, 1e-4, 0.16 * 1e-4);
  EXPECT_DOUBLE_EQ(noise.in_band, noise.white) << "the filter averages over less than one sample";
}

/// A log with rows of 1 ms and white noise on one of its columns, which is read only `rate` times a second.
halyard::Log noisy_log(double deviation, double rate, halyard::Signals halyard::Log::*column, double duration = 12) {
  halyard::Log log = simulate(halyard::motion(halyard::first_joints(1), duration)).measured;
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0, deviation);
  for (std::size_t i = 0, reading = 0; i < log.size(); ++i) {
    const bool is_read = kInterval * static_cast<double>(i) >= (static_cast<double>(reading) - 1e-6) / rate;
    if (is_read) ++reading;
    (log.*column)[0][i] += is_read ? normal(random) : std::numeric_limits<double>::quiet_NaN();
  }
  return log;
}

ChannelNoise noise_of_channel(const std::vector<halyard::Log>& logs, int channel, double stated = 0) {
  halyard::ArmModel model = halyard::first_joints(1);
  model.nominal.joint[0].joint_encoder_noise = stated;
  std::vector<halyard::Record> records;
  for (const halyard::Log& log : logs)
    for (halyard::Record& record : halyard::make_records(log, model, {})) records.push_back(std::move(record));
  return channel_noise(records, {model.nominal, model.effects})[channel];
}

// These logs are shorter than those above: half as many segments again to scatter by.
constexpr double kScatterOfLog = 1.5 * kScatter;

class NoiseAtRate : public testing::TestWithParam<double> {};

TEST_P(NoiseAtRate, OfAJointSensorIsThatOfItsReadings) {
  constexpr double kDeviation = 1e-3;  // rad
  const double in_band = kDeviation * std::sqrt(1 / GetParam() / (2 * std::sqrt(std::numbers::pi) * kFilter));
  const ChannelNoise noise = noise_of_channel({noisy_log(kDeviation, GetParam(), &halyard::Log::joint_position)}, 1);
  EXPECT_NEAR(noise.in_band, in_band, kScatterOfLog * in_band);
}

TEST_P(NoiseAtRate, OfATorqueIsThatOfItsReadings) {
  constexpr double kDeviation = 1e-2;  // N m
  const double in_band = kDeviation * std::sqrt(1 / GetParam() / (2 * std::sqrt(std::numbers::pi) * kFilter));
  const ChannelNoise noise = noise_of_channel({noisy_log(kDeviation, GetParam(), &halyard::Log::motor_torque)}, 0);
  EXPECT_NEAR(noise.in_band, in_band, kScatterOfLog * in_band);
}

// 342 and 700 Hz: between the rows of the log. 1000 Hz: between the points of the record's grid.
INSTANTIATE_TEST_SUITE_P(Rates, NoiseAtRate, testing::Values(100, 250, 342, 700, 1000));

TEST(ChannelNoise, OfAJointSensorIsAtLeastWhatTheModelStates) {
  const halyard::Log log = noisy_log(1e-3, 250, &halyard::Log::joint_position);
  const ChannelNoise found = noise_of_channel({log}, 1), stated = noise_of_channel({log}, 1, 3e-3);
  EXPECT_EQ(stated.white, 3e-3);
  EXPECT_NEAR(stated.in_band / found.in_band, 3e-3 / found.white, 1e-9);
  EXPECT_EQ(noise_of_channel({log}, 1, 5e-4).in_band, found.in_band) << "it may have more";
}

TEST(ChannelNoise, OfLogsWithDifferentRatesIsTheMeanOfTheirs) {
  const halyard::Log slow = noisy_log(1e-3, 100, &halyard::Log::joint_position),
                     fast = noisy_log(1e-3, 1000, &halyard::Log::joint_position);
  const double of_slow = noise_of_channel({slow}, 1).in_band, of_fast = noise_of_channel({fast}, 1).in_band;
  ASSERT_GT(of_slow, 2 * of_fast);
  const double mean = std::sqrt((of_slow * of_slow + of_fast * of_fast) / 2);
  EXPECT_NEAR(noise_of_channel({slow, fast}, 1).in_band, mean, 0.01 * mean);
}

TEST(ChannelNoise, OfFewReadingsIsNotNothing) {
  constexpr double kDeviation = 1e-3;  // rad
  // 3.5 s at 10 Hz, less what is not compared: the upper third of the spectrum of 30 readings has five bins, each of
  // which is exponentially distributed.
  const double white = noise_of_channel({noisy_log(kDeviation, 10, &halyard::Log::joint_position, 3.5)}, 1).white;
  EXPECT_GT(white, 0.3 * kDeviation);
  EXPECT_LT(white, 3 * kDeviation);
}

TEST(MedianDensity, OfASineHasItsWindowsPeakInItsOwnBin) {
  std::vector<double> x(3000, 0.0);
  add_sine(x, 1, 50);
  const std::vector<double> density = halyard::median_density({x}, kInterval, kSegment).of_bin;
  ASSERT_EQ(density.size(), 500U);
  // 2 Δ |Σ w sin|² / Σ w² with Σ w = N / 2 and Σ w² = 3 N / 8; its neighbours have half of the amplitude.
  const double peak = kInterval * kSegment / 3 / std::numbers::ln2;
  EXPECT_NEAR(density[50], peak, 1e-6 * peak);
  EXPECT_NEAR(density[49], peak / 4, 1e-6 * peak);
  EXPECT_NEAR(density[51], peak / 4, 1e-6 * peak);
  EXPECT_NEAR(density[47], 0, 1e-6 * peak);
}

TEST(MedianDensity, OfFewSegmentsIsTooLargeByWhatItSays) {
  for (const int segments : {1, 2, 3, 4, 9}) {
    double sum = 0, count = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::vector<double> x = white_noise(1, seed);
      x.resize(static_cast<std::size_t>(kSegment) * (segments + 1) / 2);  // they overlap by half
      const auto [density, too_large] = halyard::median_density({x}, kInterval, kSegment);
      for (std::size_t b = 2; b < density.size(); ++b)  // the window spreads the mean
        sum += density[b] / too_large, count += 1;
    }
    // 10 000 bins, correlated over three, that scatter by their mean at most: 2 %.
    EXPECT_NEAR(sum / count, 2 * kInterval, 0.05 * 2 * kInterval) << segments;
  }
}

TEST(ChannelNoise, FindsALineInTheReadingsOfAJointSensor) {
  constexpr double kHum = 1e-3;  // rad, a dozen steps of the encoder
  halyard::Log log = simulate(halyard::motion(halyard::first_joints(1), 2)).measured;
  add_sine(log.joint_position[0], kHum, 50);
  const std::vector<halyard::NoiseLine> lines = noise_of_channel({log}, 1).lines;
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].frequency, 50, 0.5);
  EXPECT_NEAR(lines[0].amplitude, kHum, 0.05 * kHum);
}

TEST(ChannelNoise, IsThatOfTheQuietestBandFromTenToEightyHertz) {
  for (const double quietest : {10.0, 20.0, 40.0}) {
    std::vector<double> density(500, 4.0);  // of 1 Hz each
    for (std::size_t b = 0; b < density.size(); ++b) {
      const double f = static_cast<double>(b);
      if (f < 10 || f >= 80) density[b] = 0.01;
      else if (f >= quietest && f < 2 * quietest) density[b] = 1;
    }
    const ChannelNoise noise = halyard::noise_of_density({density}, 1, 500, kFilter);
    EXPECT_NEAR(noise.white, std::sqrt(500.0), 1e-9) << quietest;
    EXPECT_NEAR(noise.in_band, std::sqrt(1 / (4 * std::sqrt(std::numbers::pi) * kFilter)), 1e-9) << quietest;
  }
}

TEST(ChannelNoise, IsTakenFromNoBandThatHardlyBeginsBelowTheHighestFrequency) {
  // Up to 26 Hz: the band from 20 Hz on has a third of its width. Up to 12 Hz: the upper third alone.
  std::vector<double> fast(26, 4.0), slow(12, 1.0);
  for (std::size_t b = 20; b < fast.size(); ++b) fast[b] = 1;
  for (std::size_t b = 8; b < slow.size(); ++b) slow[b] = 4;
  EXPECT_NEAR(halyard::noise_of_density({fast}, 1, 26, kFilter).white, std::sqrt(4.0 * 26), 1e-9);
  EXPECT_NEAR(halyard::noise_of_density({slow}, 1, 12, kFilter).white, std::sqrt(4.0 * 12), 1e-9);
}

TEST(ChannelNoise, ALineIsThirtyTimesItsSurroundingsBetween22And150Hertz) {
  const auto lines = [](double height, std::size_t hertz) {
    std::vector<double> density(1000, 1.0);  // of half a hertz each
    density[2 * hertz] = height;
    return halyard::noise_of_density({density}, 0.5, 500, kFilter).lines;
  };
  EXPECT_TRUE(lines(29.9, 60).empty());
  const std::vector<halyard::NoiseLine> found = lines(30.1, 60);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].frequency, 60);
  // A sine of amplitude A has the power A² / 2, and a density over ln 2.
  EXPECT_NEAR(found[0].amplitude, std::sqrt(2 * 29.1 * 0.5 * std::numbers::ln2), 1e-9);
  EXPECT_EQ(lines(1e4, 23).size(), 1U);
  EXPECT_EQ(lines(1e4, 148).size(), 1U);
  EXPECT_TRUE(lines(1e4, 21).empty());
  EXPECT_TRUE(lines(1e4, 151).empty());
}

}  // namespace
