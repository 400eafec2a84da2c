#include "transmission/effects/library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/arm_model.h"
#include "tests/random_arm.h"
#include "transmission/path_matrix.h"

namespace halyard {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr CableLaw kLaws[] = {CableLaw::paper, CableLaw::exponential, CableLaw::linear};

PlacedEffect placed(const std::string& name, const ArmParameters<double>& arm, int joint,
                    const std::vector<double>& p) {
  PlacedEffect e = place_effect(*find_effect(name), arm, joint);
  for (std::size_t i = 0; i < p.size(); ++i) e.p[i] = p[i];
  return e;
}

/// All built-in effects at all places where they can be.
std::vector<PlacedEffect> built_in_everywhere(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all;
  for (const auto& made : built_in_effects()) {
    const Effect* effect = find_effect(made->name());
    for (const int joint : effect_places(*effect, arm)) all.push_back(place_effect(*effect, arm, joint));
  }
  return all;
}

/// Signals of an arm at a motion.
struct Motion {
  double motor_angle[3] = {}, motor_rate[3] = {}, joint_position[3] = {}, joint_rate[3] = {};
};
struct Evaluated {
  JointSignals<double> s[kMaxJoints];
  double z_dot[kMaxEffectStates] = {};
};
Evaluated evaluate(const Transmission<double>& transmission, const Motion& m, const double* z = nullptr) {
  Evaluated e;
  for (int k = 0; k < transmission.arm().n; ++k) {
    e.s[k].motor_angle = m.motor_angle[k];
    e.s[k].motor_rate = m.motor_rate[k];
    e.s[k].joint_position = m.joint_position[k];
    e.s[k].joint_rate = m.joint_rate[k];
  }
  evaluate_all(transmission, 0, nullptr, z, e.s, e.z_dot);
  return e;
}

/// The motion that stretches joint k's cable by x at the rate x', all joints at rest at zero.
Motion stretched(const ArmParameters<double>& arm, int k, double x, double x_dot) {
  Motion m;
  m.motor_angle[k] = x / arm.joint[k].motor_travel();
  m.motor_rate[k] = x_dot / arm.joint[k].motor_travel();
  return m;
}

Motion random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Motion m;
  for (int k = 0; k < 3; ++k) {
    m.motor_angle[k] = 0.3 * unit(random), m.motor_rate[k] = unit(random);
    m.joint_position[k] = 0.3 * unit(random), m.joint_rate[k] = unit(random);
  }
  return m;
}

// -------------------------------------------------------------------------------------- all effects

TEST(EffectLibrary, ParametersLieInsideTheirBoundsAndAreNamed) {
  for (const PlacedEffect& e : built_in_everywhere(random_arm(1, CableLaw::linear))) {
    SCOPED_TRACE(e.effect->name());
    const auto parameters = e.effect->parameters(random_arm(1, CableLaw::linear), e.joint);
    ASSERT_FALSE(parameters.empty());
    ASSERT_LE(parameters.size(), static_cast<std::size_t>(kMaxEffectParameters));
    EXPECT_LE(e.effect->n_states(), kMaxEffectStates);
    EXPECT_FALSE(e.effect->summary().empty());
    bool differs = false;
    for (const EffectParameter& p : parameters) {
      EXPECT_FALSE(p.name.empty());
      EXPECT_FALSE(p.unit.empty());
      EXPECT_LT(p.lower, p.upper) << p.name;
      EXPECT_LE(p.lower, p.neutral) << p.name;
      EXPECT_LE(p.neutral, p.upper) << p.name;
      EXPECT_LE(p.lower, p.typical) << p.name;
      EXPECT_LE(p.typical, p.upper) << p.name;
      EXPECT_GE(p.tolerance, 0) << p.name;
      differs = differs || p.typical != p.neutral;
    }
    EXPECT_TRUE(differs) << "a search that starts at the neutral values finds nothing to follow";
  }
}

TEST(EffectLibrary, NeutralParametersChangeNothing) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(2, law);
    const EvaluatedArm<double> bare{arm, {}};
    for (PlacedEffect e : built_in_everywhere(arm)) {
      SCOPED_TRACE(e.effect->name() + " at joint " + std::to_string(e.joint + 1));
      const auto parameters = e.effect->parameters(arm, e.joint);
      for (std::size_t i = 0; i < parameters.size(); ++i) e.p[i] = parameters[i].neutral;
      const EvaluatedArm<double> with{arm, e};
      std::mt19937_64 random(3);
      for (int trial = 0; trial < 5; ++trial) {
        std::vector<double> u = random_inputs(with, random);
        if (trial == 0) std::fill(u.begin(), u.begin() + 6 * arm.n, 0.0);   // at rest, unstretched
        if (trial == 1)                                                     // unstretched, moving
          for (int k = 0; k < arm.n; ++k) u[6 * k + 1] = u[6 * k + 3] = 0;
        const std::vector<double> expected = bare(u), got = with(u);
        const int m = with.n_states();   // the rates of its own states come first
        for (std::size_t r = 0; r < expected.size(); ++r) EXPECT_EQ(got[r + m], expected[r]) << "output " << r;
      }
      ArmParameters<double> changed = arm, same = arm;
      e.effect->change_parameters(changed, e.joint, e.p);
      const auto a = named_parameters(changed), b = named_parameters(same);
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(*a[i].value, *b[i].value) << a[i].name;
    }
  }
}

TEST(EffectLibrary, TypicalParametersChangeSomething) {
  const ArmParameters<double> arm = random_arm(2, CableLaw::linear);
  const EvaluatedArm<double> bare{arm, {}};
  for (const PlacedEffect& e : built_in_everywhere(arm)) {
    if (e.joint < 0) continue;   // a payload changes the chain; see below
    const EvaluatedArm<double> with{arm, e};
    std::mt19937_64 random(3);
    const std::vector<double> u = random_inputs(with, random), expected = bare(u), got = with(u);
    bool differs = false;
    for (std::size_t r = 0; r < expected.size(); ++r) differs = differs || got[r + with.n_states()] != expected[r];
    EXPECT_TRUE(differs) << e.effect->name() << " at joint " << e.joint + 1;
  }
}

TEST(EffectLibrary, EffectsAreFoundByNameAndRefusedWhereTheyCannotBe) {
  ArmParameters<double> arm = random_arm(1, CableLaw::linear);
  EXPECT_EQ(find_effect("no such effect"), nullptr);
  EXPECT_FALSE(find_effect("coupling")->applies(arm, 0)) << "no joint is inboard of the first";
  arm.joint[1].drive = Drive::rigid;
  arm.joint[2].drive = Drive::none;
  for (const char* of_cable : {"backlash", "hysteresis", "stiffness", "pulley_friction"})
    EXPECT_FALSE(find_effect(of_cable)->applies(arm, 1)) << of_cable;
  for (const char* of_motor : {"motor_friction", "capstan_ratio", "encoder_offset", "coupling"}) {
    EXPECT_TRUE(find_effect(of_motor)->applies(arm, 1)) << of_motor;
    EXPECT_FALSE(find_effect(of_motor)->applies(arm, 2)) << of_motor;
  }
  EXPECT_TRUE(find_effect("joint_friction")->applies(arm, 2));

  const auto message = [&](const char* name, int joint) -> std::string {
    try {
      place_effect(*find_effect(name), arm, joint);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message("backlash", 1), "effect backlash cannot be at joint 2 of this arm");
  EXPECT_EQ(message("backlash", 3), "effect backlash cannot be at joint 4 of this arm");
  EXPECT_EQ(message("payload", 0), "effect payload belongs to the whole arm: name no joint");
}

// -------------------------------------------------------------------------------------- one by one

TEST(Payload, IsTheDirectSumOfTwoBodies) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::linear);
  for (const double mass : {0.3, -0.2}) {
    const Transmission<double> with(arm, {placed("payload", arm, -1, {mass})});
    const JointParameters<double>&before = arm.joint[2], &after = with.arm().joint[2];
    const double* r = arm.payload_point;
    EXPECT_NEAR(after.mass, before.mass + mass, 2 * kEps * before.mass);
    // The static moment, and the inertia about the frame's origin: sums over both bodies. A few roundings of numbers
    // below 2.
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(after.mass * after.com[i], before.mass * before.com[i] + mass * r[i], 8 * kEps);
    const int row[] = {0, 1, 2, 0, 0, 1}, column[] = {0, 1, 2, 1, 2, 2};
    const auto about_origin = [&](double m, const double* c, int i) {
      const double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
      return m * ((row[i] == column[i] ? square : 0) - c[row[i]] * c[column[i]]);
    };
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(after.inertia[i] + about_origin(after.mass, after.com, i),
                  before.inertia[i] + about_origin(before.mass, before.com, i) + about_origin(mass, r, i), 20 * kEps)
          << i;
    EXPECT_EQ(with.arm().joint[1].mass, arm.joint[1].mass);
  }
}

/// Parameters of a friction effect, anywhere in its bounds or at one of them.
std::vector<double> within_bounds(const std::vector<EffectParameter>& parameters, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-0.5, 1.5);
  std::vector<double> p;
  for (const EffectParameter& e : parameters)
    p.push_back(e.lower + std::clamp(share(random), 0.0, 1.0) * (e.upper - e.lower));
  return p;
}

TEST(MotorFriction, NeverGivesPowerWithinItsBounds) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  arm.joint[1].torque_bias = 0;
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<double> p = within_bounds(find_effect("motor_friction")->parameters(arm, 1), random);
    const Transmission<double> t(arm, {placed("motor_friction", arm, 1, p)});
    const Motion m = random_motion(random);
    // The level can be zero, or its asymmetry one: what is left is the rounding of two equal terms of 10 N m at most.
    EXPECT_LE(evaluate(t, m).s[1].motor_torque * m.motor_rate[1], 10 * 2 * kEps);
  }
}

TEST(JointFriction, NeverGivesPowerWithinItsBounds) {
  const ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  ArmParameters<double> frictionless = arm;
  frictionless.joint[1].joint_coulomb = frictionless.joint[1].joint_viscous = 0;
  const Transmission<double> none(frictionless, {});
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<double> p = within_bounds(find_effect("joint_friction")->parameters(arm, 1), random);
    const Transmission<double> t(arm, {placed("joint_friction", arm, 1, p)});
    const Motion m = random_motion(random);
    const double friction = evaluate(t, m).s[1].joint_force - evaluate(none, m).s[1].joint_force;
    // The reaction of cables, up to 50 N m, is subtracted again.
    EXPECT_LE(friction * m.joint_rate[1], 50 * 4 * kEps);
  }
}

TEST(Friction, AsymmetryPartsTheLevelsOfBothWaysByItsShare) {
  ArmParameters<double> arm = random_arm(5, CableLaw::linear);
  JointParameters<double>& j = arm.joint[0];
  j.motor_viscous = j.joint_viscous = j.torque_bias = 0;
  const double change = 0.1, alpha = 0.2;
  const Transmission<double> motor(arm, {placed("motor_friction", arm, 0, {change, 0, alpha})});
  const Transmission<double> joint(arm, {placed("joint_friction", arm, 0, {change, 0, alpha})});
  const Transmission<double> none(arm, {});
  for (const double way : {1.0, -1.0}) {
    Motion m;
    m.motor_rate[0] = way * 40 * j.motor_smoothing;   // tanh(40) is 1
    EXPECT_NEAR(-way * evaluate(motor, m).s[0].motor_torque, (j.motor_coulomb + change) * (1 + way * alpha), 4 * kEps);
    m = Motion{};
    m.joint_rate[0] = way * 40 * j.joint_smoothing;
    const double more = evaluate(none, m).s[0].joint_force - evaluate(joint, m).s[0].joint_force;
    // Damping forces reach 100 N m.
    EXPECT_NEAR(way * more, change + (j.joint_coulomb + change) * way * alpha, 100 * 4 * kEps);
  }
}

TEST(PulleyFriction, GrowsWithTensionAndLoadAndNotWithSpeed) {
  ArmParameters<double> arm = random_arm(6, CableLaw::linear);
  arm.joint[0].damping = 0;
  const double mu = 0.05, share = 0.3;
  const auto forces = [&](double tension, double stretch, double speed) {
    arm.joint[0].tension = tension;
    const Transmission<double> bare(arm, {}), with(arm, {placed("pulley_friction", arm, 0, {mu, share})});
    Motion m = stretched(arm, 0, stretch, 0);
    m.motor_rate[0] = speed * arm.joint[0].motor_smoothing;
    m.joint_rate[0] = speed * arm.joint[0].joint_smoothing;
    const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
    return std::pair(a.s[0].cable_force_motor - b.s[0].cable_force_motor,
                     a.s[0].cable_force_joint - b.s[0].cable_force_joint);
  };
  // Speeds of 40 v_s and above slide fully.
  for (const double tension : {20.0, 40.0})
    for (const double stretch : {0.0, 0.1, -0.1}) {
      const double level = mu * (2 * tension + 2 * arm.joint[0].stiffness * std::abs(stretch));
      for (const double speed : {40.0, 80.0, -40.0}) {
        const auto [motor, joint] = forces(tension, stretch, speed);
        const double sign = speed > 0 ? 1 : -1;
        EXPECT_NEAR(motor, sign * share * level, 100 * 4 * kEps);
        EXPECT_NEAR(joint, -sign * (1 - share) * level, 100 * 4 * kEps);
      }
    }
}

TEST(PulleyFriction, TakesPowerFromEveryMotion) {
  std::mt19937_64 random(1);
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(6, law);
    for (const double share : {0.0, 0.4, 1.0}) {
      const Transmission<double> bare(arm, {}), with(arm, {placed("pulley_friction", arm, 1, {0.3, share})});
      for (int trial = 0; trial < 50; ++trial) {
        const Motion m = random_motion(random);
        const Evaluated a = evaluate(with, m), b = evaluate(bare, m);
        double power = 0;   // that the friction gives to motors and joints
        for (int k = 0; k < 3; ++k) {
          const double taken = a.s[k].cable_force_motor - b.s[k].cable_force_motor;
          power -= arm.joint[k].motor_travel() * taken * m.motor_rate[k];
          power += (a.s[k].joint_force - b.s[k].joint_force) * m.joint_rate[k];
        }
        EXPECT_LT(power, 0);
      }
    }
  }
}

/// The loop that the hysteresis of joint 1 goes through when its stretch goes to and fro between two values.
struct Loop {
  double work = 0;         ///< of the force on the stretch over the last cycle
  double opening = 0;      ///< of the force over the last cycle: end less start
  double least_work = 0;   ///< of all sums of work since the start at zero stretch and zero state
};
Loop hysteresis_loop(const ArmParameters<double>& arm, const PlacedEffect& hysteresis, double low, double high,
                     double speed, int cycles) {
  const Transmission<double> t(arm, {hysteresis});
  constexpr int kSteps = 20000;   // a cycle
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
  const Loop slow = hysteresis_loop(arm, e, -amplitude, amplitude, 0.1, 3);
  const Loop fast = hysteresis_loop(arm, e, -amplitude, amplitude, 10, 3);
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
      const Loop loop = hysteresis_loop(arm, placed("hysteresis", arm, 0, {0.9, 0.01}), low, high, 1, 4);
      EXPECT_GT(loop.work, 0) << low << ", " << high;
      // The trapezoids' error, see above, of forces of 10 N over 0.1 m.
      EXPECT_GT(loop.least_work, -1e-7) << low << ", " << high;
    }
  }
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

TEST(Stiffness, ScalesTheForceOfStretchAndOfItsRate) {
  for (const CableLaw law : {CableLaw::paper, CableLaw::linear}) {   // both are proportional to stiffness
    const ArmParameters<double> arm = random_arm(9, law);
    const Transmission<double> bare(arm, {}), with(arm, {placed("stiffness", arm, 1, {0.8, 1.5})});
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

TEST(CapstanRatio, ScalesJointTravelPerMotorAngle) {
  const ArmParameters<double> arm = random_arm(11, CableLaw::linear);
  const Transmission<double> with(arm, {placed("capstan_ratio", arm, 0, {1.03})});
  const Eigen::Vector3d q_m(1, 0, 0);
  const Eigen::VectorXd before = unstretched_joints(arm, q_m, Eigen::Vector3d::Zero());
  const Eigen::VectorXd after = unstretched_joints(with.arm(), q_m, Eigen::Vector3d::Zero());
  EXPECT_LT((after - 1.03 * before).norm(), 40 * kEps);
}

TEST(EncoderOffset, ShiftsWhereKinematicsPutsTheJointByTheOffset) {
  const double offset = -0.07;
  for (int k = 0; k < 3; ++k) {
    ArmParameters<double> arm = random_arm(12, CableLaw::linear);
    for (int j = 0; j < 3; ++j) arm.joint[j].motor_encoder_offset = 0;
    const Transmission<double> with(arm, {placed("encoder_offset", arm, k, {offset})});
    JointSignals<double> s[kMaxJoints];
    with.sensor_errors(0, nullptr, s);
    // With all else at zero the reading is that of a joint at `offset`, whose coupling moves other cables that do not
    // move: so the cable's own path counts.
    Eigen::Vector3d q_m = Eigen::Vector3d::Zero();
    for (int j = 0; j < 3; ++j) q_m(j) = s[j].motor_error;
    const Eigen::VectorXd path = path_matrix(arm) * unstretched_joints(arm, q_m, Eigen::Vector3d::Zero());
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(path(j) / arm.joint[j].pulley_radius, j == k ? offset : 0, 8 * kEps);
  }
}

// --------------------------------------------------------------------------------- a user's effect

/// Torque that acts after a delay, through a motor that follows with a time constant and hums with the mains: uses past
/// commands, an internal state and the time.
class SlowMotor : public EffectOf<SlowMotor> {
 public:
  explicit SlowMotor(std::string name = "slow_motor") : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return "late, slow, humming torque"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, int) const override {
    return {{"delay", "s", 0, 0.02, 0, 0.1, 0},
            {"time_constant", "s", 0.05, 0.05, 0.01, 1, 0},
            {"hum", "N m", 0, 0.1, 0, 1, 0}};
  }
  int n_states() const override { return 1; }

  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[c.joint].motor_torque = c.z[0] + c.p[2] * std::sin(kMains * c.time);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T late = c.history ? c.history->at(c.joint, T(c.time) - c.p[0]) : s[c.joint].command;
    z_dot[0] = (late - c.z[0]) / c.p[1];
  }

  static constexpr double kMains = 314.16;

 private:
  std::string name_;
};

TEST(UsersEffect, WithStateTimeAndPastCommandsWorksOverEveryScalarWithoutTheLibrary) {
  ArmParameters<double> arm = random_arm(13, CableLaw::linear);
  arm.joint[1].motor_coulomb = arm.joint[1].motor_viscous = 0;
  const SlowMotor effect;
  const PlacedEffect e = place_effect(effect, arm, 1);
  CommandHistory history(3, 1);
  for (int i = 0; i < 100; ++i) {
    const double command[] = {0, 10 * i * 1e-3, 0};   // a ramp
    history.push(i * 1e-3, command);
  }
  const double time = 0.0805, delay = 0.02, time_constant = 0.05, state = 0.3;
  const EvaluatedArm<double> plain{arm, e};
  std::mt19937_64 random(1);
  std::vector<double> u = random_inputs(plain, random);
  u[6 * arm.n] = state;
  const std::vector<double> out = plain(u, time, &history);
  const int torque = 1 + 8;   // after the state's rate and joint 1's signals
  // 10 N m/s times the time that has passed since the ramp began.
  EXPECT_NEAR(out[0], (10 * (time - delay) - state) / time_constant, 20 * 8 * kEps);
  EXPECT_NEAR(out[torque], state + 0.1 * std::sin(SlowMotor::kMains * time), 4 * kEps);
  EXPECT_NE(out[torque], plain(u, time + 1e-3, &history)[torque]) << "depends on time";

  const EvaluatedArm<Dual> dual{arm, e};
  std::vector<Dual> seeded(u.begin(), u.end());
  seeded[6 * arm.n] = Dual::seed(state, 0);
  seeded[6 * arm.n + 1] = Dual::seed(delay, 1);
  const std::vector<Dual> derivatives = dual(seeded, time, &history);
  EXPECT_NEAR(derivatives[0].d[0], -1 / time_constant, 20 * 4 * kEps);
  // The slope of a ramp's samples has lost digits: 0.8 N m are good to eps, over 0.01 N m a sample.
  EXPECT_NEAR(derivatives[0].d[1], -10 / time_constant, 200 * 160 * kEps);
  EXPECT_EQ(derivatives[torque].d[0], 1);

  const EvaluatedArm<Lanes> lanes{arm, e};
  std::vector<Lanes> packed(u.begin(), u.end());
  for (int l = 0; l < kLaneWidth; ++l) packed[6 * arm.n + 1].set(l, 0.01 * l);
  const std::vector<Lanes> each = lanes(packed, time, &history);
  for (int l = 0; l < kLaneWidth; ++l) {
    u[6 * arm.n + 1] = 0.01 * l;
    EXPECT_EQ(each[0][l], plain(u, time, &history)[0]);
  }
}

TEST(UsersEffect, KeepsItsStateApartFromThoseOfOtherEffects) {
  const ArmParameters<double> arm = random_arm(13, CableLaw::linear);
  const SlowMotor effect;
  const PlacedEffect hysteresis = place_effect(*find_effect("hysteresis"), arm, 0), mine = place_effect(effect, arm, 2);
  const Transmission<double> both(arm, {hysteresis, mine});
  ASSERT_EQ(both.n_states(), 2);
  std::mt19937_64 random(2);
  const Motion m = random_motion(random);
  const double z[] = {0.01, 0.5};
  const Evaluated together = evaluate(both, m, z), first = evaluate(Transmission<double>(arm, {hysteresis}), m, z),
                  second = evaluate(Transmission<double>(arm, {mine}), m, z + 1);
  EXPECT_EQ(together.z_dot[0], first.z_dot[0]);
  EXPECT_EQ(together.z_dot[1], second.z_dot[0]);
  EXPECT_EQ(together.s[0].cable_force_motor, first.s[0].cable_force_motor);
  EXPECT_EQ(together.s[2].motor_torque, second.s[2].motor_torque);
}

TEST(UsersEffect, JoinsTheLibraryOnceUnderANameOfItsOwn) {
  const std::size_t before = effect_library().size();
  register_effect(std::make_unique<SlowMotor>("slow_motor"));
  ASSERT_NE(find_effect("slow_motor"), nullptr);
  EXPECT_EQ(effect_library().size(), before + 1);
  for (const char* taken : {"slow_motor", "backlash"}) {
    try {
      register_effect(std::make_unique<SlowMotor>(taken));
      FAIL() << taken << " was taken twice";
    } catch (const std::invalid_argument& e) {
      EXPECT_EQ(e.what(), "effect \"" + std::string(taken) + "\" is already in the library: give yours another name");
    }
  }
  EXPECT_EQ(effect_library().size(), before + 1);
}

}  // namespace
}  // namespace halyard
