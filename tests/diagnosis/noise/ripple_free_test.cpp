#include "diagnosis/noise/ripple_free.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace halyard {
namespace {

constexpr std::size_t kSize = 15000;  // 30 s at 500 Hz

/// Some turns back and forth.
std::vector<double> motor_angle() {
  std::vector<double> angle(kSize);
  for (std::size_t i = 0; i < kSize; ++i) {
    const double t = 2e-3 * static_cast<double>(i);
    angle[i] = 9 * std::sin(2 * std::numbers::pi * 0.31 * t) + 4 * std::cos(2 * std::numbers::pi * 0.83 * t);
  }
  return angle;
}

std::vector<double> white_noise(double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> x(kSize);
  for (double& v : x) v = normal(random);
  return x;
}

double rms(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

TEST(RippleFree, LeavesTheNoiseBesideARipple) {
  const std::vector<double> angle = motor_angle();
  std::vector<double> x = white_noise(1e-4);
  for (std::size_t i = 0; i < kSize; ++i) x[i] += 1e-3 * std::cos(15 * angle[i] + 0.4);
  // 96 amplitudes take less than 0.4 % of the noise's deviation.
  EXPECT_NEAR(rms(ripple_free({x}, {angle})[0]), 1e-4, 0.02e-4);
}

TEST(RippleFree, TakesNothingFromAMotorThatTurnsTooLittle) {
  std::vector<double> angle = motor_angle();
  for (double& a : angle) a *= 1e-3;
  const std::vector<double> x = white_noise(1e-4);
  EXPECT_EQ(ripple_free({x}, {angle})[0], x);
}

}  // namespace
}  // namespace halyard
