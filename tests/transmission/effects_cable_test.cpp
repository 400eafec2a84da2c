#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_runs.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// The loop that an effect with one state at joint 1 goes through when the cable's stretch goes to and fro between two
/// values.
struct Loop {
  double work = 0;        ///< of the force on the stretch over the last cycle
  double opening = 0;     ///< of the force over the last cycle: end less start
  double least_work = 0;  ///< of all sums of work since the start at zero stretch and zero state
};
Loop stretch_loop(const ArmParameters<double>& arm, const PlacedEffect& effect, double low, double high, double speed,
                  int cycles) {
  const Transmission<double> t(arm, {effect});
  constexpr int kSteps = 20000;  // a cycle
  double x = 0, z = 0, sum = 0;
  Loop loop;
  const auto at = [&](double stretch, double rate, double state) {
    return evaluate(t, stretched(arm, 0, stretch, rate), &state);
  };
  double force = at(0, 0, 0).s[0].cable_force_motor;
  const auto go = [&](double to, int steps) {
    const double dx = (to - x) / steps, rate = dx > 0 ? speed : -speed, h = dx / rate;
    for (int i = 0; i < steps; ++i) {
      const double k1 = at(x, rate, z).z_dot[0], k2 = at(x + dx / 2, rate, z + h / 2 * k1).z_dot[0];
      const double k3 = at(x + dx / 2, rate, z + h / 2 * k2).z_dot[0], k4 = at(x + dx, rate, z + h * k3).z_dot[0];
      z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      x += dx;
      const double next = at(x, rate, z).s[0].cable_force_motor;
      sum += 0.5 * (force + next) * dx;
      force = next;
      loop.least_work = std::min(loop.least_work, sum);
    }
  };
  go(low, kSteps / 4);
  for (int c = 0; c < cycles; ++c) {
    const double sum_before = sum, force_before = force;
    go(high, kSteps / 2);
    go(low, kSteps / 2);
    loop.work = sum - sum_before;
    loop.opening = force - force_before;
  }
  return loop;
}

TEST(Hysteresis, LoopClosesTakesItsTheoreticalWorkAndDoesNotDependOnSpeed) {
  ArmParameters<double> arm = random_arm(7, CableLaw::linear);
  arm.joint[0].damping = 0;
  const double share = 0.4, yield = 0.01, amplitude = 0.05, stiffness = arm.joint[0].stiffness;
  const PlacedEffect e = placed("hysteresis", arm, 0, {share, yield});
  const Loop slow = stretch_loop(arm, e, -amplitude, amplitude, 0.1, 3);
  const Loop fast = stretch_loop(arm, e, -amplitude, amplitude, 10, 3);
  // In the steady loop z turns at ±z_s, z_s = z_y (1 - exp(-(2A - z_s) / z_y)), and ∮ z dx over both halves follows.
  double turn = yield;
  for (int i = 0; i < 100; ++i) turn = yield * (1 - std::exp(-(2 * amplitude - turn) / yield));
  const double area = 2 * (-0.5 * turn * turn + yield * (2 * amplitude - turn - turn));
  const double work = 2 * stiffness * share * area;
  // Trapezoids of 5e-6 m over an exponential of 0.01 m: (5e-4)² / 12 = 2e-8 of it.
  EXPECT_NEAR(slow.work, work, 1e-7 * work);
  EXPECT_NEAR(fast.work, slow.work, 1e-9 * work);
  // The first cycle forgets its start by exp(-2A / z_y) = 5e-5, the next by that again.
  EXPECT_NEAR(slow.opening, 0, 1e-7 * 2 * stiffness * share * yield);
}

TEST(Hysteresis, TakesWorkOverEveryCycleAndNeverGivesMoreThanItStored) {
  for (const CableLaw law : kLaws) {
    ArmParameters<double> arm = random_arm(7, law);
    arm.joint[0].damping = 0;
    for (const auto& [low, high] : {std::pair(-0.05, 0.05), std::pair(0.001, 0.002), std::pair(-0.03, 0.08)}) {
      const Loop loop = stretch_loop(arm, placed("hysteresis", arm, 0, {0.9, 0.01}), low, high, 1, 4);
      EXPECT_GT(loop.work, 0) << low << ", " << high;
      // The trapezoids' error, see above, of forces of 10 N over 0.1 m.
      EXPECT_GT(loop.least_work, -1e-7) << low << ", " << high;
    }
  }
}

TEST(Hysteresis, PullsHarderWithStretchWhereARunIsSlack) {
  ArmParameters<double> arm = random_arm(7, CableLaw::linear);
  arm.joint[0].damping = 0;
  const double slack_from = arm.joint[0].tension / arm.joint[0].stiffness, unloaded = 0;
  const Transmission<double> t(arm, {placed("hysteresis", arm, 0, {0.9, 0.1 * slack_from})});
  const auto force = [&](double x) { return evaluate(t, stretched(arm, 0, x, 0), &unloaded).s[0].cable_force_joint; };
  // A tenth of the stiffness of one run.
  EXPECT_NEAR((force(3 * slack_from) - force(2 * slack_from)) / slack_from, 0.1 * arm.joint[0].stiffness,
              1e-9 * arm.joint[0].stiffness);
}

TEST(Slack, LimitsWhatAHysteresisLeavesOfTheForce) {
  ArmParameters<double> arm = random_arm(7, CableLaw::paper);
  arm.joint[0].damping = 0;
  const double unloaded = 0, x = 0.1;
  const PlacedEffect loop = placed("hysteresis", arm, 0, {0.9, 0.01});
  const double left =
      evaluate(Transmission<double>(arm, {loop}), stretched(arm, 0, x, 0), &unloaded).s[0].cable_force_joint;
  const double tension = left / 4;
  const PlacedEffect slack = placed("slack", arm, 0, {1, tension});
  for (const auto& effects : {std::vector{slack, loop}, std::vector{loop, slack}})
    EXPECT_NEAR(evaluate(Transmission<double>(arm, effects), stretched(arm, 0, x, 0), &unloaded).s[0].cable_force_joint,
                tension + left / 2, left * 4 * kEps);
}

TEST(Backlash, HasADeadZoneTwiceTheHalfGapWide) {
  const double half_gap = 0.02;
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(8, law);
    const Transmission<double> bare(arm, {}), with(arm, {placed("backlash", arm, 2, {half_gap})});
    const auto force = [&](const Transmission<double>& t, double x, double x_dot) {
      return evaluate(t, stretched(arm, 2, x, x_dot)).s[2].cable_force_joint;
    };
    for (const double x : {-0.999, -0.5, 0.0, 0.7, 0.999}) EXPECT_EQ(force(with, x * half_gap, 0.3), 0) << x;
    // Outside it is the same cable, shifted; the stretch has rounded once more, at 2 k_e of up to 120 N/m and more.
    for (const double x : {0.001, 0.05, 0.2})
      for (const double side : {-1.0, 1.0})
        EXPECT_NEAR(force(with, side * (half_gap + x), 0.3), force(bare, side * x, 0.3), 1e-13 * 100);
  }
}

TEST(Backlash, WithRoundEdgesYieldsBeforeItCarriesTheWholeLoad) {
  constexpr double half_gap = 0.02, rounding = 4e-3, step = 1e-6;
  const ArmParameters<double> arm = random_arm(8, CableLaw::linear);
  const Transmission<double> bare(arm, {}), with(arm, {placed("backlash", arm, 2, {half_gap, rounding})});
  const auto force = [&](const Transmission<double>& t, double x, double x_dot) {
    return evaluate(t, stretched(arm, 2, x, x_dot)).s[2].cable_force_joint;
  };
  // At an edge the other edge, 2 h away, takes off ρ² / 8 h, which is a twentieth of ρ / 2.
  EXPECT_NEAR(force(with, half_gap, 0) / force(bare, 0.5 * rounding, 0), 1, 0.06);
  EXPECT_NEAR(force(with, 0, 0), 0, 1e-12);
  // Far beyond the edge it is the sharp gap, up to ρ² / 4 u.
  EXPECT_NEAR(force(with, 0.2, 0), force(bare, 0.18, 0), force(bare, rounding * rounding / 4 / 0.18, 0));
  // The rate follows the stretch. Differences: an error of step² f''' and the rounding of the force over the step.
  const double k = force(bare, 1e-3, 0) / 1e-3, b = force(bare, 0, 1);
  for (const double x : {-0.025, -0.019, 0.0, 0.01, 0.021}) {
    const double slope = (force(with, x + step, 0) - force(with, x - step, 0)) / (2 * step) / k;
    EXPECT_NEAR(force(with, x, 1) - force(with, x, 0), slope * b, 1e-6 * b) << x;
  }
}

TEST(Stiffness, ScalesTheForceOfStretchAndOfItsRate) {
  for (const CableLaw law : {CableLaw::paper, CableLaw::linear}) {  // both are proportional to stiffness
    const ArmParameters<double> arm = random_arm(9, law);
    const Transmission<double> bare(arm, {}), with(arm, {placed("stiffness", arm, 1, {0.8, 1.5, 0})});
    const auto force = [&](const Transmission<double>& t, double x, double x_dot) {
      return evaluate(t, stretched(arm, 1, x, x_dot)).s[1].cable_force_motor;
    };
    EXPECT_NEAR(force(with, 0.1, 0), 0.8 * force(bare, 0.1, 0), 20 * 8 * kEps);
    EXPECT_NEAR(force(with, 0, 0.5), 1.5 * force(bare, 0, 0.5), 20 * 8 * kEps);
  }
}

TEST(CouplingError, MovesTheCableOfItsJointWithTheInboardOneAndPullsBackOnIt) {
  const ArmParameters<double> arm = random_arm(10, CableLaw::linear);
  const double change = 0.1;
  const Transmission<double> bare(arm, {}), with(arm, {placed("coupling", arm, 2, {0, change})});
  Motion m;
  m.joint_position[1] = 0.2;
  m.motor_angle[2] = 0.5;
  const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
  const double radius = arm.joint[2].pulley_radius;
  EXPECT_NEAR(a.s[2].stretch - b.s[2].stretch, -radius * change * 0.2, 4 * kEps);
  EXPECT_EQ(a.s[1].stretch, b.s[1].stretch);
  // Virtual work: joint 2 feels the cable of joint 3 with the same coefficient; forces reach 50 N.
  const double coefficient = arm.joint[2].coupling[1];
  EXPECT_NEAR(a.s[1].joint_force - b.s[1].joint_force,
              radius * ((coefficient + change) * a.s[2].cable_force_joint - coefficient * b.s[2].cable_force_joint),
              50 * 8 * kEps);
}

TEST(CouplingError, MayBeAsLargeAsTheCouplingItself) {
  ArmParameters<double> arm = random_arm(7, CableLaw::paper);
  arm.joint[0].type = JointType::prismatic, arm.joint[1].type = JointType::revolute;
  arm.joint[1].pulley_radius = 0.03, arm.joint[1].coupling[0] = 0;
  const auto most = [&] { return find_effect("coupling")->parameters(arm, 1)[0].upper; };
  EXPECT_DOUBLE_EQ(most(), 1 / 0.03) << "a cable that the slide carries along";
  arm.joint[1].coupling[0] = -50;
  EXPECT_EQ(most(), 50);
}

TEST(CapstanRatio, ScalesJointTravelPerMotorAngle) {
  const ArmParameters<double> arm = random_arm(11, CableLaw::linear);
  const Transmission<double> with(arm, {placed("capstan_ratio", arm, 0, {1.03})});
  const Eigen::Vector3d q_m(1, 0, 0);
  const Eigen::VectorXd before = unstretched_joints(arm, q_m, Eigen::Vector3d::Zero());
  const Eigen::VectorXd after = unstretched_joints(with.arm(), q_m, Eigen::Vector3d::Zero());
  EXPECT_LT((after - 1.03 * before).norm(), 40 * kEps);
}

TEST(Stiffness, StiffensWithTheCubeOfStretchAndStaysMonotoneWithinItsBounds) {
  for (const CableLaw law : kLaws) {
    ArmParameters<double> arm = random_arm(9, law);
    const auto parameters = find_effect("stiffness")->parameters(arm, 1);
    const auto force = [&](const std::vector<double>& p, double x) {
      return evaluate(Transmission<double>(arm, {placed("stiffness", arm, 1, p)}), stretched(arm, 1, x, 0)).s[1];
    };
    const double ratio = 0.8, beta = 5;
    for (const double x : {-0.2, -0.05, 0.0, 0.1, 0.3}) {
      const double more = 2 * ratio * arm.joint[1].stiffness * beta * x * x * x;
      const JointSignals<double> with = force({ratio, 1, beta}, x), without = force({ratio, 1, 0}, x);
      EXPECT_NEAR(with.cable_force_motor - without.cable_force_motor, more, 100 * 8 * kEps);
      EXPECT_NEAR(with.cable_force_joint - without.cable_force_joint, more, 100 * 8 * kEps);
    }
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 50; ++trial) {
      const auto p = within_bounds(parameters, random);
      for (double x = -0.1; x < 0.095; x += 0.01)  // where the exponential law at its stiffest is not yet cut off
        EXPECT_GT(force(p, x + 0.01).cable_force_motor, force(p, x).cable_force_motor);
    }
  }
}

TEST(Slack, ARunEndsAtZeroTensionAndPullsWithHalfTheStiffnessBeyond) {
  ArmParameters<double> arm = random_arm(14, CableLaw::paper);
  const double tension = 4, k = arm.joint[0].stiffness;
  const Transmission<double> bare(arm, {}), with(arm, {placed("slack", arm, 0, {1, tension})});
  const auto force = [&](const Transmission<double>& t, double x) {
    return evaluate(t, stretched(arm, 0, x, 0)).s[0].cable_force_joint;
  };
  for (const double side : {1.0, -1.0}) {
    for (const double x : {0.01, 0.9 * tension / k})
      EXPECT_NEAR(force(with, side * x), force(bare, side * x), 10 * 4 * kEps);
    // Beyond, one run is slack: the other pulls with its rest tension and half of the pair's force.
    for (const double x : {1.1 * tension / k, 0.3})
      EXPECT_NEAR(force(with, side * x), side * tension + 0.5 * force(bare, side * x), 100 * 4 * kEps);
  }
}

TEST(Slack, UnderALawWithTensionItIsThatLawWithTheOtherTension) {
  std::mt19937_64 random(6);
  for (const CableLaw law : {CableLaw::linear, CableLaw::exponential}) {
    ArmParameters<double> arm = random_arm(15, law), loose = arm;
    loose.joint[2].tension = 5;
    const Transmission<double> model(arm, {}), less(loose, {});
    for (const double share : {1.0, 0.4}) {
      const Transmission<double> with(arm, {placed("slack", arm, 2, {share, 5})});
      for (int trial = 0; trial < 30; ++trial) {
        const Motion m = random_motion(random);
        const auto force = [&](const Transmission<double>& t) { return evaluate(t, m).s[2].cable_force_joint; };
        const double expected = share * force(less) + (1 - share) * force(model);
        EXPECT_NEAR(force(with), expected, 8 * kEps * (1 + std::abs(force(less)) + std::abs(force(model))));
      }
    }
  }
}

TEST(Slack, ForceGrowsWithStretchAndRateWithinItsBounds) {
  std::mt19937_64 random(7);
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(14, law);
    for (int trial = 0; trial < 40; ++trial) {
      const auto p = within_bounds(find_effect("slack")->parameters(arm, 0), random);
      const Transmission<double> with(arm, {placed("slack", arm, 0, p)});
      const auto force = [&](double x, double x_dot) {
        return evaluate(with, stretched(arm, 0, x, x_dot)).s[0].cable_force_motor;
      };
      for (double x = -0.3; x < 0.3; x += 0.02) {
        // Up to the rounding of forces that are the same on both sides, and reach 1e13 N for a lost exponential cable.
        const double rounding = 8 * kEps * std::abs(force(x, 0.1)) + 1e-12;
        EXPECT_GE(force(x + 0.02, 0.1), force(x, 0.1) - rounding);
        EXPECT_GE(force(x, 0.2), force(x, 0.1) - rounding);
      }
    }
  }
}

TEST(Creep, StretchGrowsAndForceRelaxesAsOfAStandardLinearSolid) {
  ArmParameters<double> arm = random_arm(16, CableLaw::linear);
  arm.joint[0].damping = 0;
  const double share = 0.5, tau = 2, k = arm.joint[0].stiffness, step = 0.05, h = 0.01;
  const Transmission<double> with(arm, {placed("creep", arm, 0, {share, tau})});
  const auto at = [&](double x, double z) { return evaluate(with, stretched(arm, 0, x, 0), &z); };
  // Classical Runge-Kutta of z at h / τ = 0.005: errors of (h / τ)⁴ = 6e-10, of numbers of 0.05 m, 5 N.
  const auto run = [&](const auto& stretch_of, const auto& check) {
    double z = 0;
    for (int i = 0; i <= 1000; ++i) {
      check(i * h, z);
      const auto rate = [&](double s) { return at(stretch_of(s), s).z_dot[0]; };
      const double k1 = rate(z), k2 = rate(z + h / 2 * k1), k3 = rate(z + h / 2 * k2), k4 = rate(z + h * k3);
      z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  };
  // The stretch is held: the force falls to 1 / (1 + c) of its start, faster than τ.
  run([&](double) { return step; },
      [&](double t, double z) {
        const double fallen = share / (1 + share) * (1 - std::exp(-(1 + share) * t / tau));
        EXPECT_NEAR(at(step, z).s[0].cable_force_joint, 2 * k * step * (1 - fallen), 1e-8) << t;
      });
  // The force is held, x = step + c z: the stretch grows by the share c with the time constant τ.
  run([&](double z) { return step + share * z; },
      [&](double t, double z) {
        EXPECT_NEAR(at(step + share * z, z).s[0].cable_force_joint, 2 * k * step, 100 * 8 * kEps);
        EXPECT_NEAR(step + share * z, step * (1 + share * (1 - std::exp(-t / tau))), 1e-10) << t;
      });
}

TEST(Creep, TakesWorkOverEveryCycleAndNeverGivesMoreThanItStored) {
  for (const CableLaw law : kLaws) {
    ArmParameters<double> arm = random_arm(16, law);
    arm.joint[0].damping = 0;
    const Loop loop = stretch_loop(arm, placed("creep", arm, 0, {0.8, 0.3}), -0.05, 0.05, 0.1, 3);
    EXPECT_GT(loop.work, 0.01);
    EXPECT_GT(loop.least_work, -1e-7);  // the trapezoids' error, see above
  }
}

TEST(CapstanEccentricity, LosesNoPowerAndItsRateIsThatOfItsStretch) {
  std::mt19937_64 random(8);
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(17, law);
    const JointParameters<double>& j = arm.joint[1];
    for (int trial = 0; trial < 30; ++trial) {
      std::vector<double> p = within_bounds(find_effect("capstan_eccentricity")->parameters(arm, 1), random);
      const Transmission<double> with(arm, {placed("capstan_eccentricity", arm, 1, p)});
      Motion m = random_motion(random), later = m, sooner = m;
      m.motor_angle[1] = later.motor_angle[1] = sooner.motor_angle[1] = 20 * m.motor_angle[1];  // over whole turns
      const Evaluated e = evaluate(with, m);
      double path_rate = 0;
      for (int i = 0; i < 3; ++i) path_rate += j.pulley_radius * j.coupling[i] * m.joint_rate[i];
      const double g = e.s[1].cable_force_joint;
      // The motor's power less the joints' is what goes into the cable. Forces reach 1e3 N for an exponential cable.
      EXPECT_NEAR(e.s[1].cable_force_motor * j.motor_travel() * m.motor_rate[1] - g * path_rate,
                  g * e.s[1].stretch_rate, 8 * kEps * (1 + std::abs(g)));
      const double h = 1e-5;
      for (int i = 0; i < 3; ++i) {
        later.motor_angle[i] += h * m.motor_rate[i], later.joint_position[i] += h * m.joint_rate[i];
        sooner.motor_angle[i] -= h * m.motor_rate[i], sooner.joint_position[i] -= h * m.joint_rate[i];
      }
      // Central difference: h² / 6 of a third derivative of order 1, and the rounding of 3 m over 2 h.
      EXPECT_NEAR((evaluate(with, later).s[1].stretch - evaluate(with, sooner).s[1].stretch) / (2 * h),
                  e.s[1].stretch_rate, 1e-10 + 8 * kEps / h);
    }
  }
}

TEST(CapstanEccentricity, ComesBackToTheModelsStretchAtEveryTurn) {
  const ArmParameters<double> arm = random_arm(17, CableLaw::linear);
  const Transmission<double> bare(arm, {}), with(arm, {placed("capstan_eccentricity", arm, 0, {0.05, -0.02})});
  const auto difference = [&](double turns) {
    Motion m;
    m.motor_angle[0] = 2 * M_PI * arm.joint[0].gear_ratio * turns;
    return evaluate(with, m).s[0].stretch - evaluate(bare, m).s[0].stretch;
  };
  // Travel of 2 m a turn, at an angle that has rounded.
  for (const double turns : {0.0, 1.0, 2.0, -3.0}) EXPECT_NEAR(difference(turns), 0, 20 * 4 * kEps) << turns;
  EXPECT_NEAR(difference(0.25), arm.joint[0].capstan_radius * (0.05 - 0.02), 8 * kEps);
  EXPECT_NEAR(difference(0.5), arm.joint[0].capstan_radius * -0.04, 8 * kEps);
}

TEST(CableSlip, ShiftsTheStretchByItsJumpFromItsTimeOn) {
  const ArmParameters<double> arm = random_arm(18, CableLaw::linear);
  const double jump = 0.02, at = 3;
  const Transmission<double> bare(arm, {}), with(arm, {placed("cable_slip", arm, 2, {jump, at})});
  std::mt19937_64 random(9);
  const Motion m = random_motion(random);
  const auto difference = [&](double time) {
    const Evaluated a = evaluate(with, m, nullptr, time), b = evaluate(bare, m, nullptr, time);
    return std::pair(a.s[2].stretch - b.s[2].stretch, a.s[2].stretch_rate - b.s[2].stretch_rate);
  };
  for (const double before : {0.0, 2.99, at - 0.0051}) EXPECT_EQ(difference(before), std::pair(0.0, 0.0));
  for (const double after : {at + 0.0051, 3.01, 100.0}) {
    EXPECT_NEAR(difference(after).first, -jump, 4 * kEps);
    EXPECT_EQ(difference(after).second, 0);
  }
  // In between the rate's integral is the stretch: Simpson's rule is exact for its parabola.
  const double h = 1e-3;
  double slipped = 0;
  for (double t = at - 0.005; t < at + 0.0045; t += h) {
    slipped += h / 6 * (difference(t).second + 4 * difference(t + h / 2).second + difference(t + h).second);
    EXPECT_NEAR(difference(t + h).first, slipped, 1e-13);  // times of 3 s round to 4e-16, at rates of 3 m/s
  }
  EXPECT_NEAR(slipped, -jump, 1e-13);
}

TEST(CableSlip, TakesItsDuration) {
  const ArmParameters<double> arm = random_arm(18, CableLaw::linear);
  const double jump = 0.02, at = 3, duration = 0.59;  // of a step of 0.6 s in all
  const Transmission<double> bare(arm, {}), with(arm, {placed("cable_slip", arm, 2, {jump, at, duration})});
  std::mt19937_64 random(9);
  const Motion m = random_motion(random);
  const auto slipped = [&](double time) {
    return evaluate(bare, m, nullptr, time).s[2].stretch - evaluate(with, m, nullptr, time).s[2].stretch;
  };
  EXPECT_EQ(slipped(at - 0.301), 0);
  EXPECT_NEAR(slipped(at - 0.15), 0.15625 * jump, 1e-12) << "a quarter of the way: u² (3 - 2u)";
  EXPECT_NEAR(slipped(at), 0.5 * jump, 1e-12);
  EXPECT_NEAR(slipped(at + 0.301), jump, 4 * kEps);
}

}  // namespace
}  // namespace halyard
