#include "diagnosis/explanation/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "diagnosis/explanation/view_sentence.h"

namespace halyard {
namespace {

constexpr double kPi = std::numbers::pi;

/// 30 s of a joint that moves along two sines, its motor forty times as far; y(i, signals) is its position residual.
ResidualSignals joint_with(const std::function<double(std::size_t, const ResidualSignals&)>& y) {
  ResidualSignals s;
  s.dt = 0.01;
  for (int i = 0; i < 3000; ++i) {
    const double t = s.dt * i;
    s.time.push_back(t);
    s.joint_position.push_back(0.4 * std::sin(1.7 * t) + 0.3 * std::sin(0.53 * t));
    s.joint_rate.push_back(0.68 * std::cos(1.7 * t) + 0.159 * std::cos(0.53 * t));
    s.motor_angle.push_back(40 * s.joint_position.back());
    s.motor_rate.push_back(40 * s.joint_rate.back());
    s.capstan_angle.push_back(s.motor_angle.back() / 10);
    s.load.push_back(20 * std::sin(s.joint_position.back() + 0.5));
    s.joint_direction.push_back(s.joint_rate.back() > 0 ? 1 : -1);
    s.motor_direction.push_back(s.joint_direction.back());
  }
  std::vector<double>& residual = s.residual[static_cast<std::size_t>(ResidualKind::joint_position)];
  for (std::size_t i = 0; i < s.time.size(); ++i) residual.push_back(y(i, s));
  return s;
}

/// White noise, the same on every run.
std::function<double(std::size_t, const ResidualSignals&)> noise(double deviation, unsigned seed) {
  return [random = std::mt19937(seed), normal = std::normal_distribution<>(0, deviation)](
             std::size_t, const ResidualSignals&) mutable { return normal(random); };
}

/// Noise with a correlation time in s.
std::function<double(std::size_t, const ResidualSignals&)> slow_noise(double time, unsigned seed) {
  return [keep = std::exp(-0.01 / time), random = std::mt19937(seed), normal = std::normal_distribution<>(), y = 0.0](
             std::size_t, const ResidualSignals&) mutable { return y = keep * y + normal(random); };
}

ArmParameters<double> one_joint() {
  ArmParameters<double> arm;
  arm.n = 1;
  return arm;
}

TEST(Views, AStepAtReversalsIsSeenOverTheDirectionOfMotion) {
  auto rest = noise(2e-4, 1);
  const ResidualSignals before =
      joint_with([&](std::size_t i, const ResidualSignals& s) { return 1e-3 * s.joint_direction[i] + rest(i, s); });
  const ResidualSignals after = joint_with(noise(2e-4, 2));
  const std::vector<View> views = telling_views(before, after);
  ASSERT_FALSE(views.empty());
  EXPECT_EQ(views[0].abscissa, Abscissa::direction);
  EXPECT_FALSE(views[0].loop);
  // 1 of 1.04 is the step's; 3000 samples of noise leave each mean open by 2e-4 / sqrt(1500), five of that a side.
  EXPECT_NEAR(views[0].explained_before, 1 / 1.04, 0.01);
  EXPECT_NEAR(views[0].swing, 2e-3, 2 * 5 * 2e-4 / std::sqrt(1500));
  EXPECT_NEAR(views[0].left, 0.04 / 1.04, 0.005);
  EXPECT_EQ(view_phrase(views[0], one_joint(), 0),
            "steps by ±0.0573 deg at each reversal: 96 % of its variance goes with the direction of motion");
}

TEST(Views, AShortRecordTellsWhatFallsWhollyOntoACurveAndIsGone) {
  const auto short_of = [](ResidualSignals s) {
    for (std::vector<double>* x : {&s.time, &s.joint_position, &s.joint_rate, &s.motor_angle, &s.motor_rate,
                                   &s.capstan_angle, &s.load, &s.joint_direction, &s.motor_direction, &s.residual[0]})
      x->resize(250);  // two thirds of a period
    return s;
  };
  auto rest = noise(1e-5, 5);
  const ResidualSignals late = short_of(
      joint_with([&](std::size_t i, const ResidualSignals& s) { return 3e-3 * s.joint_rate[i] + rest(i, s); }));
  const std::vector<View> gone = telling_views(late, short_of(joint_with(noise(1e-5, 6))));
  ASSERT_FALSE(gone.empty());
  EXPECT_EQ(gone[0].abscissa, Abscissa::rate);
  EXPECT_LT(gone[0].explained_before, gone[0].chance);  // so few independent samples prove nothing by themselves
  EXPECT_TRUE(telling_views(late, late).empty());       // not gone
}

TEST(Views, ARippleOfTheMotorIsALineOfItsOrder) {
  auto rest = noise(2e-4, 3);
  const ResidualSignals before = joint_with([&](std::size_t i, const ResidualSignals& s) {
    return 1e-3 * std::sin(6 * s.motor_angle[i] + 0.4) + rest(i, s);
  });
  const ResidualSignals after = joint_with(noise(2e-4, 4));
  const std::vector<View> views = telling_views(before, after);
  ASSERT_FALSE(views.empty());
  EXPECT_EQ(views[0].abscissa, Abscissa::motor_angle);
  // Half a resolution cell: the motor goes through 28 rad a side, nearly 9 turns.
  EXPECT_NEAR(views[0].line.frequency, 6, 0.5 / 8.5);
  EXPECT_NEAR(views[0].line.amplitude, 1e-3, 5e-5);
  EXPECT_GT(views[0].line.share, 0.85);
}

TEST(Views, ALoopIsSeenOverLoadAndDirection) {
  // Its width grows with the load: neither load nor direction alone tell most of it.
  const ResidualSignals before = joint_with([](std::size_t i, const ResidualSignals& s) {
    return 1e-4 * s.load[i] * s.joint_direction[i] + 0.5e-4 * s.load[i];
  });
  const std::vector<View> views = telling_views(before, joint_with(noise(1e-5, 5)));
  ASSERT_FALSE(views.empty());
  EXPECT_TRUE(views[0].loop);
  EXPECT_TRUE(views[0].abscissa == Abscissa::load || views[0].abscissa == Abscissa::joint_position);
  EXPECT_GT(views[0].explained_before, 0.95);
  const std::vector<Curve> sides =
      view_curves(before, {.residual = ResidualKind::joint_position, .abscissa = Abscissa::load, .loop = true});
  ASSERT_EQ(sides.size(), 2u);
  // Each side is straight, and a curve with knots can be: rounding of sums of 3000 times 3e-3, and 1e-12 of
  // regularisation.
  for (const Curve& side : sides)
    for (std::size_t b = 0; b < side.x.size(); ++b)
      EXPECT_NEAR(side.y[b], (1e-4 * side.direction + 0.5e-4) * side.x[b], 1e-11);
}

TEST(Views, AConstantIsToldAsOne) {
  auto rest = slow_noise(0.2, 6);
  const ResidualSignals before =
      joint_with([&](std::size_t i, const ResidualSignals& s) { return 0.02 + 1e-3 * rest(i, s); });
  const std::vector<View> views = telling_views(before, joint_with(noise(1e-3, 7)));
  ASSERT_FALSE(views.empty());
  EXPECT_EQ(views[0].abscissa, Abscissa::constant);
}

std::string told(const std::vector<View>& views) {
  std::string text;
  for (const View& v : views) text += view_phrase(v, one_joint(), 0) + "\n";
  return text;
}

TEST(Views, NoiseHasNoTellingView) {
  // Three standard deviations over ten views, with correlation times that are themselves estimated: 1 false alarm in 90
  // runs was observed, of the noise of 2 s, which has few independent samples in 30 s.
  int alarms = 0;
  for (unsigned seed = 10; seed < 40; ++seed) {
    EXPECT_EQ(told(telling_views(joint_with(noise(1, seed)))), "") << "white noise, seed " << seed;
    EXPECT_EQ(told(telling_views(joint_with(slow_noise(0.2, seed)))), "") << "noise over 0.2 s, seed " << seed;
    alarms += !telling_views(joint_with(slow_noise(2, seed))).empty();
  }
  EXPECT_LE(alarms, 2);
}

TEST(Views, ADriftHasNoViewOverMotion) {
  for (unsigned seed = 10; seed < 40; ++seed) {
    std::vector<View> views = telling_views(joint_with(slow_noise(30, seed)));
    std::erase_if(views,
                  [](const View& v) { return v.abscissa == Abscissa::time || v.abscissa == Abscissa::constant; });
    EXPECT_EQ(told(views), "") << "seed " << seed;
  }
}

TEST(Views, WhatStaysIsNoEvidenceForWhatWasAdded) {
  const auto step = [](std::size_t i, const ResidualSignals& s) { return s.joint_direction[i]; };
  EXPECT_TRUE(telling_views(joint_with(step), joint_with(step)).empty());
  EXPECT_FALSE(telling_views(joint_with(step)).empty());
}

TEST(Spectrum, ASineOffsetByAConstantHasAllOfTheVarianceAtItsFrequency) {
  std::vector<double> x, y;
  for (int i = 0; i < 500; ++i) {
    x.push_back(0.02 * i + 0.006 * std::sin(3.0 * i));  // uneven
    y.push_back(7 + 0.3 * std::cos(2 * kPi * 1.5 * x.back() + 1));
  }
  const Line line = strongest_line(spectrum(x, y, 0.5, 4, 0.025));
  EXPECT_NEAR(line.frequency, 1.5, 1e-12);
  // Phasors turned 140 times at 500 samples each.
  EXPECT_NEAR(line.share, 1, 1e-10);
  EXPECT_NEAR(line.amplitude, 0.3, 1e-10);
}

TEST(Spectrum, GapsDoNotCount) {
  std::vector<double> x, y;
  for (int i = 0; i < 300; ++i) {
    x.push_back(0.02 * i);
    y.push_back(i % 3 == 0 ? std::nan("") : std::sin(2 * kPi * x.back()));
  }
  EXPECT_NEAR(strongest_line(spectrum(x, y, 0.5, 2, 0.1)).share, 1, 1e-10);
}

/// Orders of a ripple of a motor that turns evenly for 10 s.
std::vector<double> orders_at(double turns_a_second) {
  ResidualSignals s;
  s.dt = 0.01;
  for (int i = 0; i <= 1000; ++i) {
    s.motor_angle.push_back(2 * kPi * turns_a_second * s.dt * i);
    s.residual[static_cast<std::size_t>(ResidualKind::motor_torque)].push_back(std::sin(3 * s.motor_angle.back()));
  }
  return angle_spectrum(s, ResidualKind::motor_torque, Abscissa::motor_angle).frequency;
}

TEST(Views, OrdersOverAnAngleAreThoseThatTheMotionAndTheBandShow) {
  EXPECT_TRUE(orders_at(0.15).empty()) << "one and a half turns";
  // Three turns: an order has to pass twice, and lines are told apart by a twelfth.
  const std::vector<double> slow = orders_at(0.3), fast = orders_at(4);
  EXPECT_NEAR(slow.front(), 2.0 / 3, 1e-9);
  EXPECT_NEAR(slow.back(), 24, 1.0 / 12 + 1e-9);
  EXPECT_NEAR(slow[1] - slow[0], 1.0 / 12, 1e-9);
  // Forty turns: 20 Hz are the order 5.
  EXPECT_NEAR(fast.front(), 0.5, 1e-9);
  EXPECT_NEAR(fast.back(), 5, 0.25 / 40 + 1e-9);
}

/// A position residual alone, over time.
ResidualSignals residual_alone(std::size_t n, const std::function<double(std::size_t)>& y) {
  ResidualSignals s;
  s.dt = 0.01;
  for (std::size_t i = 0; i < n; ++i) {
    s.time.push_back(s.dt * static_cast<double>(i));
    s.residual[static_cast<std::size_t>(ResidualKind::joint_position)].push_back(y(i));
  }
  return s;
}

TEST(Views, AMeanHasAsManyIndependentSamplesAsItsCorrelationLeaves) {
  const auto constant = [](std::size_t n, const std::function<double(std::size_t)>& y) {
    const ResidualSignals s = residual_alone(n, y);
    return all_views(s, s).at(0);
  };
  // By chance a mean is three of its own deviations: 9 / (9 + N) of the mean square.
  const auto independent = [](const View& v) { return 9 / v.chance - 9; };
  // Eight up and eight down: the correlations at 1, 2 and 3 are 3/4, 1/2 and 1/4, and N = n / (1 + 2 * 1.5).
  const View square = constant(3200, [](std::size_t i) { return i % 16 < 8 ? 4.0 : 2.0; });
  ASSERT_EQ(square.abscissa, Abscissa::constant);
  EXPECT_NEAR(independent(square), 800, 8);
  EXPECT_NEAR(square.explained_before, 0.9 - 0.1 / 799, 2e-6);
  EXPECT_NEAR(square.swing, 3, 1e-12);
  // Of 20000 every third is taken, that at most 8000 are left. No two neighbours are alike.
  EXPECT_NEAR(independent(constant(20000, [](std::size_t i) { return i % 2 == 0 ? 4.0 : 2.0; })), 6667, 1);
}

TEST(Views, AnAngleIsAnAbscissaIfTheMotionIsMoreThanTwoTurns) {
  const auto has_motor_angle = [](double turns) {
    ResidualSignals s = joint_with(noise(1, 50));
    const auto [low, high] = std::ranges::minmax(s.motor_angle);
    const double factor = turns * 2 * kPi / (high - low);
    for (double& angle : s.motor_angle) angle *= factor;
    return std::ranges::count(all_views(s, s), Abscissa::motor_angle, &View::abscissa) > 0;
  };
  EXPECT_FALSE(has_motor_angle(1.99));
  EXPECT_TRUE(has_motor_angle(2.01));
}

TEST(Views, TheTransmissionsResidualIsTheStretchAndHasNoViewOverIt) {
  ResidualSignals s = joint_with(noise(1, 51));
  s.stretch = s.load;
  s.residual[static_cast<std::size_t>(ResidualKind::transmission)] = s.of(ResidualKind::joint_position);
  const auto is_over_stretch = [&](ResidualKind kind) {
    const std::vector<View> views = all_views(s, s);
    return std::ranges::any_of(
        views, [&](const View& v) { return v.residual == kind && v.abscissa == Abscissa::stretch && !v.loop; });
  };
  EXPECT_TRUE(is_over_stretch(ResidualKind::joint_position));
  EXPECT_FALSE(is_over_stretch(ResidualKind::transmission));
}

TEST(Views, OfARestAreThoseOfThePositionAndOfTheMotorTorque) {
  const auto has_view = [](ResidualKind kind) {
    ResidualSignals s = joint_with([](std::size_t i, const ResidualSignals& seen) { return seen.joint_direction[i]; });
    if (kind != ResidualKind::joint_position)
      std::swap(s.residual[static_cast<std::size_t>(kind)],
                s.residual[static_cast<std::size_t>(ResidualKind::joint_position)]);
    return !telling_views(s).empty();
  };
  EXPECT_TRUE(has_view(ResidualKind::joint_position));
  EXPECT_TRUE(has_view(ResidualKind::motor_torque));
  EXPECT_FALSE(has_view(ResidualKind::transmission));
  EXPECT_FALSE(has_view(ResidualKind::joint_torque));
}

TEST(Views, AConstantIsToldIfItIsMostOfTheMeanSquare) {
  const auto is_told = [](double constant) {
    auto rest = noise(1, 8);
    const ResidualSignals before =
        joint_with([&](std::size_t i, const ResidualSignals& s) { return constant + rest(i, s); });
    const std::vector<View> views = telling_views(before, joint_with(noise(1e-3, 9)));
    return !views.empty() && views[0].abscissa == Abscissa::constant;
  };
  EXPECT_FALSE(is_told(1.7)) << "74 %";
  EXPECT_TRUE(is_told(2.5)) << "86 %";
}

TEST(Views, OfARestAreThoseThatExplainAFifthOfIt) {
  const auto is_told = [](double share) {
    auto rest = noise(1, 8);
    const double step = std::sqrt(share / (1 - share));
    const ResidualSignals s = joint_with(
        [&](std::size_t i, const ResidualSignals& seen) { return step * seen.joint_direction[i] + rest(i, seen); });
    return !telling_views(s).empty();
  };
  EXPECT_FALSE(is_told(0.15));
  EXPECT_TRUE(is_told(0.25));
}

}  // namespace
}  // namespace halyard
