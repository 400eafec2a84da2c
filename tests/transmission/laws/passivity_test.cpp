/// Work that whoever moves motors and joints puts into a transmission over closed cycles: a passive one, which starts
/// relaxed, gives none back.
///
///   W = -∮ Σ_k (τ_k - (r_m/N)_k g_k) q_m,k' + F_k q_k'  dt  >= 0
///
///   τ, g   motor torque, cable force at the capstan    F   joint force
///
/// Commands are constant: like weights, they do no work over a closed cycle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/support/effect_runs.h"
#include "transmission/effects/library.h"

namespace halyard {
namespace {

/// Effects that feed energy by nature.
const std::map<std::string, std::string> kActive = {
    {"external_force", "somebody pushes the joint"},
    {"cable_slip", "moves the end of a tight cable at a given time"},
};

/// Effects that the transmission does not feel: the chain or the sensors do.
const std::vector<std::string> kOutside = {"payload", "gravity_tilt", "encoder_offset", "encoder_eccentricity"};

constexpr double kPeriod = 5;  // s
constexpr int kCycles = 2;

/// A closed path of motors and joints that starts at zero, and the constant commands.
struct Cycle {
  double stretch[3][4], joint[3][4], command[3];

  explicit Cycle(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 4; ++i) stretch[k][i] = 0.05 * unit(random), joint[k][i] = 0.1 * unit(random);
      command[k] = unit(random);
    }
  }

  Motion at(const ArmParameters<double>& arm, double t) const {
    const double w = 2 * std::numbers::pi / kPeriod, s = std::sin(w * t), c = std::cos(w * t);
    const double shape[4] = {s, 1 - c, 2 * s * c, 2 * s * s};
    const double rate[4] = {w * c, w * s, 2 * w * (c * c - s * s), 4 * w * s * c};
    Motion m;
    double x[3] = {}, x_dot[3] = {};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 4; ++i) {
        m.joint_position[k] += joint[k][i] * shape[i], m.joint_rate[k] += joint[k][i] * rate[i];
        x[k] += stretch[k][i] * shape[i], x_dot[k] += stretch[k][i] * rate[i];
      }
      m.command[k] = command[k];
    }
    double path[3], path_rate[3];
    cable_path(arm, m.joint_position, path);
    cable_path(arm, m.joint_rate, path_rate);
    for (int k = 0; k < 3; ++k) {
      m.motor_angle[k] = (x[k] + path[k]) / arm.joint[k].motor_travel();
      m.motor_rate[k] = (x_dot[k] + path_rate[k]) / arm.joint[k].motor_travel();
    }
    return m;
  }
};

struct Work {
  double net = 0, gross = 0;  ///< ∫ P dt, ∫ |P| dt
};

double power_into(const Transmission<double>& transmission, const Motion& m, const Evaluated& e) {
  double power = 0;
  for (int k = 0; k < 3; ++k) {
    const double pull = transmission.arm().joint[k].motor_travel() * e.s[k].cable_force_motor;
    power -= (e.s[k].motor_torque - pull) * m.motor_rate[k] + e.s[k].joint_force * m.joint_rate[k];
  }
  return power;
}

/// By Simpson's rule; the states by the classical Runge-Kutta method with the same nodes.
Work work_over(const ArmParameters<double>& arm, const Transmission<double>& transmission, const Cycle& cycle,
               int steps) {
  const double h = kPeriod / steps;
  const int n = transmission.n_states();
  std::vector<double> z(kMaxEffectStates, 0.0), moved(kMaxEffectStates);
  const auto evaluated = [&](double t, const std::vector<double>& at) {
    return evaluate(transmission, cycle.at(arm, t), at.data(), t);
  };
  const auto shifted = [&](const Evaluated& e, double by) {
    for (int i = 0; i < n; ++i) moved[i] = z[i] + by * e.z_dot[i];
    return moved;
  };
  Work work;
  for (int i = 0; i < kCycles * steps; ++i) {
    const double t = i * h;
    const Evaluated k1 = evaluated(t, z), k2 = evaluated(t + h / 2, shifted(k1, h / 2)),
                    k3 = evaluated(t + h / 2, shifted(k2, h / 2)), k4 = evaluated(t + h, shifted(k3, h));
    const double first = power_into(transmission, cycle.at(arm, t), k1),
                 middle = power_into(transmission, cycle.at(arm, t + h / 2), k3),
                 last = power_into(transmission, cycle.at(arm, t + h), k4);
    work.net += h / 6 * (first + 4 * middle + last);
    work.gross += h / 6 * (std::abs(first) + 4 * std::abs(middle) + std::abs(last));
    for (int j = 0; j < n; ++j) z[j] += h / 6 * (k1.z_dot[j] + 2 * k2.z_dot[j] + 2 * k3.z_dot[j] + k4.z_dot[j]);
  }
  return work;
}

/// The work of a run, and how far below zero rounding and the steps alone could bring it.
struct Judged {
  Work work;
  double tolerance;
};
Judged judged_work(const ArmParameters<double>& arm, const PlacedEffect& effect, const Cycle& cycle) {
  std::vector<PlacedEffect> effects;
  if (effect.effect) effects.push_back(effect);
  const Transmission<double> transmission(arm, effects);
  const int steps = transmission.n_states() > 0 ? 600 : 150;  // bristles turn round within a hundredth of the path
  const Work coarse = work_over(arm, transmission, cycle, steps), fine = work_over(arm, transmission, cycle, 2 * steps);
  // A kink of a force costs the second order: the finer run is off by some third of the difference. The difference may
  // be small by chance, because a kink lies differently in the steps of both: at most 1e-5 of the work more (observed:
  // 4e-6). Each power rounds by some ten ulps.
  return {fine, 3 * std::abs(fine.net - coarse.net) + (1e-5 + 10 * kEps) * fine.gross};
}

ArmParameters<double> lossless(ArmParameters<double> arm) {
  for (int k = 0; k < arm.n; ++k) {
    JointParameters<double>& j = arm.joint[k];
    j.motor_coulomb = j.motor_viscous = j.joint_coulomb = j.joint_viscous = j.damping = 0;
  }
  return arm;
}

TEST(Passivity, AnArmWithoutFrictionAndDampingIsLossless) {
  std::mt19937_64 random(1);
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = lossless(random_arm(31, law));
    const Judged judged = judged_work(arm, {}, Cycle(random));
    EXPECT_GT(judged.work.gross, 1);  // J
    EXPECT_NEAR(judged.work.net, 0, judged.tolerance);
  }
}

/// Sizes from a third to three times the typical ones, of either sign where the bounds allow it; shapes likewise, but
/// twenty times the deflections at which bristles slide: steps through seconds do not resolve less.
/// effects_*_test.cpp have the powers at the bounds.
PlacedEffect drawn(const ArmParameters<double>& arm, const PlacedEffect& typical, std::mt19937_64& random) {
  std::uniform_real_distribution<double> factor(1.0 / 3, 3);
  std::bernoulli_distribution is_turned(0.5);
  PlacedEffect e = typical;
  const std::vector<EffectParameter> parameters = e.effect->parameters(arm, e.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EffectParameter& p = parameters[i];
    const double size = (p.typical - p.neutral) * factor(random) * (is_turned(random) ? -1 : 1);
    const double wide = p.name == "deflection" || p.name == "yield_stretch" ? 20 : 1;
    e.p[i] = p.is_shape() ? wide * p.typical * factor(random) : p.neutral + size;
  }
  keep_within_bounds(e, arm);
  return e;
}

TEST(Passivity, NoEffectGivesWorkOverClosedCycles) {
  std::mt19937_64 random(2);
  for (const CableLaw law : kLaws)
    for (const ArmParameters<double>& arm : {random_arm(31, law), lossless(random_arm(31, law))})
      for (const auto& effect : built_in_effects()) {
        if (kActive.contains(effect->name())) continue;
        for (const EffectPlace place : effect_places(*effect, arm))
          for (int draw = 0; draw < 2; ++draw) {
            const PlacedEffect e = drawn(arm, place_effect(*effect, arm, place), random);
            const Judged judged = judged_work(arm, e, Cycle(random));
            EXPECT_GE(judged.work.net, -judged.tolerance) << effect_label(e);
            EXPECT_LT(judged.tolerance, 1e-3 * judged.work.gross) << effect_label(e) << ": the steps are too long";
          }
      }
}

TEST(Passivity, EffectsOfChainAndSensorsLeaveTheTransmissionAlone) {
  std::mt19937_64 random(3);
  const ArmParameters<double> arm = random_arm(31, CableLaw::paper);
  const Cycle cycle(random);
  const double bare = judged_work(arm, {}, cycle).work.net;
  for (const std::string& name : kOutside)
    for (const EffectPlace place : effect_places(*find_effect(name), arm))
      EXPECT_EQ(judged_work(arm, place_effect(*find_effect(name), arm, place), cycle).work.net, bare) << name;
}

/// A joint that pushes where it moves.
class LivelyJoint : public EffectOf<LivelyJoint> {
 public:
  std::string name() const override { return "lively_joint"; }
  std::string summary() const override { return "friction of the wrong sign"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override { return {}; }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force += T(0.1) * s[*c.joint].joint_rate;
  }
};

TEST(Passivity, AnEffectThatGivesWorkIsSeen) {
  std::mt19937_64 random(4);
  const LivelyJoint lively;
  const ArmParameters<double> arm = lossless(random_arm(31, CableLaw::linear));
  for (int k = 0; k < 3; ++k) {
    const Judged judged = judged_work(arm, {&lively, k, {}}, Cycle(random));
    EXPECT_LT(judged.work.net, -10 * judged.tolerance);
  }
}

TEST(Passivity, EffectsThatAreExemptDoGiveWork) {
  std::mt19937_64 random(5);
  const ArmParameters<double> arm = lossless(random_arm(31, CableLaw::linear));
  for (const auto& [name, reason] : kActive) {
    bool has_given = false;
    for (int draw = 0; draw < 20; ++draw) {
      const Judged judged = judged_work(arm, drawn(arm, placed(name, arm, 0, {}), random), Cycle(random));
      has_given = has_given || judged.work.net < -10 * judged.tolerance;
    }
    EXPECT_TRUE(has_given) << name << ": " << reason;
  }
}

}  // namespace
}  // namespace halyard
