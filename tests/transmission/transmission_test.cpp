#include "transmission/transmission.h"
#include "tests/support/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/random_arm.h"
#include "transmission/coupling.h"
#include "transmission/effects/library.h"

namespace halyard {
namespace {

constexpr double kDifference = 1e-5;  // of central differences
constexpr CableLaw kLaws[] = {CableLaw::paper, CableLaw::exponential, CableLaw::linear};

/// All effects of the library at all places of the arm, and none.
std::vector<PlacedEffect> every_effect(const ArmParameters<double>& arm) {
  std::vector<PlacedEffect> all = {PlacedEffect{}};
  for (const Effect* effect : effect_library())
    for (const EffectPlace joint : effect_places(*effect, arm)) all.push_back(place_effect(*effect, arm, joint));
  return all;
}

std::string name_of(const PlacedEffect& e) { return e.effect ? effect_label(e) : "no effect"; }

TEST(Coupling, MotorPowerIsJointPowerAndWhatStretchesTheCables) {
  std::mt19937_64 random(5);
  for (const CableLaw law : kLaws) {
    ArmParameters<double> arm = random_arm(3, law);
    for (int k = 0; k < arm.n; ++k) {
      JointParameters<double>& j = arm.joint[k];
      j.motor_coulomb = j.motor_viscous = j.joint_coulomb = j.joint_viscous = 0;
    }
    const Transmission<double> transmission(arm, {});
    const EvaluatedArm<double> inputs{arm, {}};
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<double> u = random_inputs(inputs, random);
      JointSignals<double> s[kMaxJoints];
      for (int k = 0; k < arm.n; ++k) {
        s[k].motor_angle = u[6 * k + 1];
        s[k].motor_rate = u[6 * k + 2];
        s[k].joint_position = u[6 * k + 3];
        s[k].joint_rate = u[6 * k + 4];
      }
      transmission.evaluate(0, nullptr, nullptr, s, nullptr);
      double motors = 0, joints = 0, cables = 0, size = 0;
      for (int k = 0; k < arm.n; ++k) {
        motors += arm.joint[k].motor_travel() * s[k].cable_force_motor * s[k].motor_rate;
        joints += s[k].joint_force * s[k].joint_rate;
        cables += s[k].cable_force_motor * s[k].stretch_rate;
        size += std::abs(s[k].cable_force_motor) * (std::abs(s[k].motor_rate) + 2);
      }
      // About 10 roundings of terms no larger than |g| (|ω| + Σ|C q'|).
      EXPECT_NEAR(motors, joints + cables, 10 * kEps * size);
      // The balance is one of powers that are there.
      EXPECT_GT(std::abs(joints), 1e3 * 10 * kEps * size);
    }
  }
}

TEST(Coupling, PathAndReactionAreTheMatrixAndItsTranspose) {
  const ArmParameters<double> arm = random_arm(4, CableLaw::paper);
  const Eigen::MatrixXd R = path_matrix(arm);
  const Eigen::Vector3d q(0.3, -0.7, 0.2), g(5, -3, 2);
  double s[kMaxJoints], force[kMaxJoints];
  cable_path(arm, q.data(), s);
  joint_reaction(arm, g.data(), force);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(s[i], (R * q)(i), 6 * kEps);
    EXPECT_NEAR(force[i], (R.transpose() * g)(i), 6 * kEps * 10);
  }
}

TEST(PathMatrix, JointsAndMotorsWithoutStretchAreInverseToEachOther) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    ArmParameters<double> arm = random_arm(seed, CableLaw::paper);
    if (seed % 2) arm.joint[1].drive = Drive::none;
    if (seed % 3 == 0) arm.joint[0].drive = Drive::rigid;
    const Eigen::Vector3d q(0.4, -0.9, 0.15);
    const Eigen::VectorXd back = unstretched_joints(arm, unstretched_motors(arm, q), q);
    // Couplings within ±0.2 make C well-conditioned: a handful of roundings.
    EXPECT_LT((back - q).norm(), 40 * kEps) << seed;
  }
}

TEST(PathMatrix, UnstretchedMeansThatTheTransmissionSeesNoStretch) {
  const ArmParameters<double> arm = random_arm(6, CableLaw::linear);
  const Eigen::Vector3d q(0.4, -0.9, 0.15);
  const Eigen::VectorXd q_m = unstretched_motors(arm, q);
  JointSignals<double> s[kMaxJoints];
  for (int k = 0; k < 3; ++k) s[k].motor_angle = q_m(k), s[k].joint_position = q(k);
  Transmission<double>(arm, {}).evaluate(0, nullptr, nullptr, s, nullptr);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s[k].stretch, 0, 8 * kEps);
}

TEST(PathMatrix, SaysThatSingularCouplingLeavesAJointDirectionWithoutMotor) {
  ArmParameters<double> arm = random_arm(1, CableLaw::paper);
  arm.n = 2;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) arm.joint[i].coupling[k] = 1;
  try {
    unstretched_joints(arm, Eigen::Vector2d(1, 2), Eigen::Vector2d::Zero());
    FAIL() << "no exception";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "coupling matrix [2 x 2] has rank 1: some joint direction moves no motor; "
                 "correct the coupling coefficients");
  }
}

TEST(Friction, OpposesMotionIsOddAndReachesTheCoulombLevel) {
  const double coulomb = 0.5, viscous = 0.01, v_s = 5e-3;
  for (const double v : {1e-4, 5e-3, 0.3, 4.0}) {
    EXPECT_GT(friction(coulomb, viscous, v_s, v), 0);
    // The compiler's tanh of a constant and the library's may differ in the last place.
    EXPECT_NEAR(friction(coulomb, viscous, v_s, -v), -friction(coulomb, viscous, v_s, v), 2 * kEps * coulomb);
  }
  EXPECT_NEAR(friction(coulomb, 0.0, v_s, v_s), coulomb * std::tanh(1.0), kEps);
  EXPECT_NEAR(std::tanh(1.0), 0.76, 0.002);                                  // as the header says
  EXPECT_EQ(friction(coulomb, viscous, v_s, 4.0), coulomb + viscous * 4.0);  // tanh(800) is 1
  const Dual f = friction(Dual(coulomb), Dual(viscous), Dual(v_s), Dual::seed(0, 0));
  EXPECT_NEAR(f.d[0], coulomb / v_s + viscous, 4 * kEps * coulomb / v_s);
}

TEST(Transmission, DerivativesAreThoseOfFiniteDifferencesWithEachEffect) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(11, law);
    for (const PlacedEffect& effect : every_effect(arm)) {
      const EvaluatedArm<double> plain{arm, effect};
      const EvaluatedArm<Dual> dual{arm, effect};
      std::mt19937_64 random(7);
      const std::vector<double> u = random_inputs(plain, random);
      const int size = static_cast<int>(u.size());
      for (int i = 0; i < size; ++i) {
        std::vector<Dual> seeded(u.begin(), u.end());
        seeded[i] = Dual::seed(u[i], i % kDualWidth);
        const std::vector<Dual> out = dual(seeded);
        // Parameters may be small numbers that something is divided by.
        const bool is_parameter = i >= 6 * arm.n;
        const double step = is_parameter ? 0.1 * kDifference : kDifference;
        // The difference of 1 / p² over p ± step is off by twice (step / p)² of it.
        const double of_a_divisor = is_parameter && u[i] != 0 ? 2 * std::pow(step / u[i], 2) : 0;
        std::vector<double> above = u, below = u;
        above[i] += step;
        below[i] -= step;
        const std::vector<double> high = plain(above), low = plain(below);
        for (std::size_t r = 0; r < out.size(); ++r) {
          const double difference = (high[r] - low[r]) / (2 * step);
          // Ten roundings of forces up to 100 are 2.2e-13 N; third derivatives reach 1000 by the inputs (T_0 a³ of the
          // exponential law) and 2e4 by the parameters (6 |x'| z / z_y⁴): at most 1.1e-7 from either.
          EXPECT_NEAR(out[r].d[i % kDualWidth], difference,
                      3e-7 * std::max(1.0, std::abs(difference) / 100) + of_a_divisor * std::abs(difference))
              << name_of(effect) << ": output " << r << " by input " << i;
        }
      }
    }
  }
}

TEST(Transmission, LanesAreThePlainArmLaneByLaneWithEachEffect) {
  for (const CableLaw law : kLaws) {
    const ArmParameters<double> arm = random_arm(12, law);
    for (const PlacedEffect& effect : every_effect(arm)) {
      const EvaluatedArm<double> plain{arm, effect};
      const EvaluatedArm<Lanes> lanes{arm, effect};
      std::mt19937_64 random(8);
      std::vector<std::vector<double>> u;
      for (int l = 0; l < kLaneWidth; ++l) u.push_back(random_inputs(plain, random));
      std::vector<Lanes> packed(u[0].size());
      for (std::size_t i = 0; i < packed.size(); ++i)
        for (int l = 0; l < kLaneWidth; ++l) packed[i].set(l, u[l][i]);
      const std::vector<Lanes> out = lanes(packed);
      for (int l = 0; l < kLaneWidth; ++l) {
        const std::vector<double> expected = plain(u[l]);
        for (std::size_t r = 0; r < out.size(); ++r)
          // Sums of forces up to 100 with about 10 roundings, and 5 eps for each transcendental function in them.
          EXPECT_NEAR(out[r][l], expected[r], 20 * kEps * 100) << name_of(effect) << ": output " << r << ", lane " << l;
      }
    }
  }
}

TEST(Transmission, PackedArmsKeepTheirOwnNumbers) {
  ArmParameters<double> arms[kLaneWidth];
  for (int l = 0; l < kLaneWidth; ++l) arms[l] = random_arm(20 + l, CableLaw::paper);
  const ArmParameters<Lanes> packed = pack(arms);
  EXPECT_EQ(packed.n, 3);
  for (int l = 0; l < kLaneWidth; ++l) {
    EXPECT_EQ(packed.joint[1].stiffness[l], arms[l].joint[1].stiffness);
    EXPECT_EQ(packed.joint[2].coupling[0][l], arms[l].joint[2].coupling[0]);
    EXPECT_EQ(packed.joint[0].inertia[5][l], arms[l].joint[0].inertia[5]);
  }
}

TEST(JointSignals, OfWhichNothingIsKnownAreZero) {
  const auto& [command, motor_angle, motor_rate, joint_position, joint_rate, external_force, motor_torque, stretch,
               stretch_rate, cable_force_motor, cable_force_joint, joint_force, motor_error, joint_error,
               joint_acceleration, motor_friction_drift, joint_friction_drift] = JointSignals<double>{};
  for (const double signal : {command, motor_angle, motor_rate, joint_position, joint_rate, external_force,
                              motor_torque, stretch, stretch_rate, cable_force_motor, cable_force_joint, joint_force,
                              motor_error, joint_error, joint_acceleration, motor_friction_drift, joint_friction_drift})
    EXPECT_EQ(signal, 0);
}

TEST(PathMatrix, AJointWithoutDriveHasNoMotorWhoseAngleCounts) {
  ArmParameters<double> arm = random_arm(3, CableLaw::paper);
  arm.joint[1].drive = Drive::none;
  const Eigen::Vector3d q(0.4, -0.9, 0.15);
  Eigen::VectorXd q_m = unstretched_motors(arm, q);
  EXPECT_EQ(q_m(1), 0);
  const Eigen::VectorXd joints = unstretched_joints(arm, q_m, q);
  q_m(1) = 7;
  EXPECT_EQ(unstretched_joints(arm, q_m, q), joints);
}

/// A rigid drive, a joint without one, and a cable, in motion and under load.
struct MixedDrives {
  ArmParameters<double> arm = random_arm(14, CableLaw::linear);
  JointSignals<double> s[kMaxJoints];

  MixedDrives() {
    arm.joint[0].drive = Drive::rigid;
    arm.joint[1].drive = Drive::none;
    for (int k = 0; k < 3; ++k) {
      s[k].command = 0.5 + k;
      s[k].motor_angle = 0.3;
      s[k].motor_rate = 0.7;
      s[k].joint_position = -0.2;
      s[k].joint_rate = 0.4;
      s[k].external_force = 2 - k;
    }
    Transmission<double>(arm, {}).evaluate(0, nullptr, nullptr, s, nullptr);
  }
};

TEST(Transmission, NothingButACableIsStretchedOrPulls) {
  const MixedDrives mixed;
  for (int k = 0; k < 3; ++k)
    for (const double of_cable :
         {mixed.s[k].stretch, mixed.s[k].stretch_rate, mixed.s[k].cable_force_motor, mixed.s[k].cable_force_joint})
      EXPECT_EQ(of_cable != 0, k == 2) << k;
}

TEST(Transmission, AJointsForceIsThatOfTheCablesAndTheLoadLessItsFriction) {
  const MixedDrives mixed;
  const double g = mixed.s[2].cable_force_joint;
  for (int k = 0; k < 3; ++k) {
    const JointParameters<double>& j = mixed.arm.joint[k];
    const double force = path_per_joint(mixed.arm.joint[2], k) * g + mixed.s[k].external_force -
                         friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, mixed.s[k].joint_rate);
    EXPECT_NEAR(mixed.s[k].joint_force, force, 100 * 4 * kEps) << k;  // a cable pulls with up to 100 N
  }
}

TEST(Transmission, AMotorsTorqueIsItsScaledCommandAndBiasLessItsFriction) {
  const MixedDrives mixed;
  for (const int k : {0, 2}) {
    const JointParameters<double>& j = mixed.arm.joint[k];
    const double torque = j.torque_scale * mixed.s[k].command + j.torque_bias -
                          friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, mixed.s[k].motor_rate);
    EXPECT_NEAR(mixed.s[k].motor_torque, torque, 3 * 4 * kEps) << k;
  }
  EXPECT_EQ(mixed.s[1].motor_torque, 0) << "there is no motor";
}

/// A state that follows the torque of the motor, as the heat of its winding does.
class FollowsTorque : public EffectOf<FollowsTorque> {
 public:
  explicit FollowsTorque(EffectStage acts_at) : acts_at_(acts_at) {}
  std::string name() const override { return "follows_torque"; }
  std::string summary() const override { return "a state that follows the torque of the motor"; }
  unsigned stages() const override { return static_cast<unsigned>(acts_at_); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"gain", "1", 0, 1, 0, 2}};
  }
  int n_states() const override { return 1; }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    z_dot[0] = c.p[0] * s[*c.joint].motor_torque - c.z[0];
  }

 private:
  EffectStage acts_at_;
};

TEST(Transmission, AStateThatNeedsTheTorqueOfItsMotorHasItWhereTorquesAreUnwanted) {
  const ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  for (const EffectStage stage : {EffectStage::command, EffectStage::motor}) {
    const FollowsTorque effect(stage);
    const PlacedEffect without_state = place_effect(*find_effect("backlash"), arm, 0);
    const Transmission<double> transmission(arm, {place_effect(effect, arm, 1), without_state});
    JointSignals<double> wanted[kMaxJoints], unwanted[kMaxJoints];
    for (int k = 0; k < 3; ++k) {
      wanted[k].command = unwanted[k].command = 1 + k;
      wanted[k].motor_rate = unwanted[k].motor_rate = 0.5;
    }
    const double z = 0.25;
    double rate = 0, same = 0;
    transmission.evaluate(0, nullptr, &z, wanted, &rate);
    transmission.evaluate(0, nullptr, &z, unwanted, &same, MotorTorques::unwanted);
    EXPECT_EQ(rate, wanted[1].motor_torque - z);
    EXPECT_EQ(same, rate);
  }
}

TEST(Transmission, TorquesThatNothingNeedsAreNotComputedWhereTheyAreUnwanted) {
  const ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  // One effect has a state, another acts at the motor.
  const Transmission<double> transmission(
      arm, {place_effect(*find_effect("hysteresis"), arm, 0), place_effect(*find_effect("torque_ripple"), arm, 1)});
  JointSignals<double> s[kMaxJoints];
  for (JointSignals<double>& of_joint : s) of_joint.motor_torque = kNan;
  const double z = 0;
  double rate = 0;
  transmission.evaluate(0, nullptr, &z, s, &rate, MotorTorques::unwanted);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isnan(s[k].motor_torque)) << k;
}

/// Two effects of the first joint, of which one ranks before the other.
std::vector<std::pair<PlacedEffect, PlacedEffect>> effects_by_rank(const ArmParameters<double>& arm) {
  const auto of = [&](const char* name, std::vector<double> p) {
    PlacedEffect e = place_neutral_effect(*find_effect(name), arm, 0);
    std::ranges::copy(p, e.p);
    return e;
  };
  return {{of("delay", {0.01}), of("actuator_saturation", {1, 0.4, 1e4})},
          {of("cable_slip", {0.03, 0.5}), of("backlash", {0.02})},
          {of("creep", {0.5, 1}), of("backlash", {0.02})},
          {of("capstan_eccentricity", {0.2, 0.1}), of("backlash", {0.02})},
          {of("pulley_friction", {0.2}), of("capstan_eccentricity", {0.2, 0.1})},
          {of("hysteresis", {0.4, 0.01}), of("capstan_eccentricity", {0.2, 0.1})}};
}

TEST(Transmission, EffectsActByTheirRankWhereverTheyStand) {
  const ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  CommandHistory history(3, 1e-3);
  for (int i = 0; i <= 100; ++i) {
    const double command[3] = {i < 95 ? 0.1 : 3.0, 0, 0};
    history.push(i * 1e-3, command);
  }
  for (const auto& [first, second] : effects_by_rank(arm)) {
    SCOPED_TRACE(effect_label(first) + ", " + effect_label(second));
    JointSignals<double> s[2][kMaxJoints];
    const double z = 0.01;  // of the one that has a state
    double z_dot[2] = {0, 0};
    for (const bool turned : {false, true}) {
      const Transmission<double> transmission(arm, turned ? std::vector{second, first} : std::vector{first, second});
      JointSignals<double>* const of = s[turned];
      of[0].command = 3, of[0].motor_angle = 0.9, of[0].motor_rate = 0.4, of[0].joint_rate = 0.1;
      transmission.evaluate(0.1, &history, &z, of, &z_dot[turned]);
    }
    EXPECT_EQ(s[1][0].motor_torque, s[0][0].motor_torque);
    EXPECT_EQ(s[1][0].stretch, s[0][0].stretch);
    EXPECT_EQ(s[1][0].stretch_rate, s[0][0].stretch_rate);
    EXPECT_EQ(s[1][0].cable_force_motor, s[0][0].cable_force_motor);
    EXPECT_EQ(s[1][0].cable_force_joint, s[0][0].cable_force_joint);
    EXPECT_EQ(z_dot[1], z_dot[0]);
  }
}

TEST(Transmission, TheCableIsStretchedByWhatASlipLeavesBeyondTheGap) {
  const ArmParameters<double> arm = random_arm(15, CableLaw::linear);
  const auto effects = effects_by_rank(arm)[1];
  const Transmission<double> transmission(arm, {effects.second, effects.first});
  // The cable has slipped by 0.03 m, and the gap is 0.02 m to both sides.
  for (const auto& [wound, stretch] : {std::pair(0.02, 0.0), {0.04, 0.0}, {0.06, 0.01}, {0.0, -0.01}}) {
    JointSignals<double> s[kMaxJoints];
    s[0].motor_angle = wound / arm.joint[0].motor_travel();
    transmission.evaluate(1, nullptr, nullptr, s, nullptr);
    EXPECT_NEAR(s[0].stretch, stretch, 1e-15) << wound;
  }
}

TEST(ArmSignals, OfWhatMayBeLeftOutAreZero) {
  ArmSignals<double> signals(2);
  for (int k = 0; k < 2; ++k) {
    const JointSignals<double>& s = signals.joint()[k];
    for (const double left_out : {s.motor_torque, s.motor_error, s.joint_error, s.joint_acceleration}) {
      EXPECT_EQ(left_out, 0) << k;
    }
  }
}

}  // namespace
}  // namespace halyard
