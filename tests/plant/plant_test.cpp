#include "plant/arm_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "estimators/process/arm_dynamics.h"
#include "plant/equilibrium.h"
#include "tests/support/plant_states.h"

namespace halyard {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(ArmPlant, GivesTheCheckValuesOfTheIndependentDerivationToThePrintedDigits) {
  ArmPlant plant(nominal_raven2().nominal);
  const Eigen::Vector3d q(30 * kDegree, 90 * kDegree, 0.40), v(0.5, -0.4, 0.1);
  const Eigen::MatrixXd M = plant.mass_matrix(q);
  // Half a unit of the last digit printed.
  EXPECT_NEAR(M(0, 0), 0.148012, 5e-7);
  EXPECT_NEAR(M(0, 1), 0.021593, 5e-7);
  EXPECT_NEAR(M(0, 2), -0.007846, 5e-7);
  EXPECT_NEAR(M(1, 1), 0.080530, 5e-7);
  EXPECT_NEAR(M(1, 2), 0.0000641, 5e-8);
  EXPECT_NEAR(M(2, 2), 0.407, 1e-12);
  const Eigen::VectorXd hold = plant.holding_force(q), h = plant.velocity_force(q, v);
  EXPECT_NEAR(hold(0), -0.402541, 5e-7);
  EXPECT_NEAR(hold(1), -0.545831, 5e-7);
  EXPECT_NEAR(hold(2), 3.7496, 5e-5);
  EXPECT_NEAR(h(0), 0.00926842, 5e-9);
  EXPECT_NEAR(h(1), -0.00143779, 5e-9);
  EXPECT_NEAR(h(2), -0.0441737, 5e-8);
}

TEST(ArmPlant, HasTheRigidChainOfTheProcessModel) {
  const ArmParameters<double> arm = nominal_raven2().nominal;
  ArmPlant plant(arm);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-3, 3);
  for (int trial = 0; trial < 1000; ++trial) {
    Eigen::VectorXd q(3), v(3);
    for (int k = 0; k < 3; ++k) q(k) = unit(random), v(k) = unit(random);
    const ChainPose<double> pose = chain_pose(arm, q.data());
    double M[kMaxJoints][kMaxJoints], bias[kMaxJoints], zero[kMaxJoints] = {};
    mass_matrix(arm, pose, M);
    inverse_dynamics(arm, pose, v.data(), zero, bias);
    const Eigen::MatrixXd M_simbody = plant.mass_matrix(q);
    const Eigen::VectorXd bias_simbody = plant.velocity_force(q, v) + plant.holding_force(q);
    for (int r = 0; r < 3; ++r) {
      // Two derivations of some hundred roundings each: 1e-9 of the largest entry is far above, any slip far beyond.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(M_simbody(r, c), M[r][c], 1e-9 * M_simbody.cwiseAbs().maxCoeff());
      EXPECT_NEAR(bias_simbody(r), bias[r], 1e-9 * bias_simbody.cwiseAbs().maxCoeff());
    }
  }
}

/// Compares the plant's derivative with the process model's at random states.
void expect_process_model(const ArmParameters<double>& arm, const std::vector<PlacedEffect>& effects) {
  ArmPlant plant(arm, effects);
  const Transmission<double>& transmission = plant.drive().transmission();
  const StateLayout to = state_layout(transmission);
  const PlantLayout& l = plant.layout();
  const double command[3] = {0.02, -0.03, 0.01}, load[3] = {0.1, -0.2, 0.3};
  plant.set_inputs(0, command, load);
  CommandHistory history(3, 1);
  history.push(0, command);
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::VectorXd y = random_state(plant, random);
    Eigen::VectorXd x(to.size), x_dot(to.size), y_dot(l.size());
    for (int k = 0; k < l.n; ++k) {
      x(to.position[k]) = y(k);
      x(to.rate[k]) = y(l.n + k);
      if (!l.motor_angle[k]) continue;
      x(*to.motor_angle[k]) = y(2 * l.n + *l.motor_angle[k]);
      x(*to.motor_rate[k]) = y(2 * l.n + *l.motor_rate[k]);
    }
    for (int i = 0; i < l.n_effect_states; ++i) x(to.effect_states + i) = y(2 * l.n + l.effect_states + i);
    state_derivative(transmission, to, 0.0, &history, command, load, x.data(), x_dot.data());
    plant.derivative(0, y.data(), y_dot.data());
    // Accelerations come from differences of cable forces that are up to 1e3 times larger.
    const double tolerance = 1e-9 * (1 + x_dot.cwiseAbs().maxCoeff());
    for (int k = 0; k < l.n; ++k) {
      EXPECT_NEAR(y_dot(k), x_dot(to.position[k]), tolerance);
      EXPECT_NEAR(y_dot(l.n + k), x_dot(to.rate[k]), tolerance);
      if (!l.motor_angle[k]) continue;
      EXPECT_NEAR(y_dot(2 * l.n + *l.motor_angle[k]), x_dot(*to.motor_angle[k]), tolerance);
      EXPECT_NEAR(y_dot(2 * l.n + *l.motor_rate[k]), x_dot(*to.motor_rate[k]), tolerance);
    }
    for (int i = 0; i < l.n_effect_states; ++i)
      EXPECT_NEAR(y_dot(2 * l.n + l.effect_states + i), x_dot(to.effect_states + i), tolerance);
  }
}

TEST(ArmPlant, MovesAsTheProcessModelOfTheNominalArm) { expect_process_model(nominal_raven2().nominal, {}); }

TEST(ArmPlant, MovesAsTheProcessModelWithEffects) {
  const ArmParameters<double> arm = nominal_raven2().nominal;
  expect_process_model(arm,
                       {placed("payload", arm, kWholeArm), placed("hysteresis", arm, 2), placed("backlash", arm, 1),
                        placed("pulley_friction", arm, 0), placed("hysteresis", arm, 0)});
}

TEST(ArmPlant, MovesAsTheProcessModelWithRigidAndMissingDrives) {
  ArmParameters<double> arm = nominal_raven2().nominal;
  arm.joint[1].drive = Drive::rigid;  // coupled: its rotor couples joints 1 and 2
  expect_process_model(arm, {});
  arm.joint[0].drive = Drive::rigid;
  arm.joint[2].drive = Drive::rigid;
  expect_process_model(arm, {});
  arm.joint[2].drive = Drive::none;
  expect_process_model(arm, {});
}

/// 1 to 7 joints of any kind and drive, at random frames.
ArmParameters<double> random_arm(int n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  ArmParameters<double> arm;
  arm.n = n;
  for (int k = 0; k < n; ++k) {
    JointParameters<double>& j = arm.joint[k];
    j = nominal_raven2().nominal.joint[k % 3];
    std::fill(std::begin(j.coupling), std::end(j.coupling), 0.0);
    for (int i = 0; i < k; ++i) j.coupling[i] = unit(random) - 0.5;
    j.coupling[k] = 1;
    j.drive = static_cast<Drive>(static_cast<int>(3 * unit(random)));
    const Eigen::Matrix3d R =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized().toRotationMatrix();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) j.frame_R[r][c] = R(r, c);
      j.frame_p[r] = 0.3 * unit(random);
      j.com[r] = 0.1 * unit(random);
      j.inertia[r] = 1e-3 * (1 + unit(random));
      j.inertia[3 + r] = 1e-4 * unit(random);
    }
    j.mass = 0.2 + unit(random);
  }
  return arm;
}

/// Of two plants of the same arm on different engines.
void expect_alike(ArmPlant& simbody, ArmPlant& own, std::mt19937_64& random) {
  const PlantLayout& l = own.layout();
  const Eigen::VectorXd y = random_state(own, random), command = 0.02 * Eigen::VectorXd::Random(l.n);
  for (ArmPlant* plant : {&simbody, &own}) plant->set_inputs(0, command.data(), command.data());
  Eigen::VectorXd expected(l.size()), rates(l.size());
  simbody.derivative(0.1, y.data(), expected.data());
  own.derivative(0.1, y.data(), rates.data());
  EXPECT_LT((rates - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.cwiseAbs().maxCoeff()));
  const Eigen::VectorXd other = random_state(own, random);
  const double rise = simbody.stored_energy(0, other.data()) - simbody.stored_energy(0, y.data());
  EXPECT_NEAR(own.stored_energy(0, other.data()) - own.stored_energy(0, y.data()), rise, 1e-9 * (1 + std::abs(rise)));
}

/// The point moves with the last link.
void expect_alike_at_rest_and_in_motion(ArmPlant& simbody, ArmPlant& own, std::mt19937_64& random) {
  const Eigen::VectorXd y = random_state(own, random), q = y.head(own.layout().n), v = y.segment(q.size(), q.size());
  const double point[] = {0.1, -0.2, 0.3};
  EXPECT_LT((own.position_of(point, q) - simbody.position_of(point, q)).norm(), 1e-12 * (1 + q.norm()));
  const Eigen::VectorXd expected = simbody.velocity_force(q, v);
  EXPECT_LT((own.velocity_force(q, v) - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.cwiseAbs().maxCoeff()));
}

TEST(ArmPlant, HasTheSameMotionAndEnergyOnBothEngines) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const ArmParameters<double> arm = random_arm(1 + trial % 7, random);
    std::vector<PlacedEffect> effects;
    for (const Effect* effect : effect_library())
      for (const EffectPlace place : effect_places(*effect, arm))
        if (random() % 8 == 0 && effects.size() < 6) effects.push_back(place_effect(*effect, arm, place));
    ArmPlant simbody(arm, effects), own(arm, effects, Engine::halyard);
    for (int state = 0; state < 5; ++state) {
      expect_alike(simbody, own, random);
      expect_alike_at_rest_and_in_motion(simbody, own, random);
    }
  }
}

TEST(ArmPlant, HasTheExactJacobianOnItsOwnChain) {
  std::mt19937_64 random(12);
  for (int n = 1; n <= 7; ++n) {
    const ArmParameters<double> arm = random_arm(n, random);
    ArmPlant plant(arm, {place_effect(*find_effect("joint_friction"), arm, n - 1)}, Engine::halyard);
    const Eigen::VectorXd y = random_state(plant, random);
    const auto size = y.size();
    Eigen::MatrixXd J(size, size);
    Eigen::VectorXd rate(size);
    plant.derivative(0, y.data(), rate.data());
    plant.jacobian(0, y.data(), rate.data(), J);
    for (Eigen::Index c = 0; c < size; ++c) {
      const double d = 1e-6;
      Eigen::VectorXd above = y, below = y, rate_above(size), rate_below(size);
      above(c) += d, below(c) -= d;
      plant.derivative(0, above.data(), rate_above.data());
      plant.derivative(0, below.data(), rate_below.data());
      const Eigen::VectorXd difference = (rate_above - rate_below) / (2 * d);
      // The difference's own error: rounding of rates up to 1e5 over 2e-6.
      EXPECT_LT((J.col(c) - difference).cwiseAbs().maxCoeff(), 1e-4 * (1 + difference.cwiseAbs().maxCoeff()))
          << n << ' ' << c;
    }
  }
}

TEST(ArmPlant, RefusesAnInertiaThatNoBodyHas) {
  ArmParameters<double> arm = nominal_raven2().nominal;
  arm.joint[2].inertia[0] = 1;
  try {
    ArmPlant plant(arm);
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "link 3: no body has this inertia: each principal moment must be at least 0, and at most the sum of "
                 "the others");
  }
}

TEST(ArmPlant, RefusesALinkWithInertiaAndWithoutMassOnSimbodyAlone) {
  ArmParameters<double> arm = nominal_raven2().nominal;
  arm.joint[1].mass = 0;
  EXPECT_NO_THROW(ArmPlant(arm, {}, Engine::halyard));
  try {
    ArmPlant plant(arm);
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "link 2: has inertia and no mass, which Simbody cannot compute; give it a mass, or take "
                 "engine=\"halyard\"");
  }
}

TEST(RestingState, LeavesTheJointsWithoutAcceleration) {
  const ArmModel model = nominal_raven2();
  for (const char* effect : {"", "backlash", "hysteresis", "pulley_friction", "stiffness"}) {
    std::vector<PlacedEffect> effects;
    if (*effect) effects = {placed(effect, model.nominal, 1)};
    ArmPlant plant(model.nominal, effects);
    const Eigen::VectorXd y = resting_state(plant, 0, model.home());
    Eigen::VectorXd y_dot(y.size());
    plant.derivative(0, y.data(), y_dot.data());
    // Rounding of motor angles of 400 rad moves the cable force by 2 k_e r_m/N eps 400 = 2e-11 N on 0.1 kg m².
    EXPECT_LT(y_dot.segment(3, 3).cwiseAbs().maxCoeff(), 1e-8) << effect;
    EXPECT_EQ(y.segment(3, 3).norm(), 0) << effect;
  }
}

TEST(RestingState, StretchesASoftCableByUpToAMetre) {
  ArmParameters<double> arm = nominal_raven2().nominal;
  const Eigen::VectorXd q = nominal_raven2().home();
  const auto stretch = [&] {
    ArmPlant plant(arm);
    const Eigen::VectorXd y = resting_state(plant, 0, q);
    const double angle = y(2 * plant.layout().n + *plant.layout().motor_angle[1]);
    return arm.joint[1].motor_travel() * (angle - unstretched_motors(arm, q)(1));
  };
  // g = 2 k sinh(x): a stiffness at which the same force takes 0.8 m.
  arm.joint[1].stiffness *= std::abs(std::sinh(stretch())) / std::sinh(0.8);
  EXPECT_NEAR(std::abs(stretch()), 0.8, 1e-9);
}

}  // namespace
}  // namespace halyard
