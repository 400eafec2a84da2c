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

TEST(RippleFree, TakesOrdersThatPassOneAndAHalfPeriodsAndNoLowerOnes) {
  constexpr std::size_t kFew = 2000;
  std::vector<double> angle(kFew), once(kFew), twice(kFew);
  for (std::size_t i = 0; i < kFew; ++i) {
    angle[i] = 10 + 1.2 * 2 * std::numbers::pi * static_cast<double>(i) / kFew;  // 1.2 turns
    once[i] = std::cos(angle[i]), twice[i] = std::cos(2 * angle[i]);
  }
  EXPECT_LT(rms(ripple_free({twice}, {angle})[0]), 1e-3);
  // Over a whole turn nothing of it can be made of higher orders: at least √(1 / 2.4) is left.
  EXPECT_GT(rms(ripple_free({once}, {angle})[0]), 0.6);
}

}  // namespace
}  // namespace halyard
