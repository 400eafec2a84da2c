/// A motor that saturates far below its command is an effect and no wrong unit; a wrong unit stays one, whatever the
/// model's friction is wrong by.

#include "diagnosis/log_check/torques/saturating_torque.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/arm_log.h"
#include "tests/diagnosis/log_check/checked_logs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

struct Torques {
  std::vector<double> x, y;
};

/// Needed torques y = of(x) + error for recorded torques x: two sines, and a smooth error of the model of a tenth.
template <class Function>
Torques torques(const Function& of) {
  Torques t;
  for (int i = 0; i < 3000; ++i) {
    const double time = 0.01 * i, x = std::sin(time) + 0.6 * std::sin(3.1 * time + 1);
    t.x.push_back(x);
    t.y.push_back(of(x));
  }
  const double size = std::abs(*std::ranges::max_element(t.y));
  for (int i = 0; i < 3000; ++i) t.y[i] += 0.1 * size * std::sin(0.017 * i);
  return t;
}

double evidence(const Torques& t, double unit) { return evidence_of_saturation(t.x, t.y, unit / 2.5, unit * 2.5, 120); }

TEST(SaturatingTorque, IsToldFromAWrongUnit) {
  for (const double limit : {0.02, 0.1, 0.3})
    EXPECT_GT(evidence(torques([&](double x) { return std::clamp(x, -limit, limit); }), limit), 8) << limit;
  EXPECT_GT(evidence(torques([](double x) { return 0.1 * x + 0.9 * std::clamp(x, -0.2, 0.2); }), 0.2), 8);
}

TEST(SaturatingTorque, IsNotSeenInAWrongUnit) {
  for (const double unit : {1e-3, 1e-2, 1 / 12.25})
    for (const double friction : {-0.3, 0.0, 0.3}) {
      const auto of = [&](double x) { return unit * (x + friction * std::copysign(1, x)); };
      EXPECT_LT(evidence(torques(of), unit), 0) << unit << " " << friction;
    }
}

TEST(SaturatingTorque, OfNoSamplesIsNoEvidence) {
  EXPECT_EQ(evidence_of_saturation({}, {}, 0.1, 0.2, 10), 0);
  EXPECT_EQ(evidence_of_saturation({1, kNan}, {kNan, 1}, 0.1, 0.2, 10), 0);
}

TEST(LogCheck, DoesNotRefuseALogOfAMotorThatSaturatesFarBelowItsCommand) {
  for (const double share : {1.0, 0.95}) {
    ArmModel truth = raven();
    // 1.5 times the friction of the motor: the arm moves, and the controller asks for up to its own limit.
    truth.effects.push_back(place_neutral_effect(*find_effect("actuator_saturation"), truth.nominal, 1));
    truth.effects[0].p[0] = share;
    truth.effects[0].p[1] = 0.006;
    const Log log = simulate(small_motion(truth)).measured;
    for (const LogFinding& f : check_log(log, raven())) EXPECT_NE(f.severity, Severity::gross) << finding_line(f);
  }
}

/// A controller that always asks for all it may: the shape of the torque tells nothing, but its limit tells the unit.
TEST(LogCheck, KnowsTheUnitOfATorqueThatStopsAtTheLimitOfTheModel) {
  ArmModel model = raven();
  const double limit = 0.02;
  model.joints[1].controller.torque_limit = limit;
  const auto stopped = [&](double unit, double noise = 0) {
    Log log = right_log();
    std::mt19937_64 random(1);
    std::normal_distribution<double> error(1, noise);
    for (double& t : log.motor_torque[1])
      t = std::clamp(t * unit, -limit * unit / 12.25, limit * unit / 12.25) * (noise > 0 ? error(random) : 1);
    return log;
  };
  const auto has_gross = [&](const Log& log) {
    return std::ranges::count(check_log(log, model), Severity::gross, &LogFinding::severity) > 0;
  };
  EXPECT_FALSE(has_gross(stopped(12.25)));
  EXPECT_FALSE(has_gross(stopped(12.25, 0.012))) << "a sensor of current with noise";
  EXPECT_TRUE(has_gross(stopped(1e3)));
}

TEST(SaturatingTorque, OfAMotorThatGivesHalfOfWhatIsBeyondItsLimitIsSeenExactly) {
  // One of the limits that are tried is 10, the quantile of 0.19: nothing is left beside it.
  std::vector<double> x, y;
  for (int i = 1; i <= 50; ++i)
    for (const int sign : {-1, 1}) {
      x.push_back(sign * i);
      y.push_back(sign * (i <= 10 ? i : 10 + 0.5 * (i - 10)));
    }
  // ½ ln of what the unit leaves over the smallest number, 2e-308.
  EXPECT_GT(evidence_of_saturation(x, y, 0.1, 10, 1), 300);
}

}  // namespace
}  // namespace halyard
