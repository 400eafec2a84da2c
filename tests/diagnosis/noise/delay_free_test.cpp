#include "diagnosis/noise/delay_free.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace halyard {
namespace {

constexpr double kSampleTime = 2e-3;  // s
constexpr std::size_t kRows = 15000;  // 30 s

/// A command that follows a slow motion and the noise of its encoder, up to 30 Hz.
double command(double t) {
  double sum = 0.02 * std::sin(2 * std::numbers::pi * 0.4 * t);
  for (int i = 0; i < 12; ++i) sum += 1e-3 * std::sin(2 * std::numbers::pi * (8 + 1.83 * i) * t + 1.7 * i * i);
  return sum;
}

std::vector<double> sampled(const std::function<double(double)>& f) {
  std::vector<double> x(kRows);
  for (std::size_t i = 0; i < kRows; ++i) x[i] = f(kSampleTime * static_cast<double>(i));
  return x;
}

double deviation_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

std::vector<double> rate_of_command() {
  return sampled([](double t) { return (command(t + 1e-5) - command(t - 1e-5)) / 2e-5; });
}

TEST(DelayFree, TakesOffWhatALateTorqueLeaves) {
  constexpr double delay = 2e-3;
  const std::vector<double> late = sampled([](double t) { return command(t) - command(t - delay); });
  // To first order in the delay. At 28 Hz, the highest frequency, ω d / 2 = 0.18 of it is left.
  EXPECT_LT(deviation_of(delay_free({late}, {rate_of_command()}, kSampleTime)[0]), 0.18 * deviation_of(late));
}

TEST(DelayFree, LeavesTheNoiseOfTheTorqueItself) {
  // A logged torque's noise is in its residual, and in the rate of its command.
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1e-3);
  std::vector<double> noise(kRows), rate(kRows, 0.0);
  for (double& x : noise) x = normal(random);
  for (std::size_t i = 1; i + 1 < kRows; ++i) rate[i] = (noise[i + 1] - noise[i - 1]) / (2 * kSampleTime);
  // One number of 15000 samples takes 1e-4 of the noise at most.
  EXPECT_NEAR(deviation_of(delay_free({noise}, {rate}, kSampleTime)[0]), deviation_of(noise),
              1e-3 * deviation_of(noise));
}

}  // namespace
}  // namespace halyard
