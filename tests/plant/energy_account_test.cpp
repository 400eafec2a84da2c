/// The meters of the plant at one instant: what comes in is what is lost and what is stored, with every effect.
///
///   E_in' - E_lost' = dE_stored/dt along the motion

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "plant/arm_plant.h"
#include "tests/support/effect_runs.h"
#include "transmission/effects/library.h"

namespace halyard {
namespace {

constexpr double kTime = 1;  // s; when a typical slip happens

/// Inputs of some 1 N m, stretches of some 0.1 m: linear cables may be slack.
Eigen::VectorXd moving(ArmPlant& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const PlantLayout& l = plant.layout();
  const double command[] = {unit(random), unit(random), unit(random)}, load[] = {unit(random), 0, unit(random)};
  plant.set_inputs(0, command, load);
  Eigen::VectorXd y(l.size()), path(l.n);
  for (int i = 0; i < l.size(); ++i) y(i) = 0.3 * unit(random);
  cable_path(plant.drive().arm(), y.data(), path.data());
  for (int k = 0; k < l.n; ++k)
    y(2 * l.n + *l.motor_angle[k]) = (path(k) + 0.3 * unit(random)) / plant.drive().arm().joint[k].motor_travel();
  for (int i = 0; i < l.n_effect_states; ++i) y(2 * l.n + l.effect_states + i) *= 0.3;
  return y;
}

/// What is missing in the account, W, and the powers that go in and out.
struct Gap {
  double missing, powers;
};

Gap gap_of(ArmPlant& plant, const Eigen::VectorXd& y) {
  const PlantLayout& l = plant.layout();
  Eigen::VectorXd y_dot(y.size());
  plant.derivative(kTime, y.data(), y_dot.data());
  const auto stored_after = [&](double dt_s) {
    const Eigen::VectorXd moved = y + dt_s * y_dot;
    return plant.stored_energy(kTime + dt_s, moved.data());
  };
  constexpr double h = 3e-5;  // s
  const double stored =
      (8 * (stored_after(h) - stored_after(-h)) - (stored_after(2 * h) - stored_after(-2 * h))) / (12 * h);
  const double input = y_dot(2 * l.n + l.input_energy), lost = y_dot(2 * l.n + l.lost_energy);
  return {input - lost - stored, std::abs(input) + std::abs(lost) + std::abs(stored)};
}

class EnergyAccount : public testing::Test {
 protected:
  void expect_closed(const ArmParameters<double>& arm, const std::vector<PlacedEffect>& effects) {
    std::string names;
    for (const PlacedEffect& e : effects) names += (names.empty() ? "" : ", ") + effect_label(e);
    ArmPlant plant(arm, effects);
    for (int trial = 0; trial < 3; ++trial) {
      const Gap gap = gap_of(plant, moving(plant, random_));
      largest_ = std::max(largest_, std::abs(gap.missing) / gap.powers);
      // Differences of fourth order over 30 us, empirical: 4e-9 was observed.
      EXPECT_NEAR(gap.missing, 0, 1e-7 * gap.powers) << names;
    }
  }
  void TearDown() override { std::printf("largest gap: %.1e of the powers\n", largest_); }

  std::mt19937_64 random_{1};
  double largest_ = 0;
};

TEST_F(EnergyAccount, IsClosedWithEveryEffect) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(21, law);
    expect_closed(arm, {});
    for (const auto& effect : built_in_effects())
      for (const EffectPlace place : effect_places(*effect, arm))
        expect_closed(arm, {place_effect(*effect, arm, place)});
  }
}

TEST_F(EnergyAccount, IsClosedWithAStretchThatStatesChangeBetweenOthers) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(22, law);
    const PlacedEffect creep = placed("creep", arm, 1, {}), backlash = placed("backlash", arm, 1, {0.05, 0.02}),
                       eccentricity = placed("capstan_eccentricity", arm, 1, {});
    expect_closed(arm, {creep, backlash});
    expect_closed(arm, {backlash, creep});
    expect_closed(arm, {eccentricity, creep, backlash});
    expect_closed(arm, {creep, backlash, creep, placed("creep", arm, 2, {}), placed("hysteresis", arm, 2, {})});
  }
}

}  // namespace
}  // namespace halyard
