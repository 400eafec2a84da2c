/// The sensors of trials are drawn within the table of sensors.h, and fill its ranges.

#include "bench/diagnosis/draw/sensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/trials.h"
#include "transmission/effects/typical_size.h"

namespace halyard::blind {
namespace {

constexpr int kDraws = 400;
/// The 200 draws or more of a uniform number leave the outer 2 % at one end empty with a probability of
/// 0.98^200 = 0.02. This seed leaves none empty.
constexpr double kOuter = 0.02;

/// The least and the largest value of a number over all draws.
struct Range {
  double least = 1e300, most = -1e300;
  void add(double x) { least = std::min(least, x), most = std::max(most, x); }
  /// It lies between these ends and reaches into the outer part beside both.
  void expect_fills(double from, double to, const char* what) const {
    EXPECT_GE(least, from) << what;
    EXPECT_LE(most, to) << what;
    EXPECT_LT(least, from + kOuter * (to - from)) << what;
    EXPECT_GT(most, to - kOuter * (to - from)) << what;
  }
};

constexpr double kFrom = 3, kTo = 33;  // s

std::vector<SensorDraw> draws(Sensors kind) {
  std::vector<SensorDraw> all;
  Random random(1, 2, 3);
  for (int i = 0; i < kDraws; ++i) all.push_back(draw_sensors(kind, raven2(), kFrom, kTo, random));
  return all;
}

/// Noise of the joints in counts, and of the torques in frictions of the motor.
void expect_noise(Sensors kind, double counts, double frictions) {
  Range joint, torque;
  for (const SensorDraw& s : draws(kind))
    for (int k = 0; k < raven2().n(); ++k) {
      const JointParameters<double>& j = raven2().nominal.joint[k];
      joint.add(s.noise.at(k) / j.joint_encoder_resolution);
      torque.add(s.torque_noise.at(k) / typical_motor_friction(j));
    }
  joint.expect_fills(0, counts, word(kind).c_str());
  torque.expect_fills(0, frictions, word(kind).c_str());
}

TEST(DrawnSensors, AreAsNoisyAsTheirKind) {
  expect_noise(Sensors::good, 1, 0.02);
  expect_noise(Sensors::poor, 30, 0.2);
  expect_noise(Sensors::motors, 30, 0.2);
}

TEST(DrawnSensors, ReadTheJointsInEveryRowIfTheyAreGood) {
  for (const Sensors kind : {Sensors::good, Sensors::motors})
    for (const SensorDraw& s : draws(kind)) {
      EXPECT_EQ(s.sees_joints, kind == Sensors::good);
      EXPECT_EQ(s.interval_s, 0);
      EXPECT_EQ(s.latency_s, 0);
      EXPECT_EQ(s.jitter_s, 0);
      EXPECT_EQ(s.missing_share, 0);
      EXPECT_EQ(s.outlier_share, 0);
      EXPECT_TRUE(s.missing.empty());
    }
}

TEST(DrawnSensors, AreSlowLateAndIncompleteIfTheyArePoor) {
  Range log_rate, latency, jitter, missing, stretches, log_length, start;
  int late = 0, slow = 0, brief = 0, all_stretches = 0;
  for (const SensorDraw& s : draws(Sensors::poor)) {
    EXPECT_TRUE(s.sees_joints);
    log_rate.add(std::log(1 / s.interval_s));
    late += s.latency_s > 0;
    slow += 1 / s.interval_s < std::sqrt(30 * 1000);
    latency.add(s.latency_s);
    jitter.add(s.jitter_s / s.interval_s);
    missing.add(s.missing_share);
    EXPECT_EQ(s.outlier_share, 0);
    for (int k = 0; k < raven2().n(); ++k)
      stretches.add(static_cast<double>(std::ranges::count(s.missing, k, &SensorDraw::Stretch::joint)));
    for (const SensorDraw::Stretch& m : s.missing) {
      log_length.add(std::log(m.to_s - m.from_s));
      brief += m.to_s - m.from_s < std::sqrt(0.05 * 1);
      ++all_stretches;
      start.add(m.from_s);
      EXPECT_LE(m.to_s, kTo);
    }
  }
  log_rate.expect_fills(std::log(30) - 1e-12, std::log(1000) + 1e-12, "rate");  // rounding of the logarithm
  latency.expect_fills(0, 0.02, "latency");
  jitter.expect_fills(0, 0.1, "jitter over interval");
  missing.expect_fills(0, 0.05, "missing readings");
  stretches.expect_fills(0, 2, "missing stretches of a joint");
  log_length.expect_fills(std::log(0.05) - 1e-9, std::log(1) + 1e-9, "length");  // rounding of two instants
  start.expect_fills(kFrom, kTo, "start");
  // Four binomial deviations.
  const auto expect_half = [](int some, int of, const char* what) {
    EXPECT_NEAR(some, of / 2.0, 4 * std::sqrt(of) / 2) << what;
  };
  expect_half(late, kDraws, "are late");
  expect_half(slow, kDraws, "are slower than the middle of the logarithm");
  expect_half(brief, all_stretches, "are shorter than the middle of the logarithm");
}

TEST(DrawnSensors, OfAJointWithoutAMotorHaveNoNoiseOfATorque) {
  ArmModel model = raven2();
  model.nominal.joint[1].drive = Drive::none;
  Random random(1, 2, 3);
  const SensorDraw s = draw_sensors(Sensors::poor, model, kFrom, kTo, random);
  EXPECT_GT(s.torque_noise.at(0), 0);
  EXPECT_EQ(s.torque_noise.at(1), 0);
}

TEST(DrawnSensors, AreIdealForTheHoldOut) {
  const SensorDraw s = ideal_sensors(raven2());
  EXPECT_TRUE(s.sees_joints);
  EXPECT_EQ(s.noise, std::vector<double>(3, 0));
  EXPECT_EQ(s.torque_noise, std::vector<double>(3, 0));
  EXPECT_EQ(s.interval_s + s.latency_s + s.jitter_s + s.missing_share + s.outlier_share, 0);
  EXPECT_TRUE(s.missing.empty());
}

}  // namespace
}  // namespace halyard::blind
