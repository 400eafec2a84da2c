#include "plant/arm_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "estimators/process/arm_dynamics.h"
#include "model/model_file.h"
#include "plant/equilibrium.h"
#include "plant/integrators/integrator.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

PlacedEffect placed(const std::string& name, const ArmParameters<double>& arm, EffectPlace joint) {
  return place_effect(*find_effect(name), arm, joint);
}

/// One link that turns about a horizontal axis, its mass at a distance below it.
ArmParameters<double> pendulum(double mass, double length) {
  ArmParameters<double> arm;
  arm.n = 1;
  arm.gravity[0] = 9.81;
  JointParameters<double>& j = arm.joint[0];
  j.drive = Drive::none;
  j.coupling[0] = 1;
  j.mass = mass;
  j.com[0] = length;
  for (int i = 0; i < 3; ++i) j.inertia[i] = 1e-12;  // a point, as nearly as Simbody takes one
  return arm;
}

Eigen::VectorXd random_state(const ArmPlant& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const PlantLayout& l = plant.layout();
  const ArmParameters<double>& arm = plant.drive().arm();
  Eigen::VectorXd y(l.size()), q(l.n), path(l.n);
  for (int i = 0; i < l.size(); ++i) y(i) = unit(random);
  if (l.n > 2) y(2) = 0.4 + 0.1 * y(2);
  cable_path(arm, y.data(), path.data());
  for (int k = 0; k < l.n; ++k) {  // a millimetre of stretch, motors at speed
    if (!l.motor_angle[k]) continue;
    y(2 * l.n + *l.motor_angle[k]) = (path(k) + 1e-3 * unit(random)) / arm.joint[k].motor_travel();
    y(2 * l.n + *l.motor_rate[k]) = 30 * unit(random);
  }
  for (int i = 0; i < l.n_effect_states; ++i) y(2 * l.n + l.effect_states + i) *= 1e-4;
  return y;
}

TEST(ArmPlant, GivesTheCheckValuesOfTheIndependentDerivationToThePrintedDigits) {
  ArmPlant plant(raven2().nominal);
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
  const ArmParameters<double> arm = raven2().nominal;
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

TEST(ArmPlant, MovesAsTheProcessModelOfTheNominalArm) { expect_process_model(raven2().nominal, {}); }

TEST(ArmPlant, MovesAsTheProcessModelWithEffects) {
  const ArmParameters<double> arm = raven2().nominal;
  expect_process_model(arm,
                       {placed("payload", arm, kWholeArm), placed("hysteresis", arm, 2), placed("backlash", arm, 1),
                        placed("pulley_friction", arm, 0), placed("hysteresis", arm, 0)});
}

TEST(ArmPlant, MovesAsTheProcessModelWithRigidAndMissingDrives) {
  ArmParameters<double> arm = raven2().nominal;
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
    j = raven2().nominal.joint[k % 3];
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

TEST(ArmPlant, HasTheSameMotionAndEnergyOnBothEngines) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const ArmParameters<double> arm = random_arm(1 + trial % 7, random);
    std::vector<PlacedEffect> effects;
    for (const Effect* effect : effect_library())
      for (const EffectPlace place : effect_places(*effect, arm))
        if (random() % 8 == 0 && effects.size() < 6) effects.push_back(place_effect(*effect, arm, place));
    ArmPlant simbody(arm, effects), own(arm, effects, Engine::halyard);
    for (int state = 0; state < 5; ++state) expect_alike(simbody, own, random);
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
    plant.jacobian(0, y.data(), J);
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

TEST(ArmPlant, SplitsOffTheCablesAndTheFrictionOfAllAxes) {
  ArmParameters<double> arm = raven2().nominal, free = arm;
  for (int k = 0; k < 3; ++k) {
    JointParameters<double>& j = free.joint[k];
    j.stiffness = j.damping = j.joint_coulomb = j.joint_viscous = j.motor_coulomb = j.motor_viscous = 0;
  }
  ArmPlant plant(arm), without(free);
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd y = random_state(plant, random);
    Eigen::VectorXd all(y.size()), rest(y.size()), part(y.size());
    plant.derivative(0, y.data(), all.data());
    without.derivative(0, y.data(), rest.data());
    plant.derivative_of_terms(DriveTerms::cables_and_friction, 0, y.data(), part.data());
    for (int i = 3; i < 6; ++i) EXPECT_NEAR(part(i), all(i) - rest(i), 1e-9 * (1 + std::abs(all(i))));
    for (int k = 0; k < 3; ++k) {
      const int i = 6 + *plant.layout().motor_rate[k];
      EXPECT_NEAR(part(i), all(i) - rest(i), 1e-9 * (1 + std::abs(all(i))));
    }
  }
}

TEST(ArmPlant, SplitsOffTheFirstCable) {
  ArmParameters<double> arm = raven2().nominal, free = arm;
  free.joint[0].stiffness = free.joint[0].damping = 0;
  ArmPlant plant(arm), without(free);
  std::mt19937_64 random(4);
  const Eigen::VectorXd y = random_state(plant, random);
  Eigen::VectorXd all(y.size()), rest(y.size()), part(y.size());
  plant.derivative(0, y.data(), all.data());
  without.derivative(0, y.data(), rest.data());
  plant.derivative_of_terms(DriveTerms::first_cable, 0, y.data(), part.data());
  for (int i = 3; i < y.size() - 2; ++i) {
    const bool angle_of_other_motor = i >= 6 && (i - 6) % 2 == 0;
    if (angle_of_other_motor) continue;
    EXPECT_NEAR(part(i), all(i) - rest(i), 1e-9 * (1 + std::abs(all(i)))) << i;
  }
}

TEST(DriveTrain, SlopesAreTheDerivativesOfItsRates) {
  const ArmParameters<double> arm = raven2().nominal;
  ArmPlant plant(arm, {placed("hysteresis", arm, 1), placed("pulley_friction", arm, 2)});
  const DriveTrain& drive = plant.drive();
  const int n = 3, rows = n + drive.layout().n_z;
  std::mt19937_64 random(5);
  Eigen::VectorXd y = random_state(plant, random);
  y.segment(n, n) *= 1e-2;  // into the reach of the friction's slope
  for (const DriveTerms terms : {DriveTerms::all, DriveTerms::cables_and_friction, DriveTerms::first_cable}) {
    Eigen::MatrixXd slopes;
    drive.slopes(terms, 0, y.data(), y.data() + n, y.data() + 2 * n, slopes);
    for (int c = 0; c < y.size(); ++c) {
      const double step = 1e-7;
      Eigen::VectorXd rates[2];
      for (int side = 0; side < 2; ++side) {
        Eigen::VectorXd at = y;
        at(c) += (side ? step : -step);
        rates[side].resize(rows);
        drive.rates(terms, 0, at.data(), at.data() + n, at.data() + 2 * n, rates[side].data(), rates[side].data() + n);
      }
      const Eigen::VectorXd difference = (rates[1] - rates[0]) / (2 * step);
      // Central differences: rounding eps·|rate| / step ~ 1e-4, curvature of tanh step²·slope / v_s² ~ 1e-9 relative.
      for (int r = 0; r < rows; ++r)
        EXPECT_NEAR(slopes(r, c), difference(r), 1e-3 + 1e-5 * std::abs(slopes(r, c))) << r << ", " << c;
    }
  }
}

TEST(DriveTrain, LosesEnergyInFrictionAndInCableDampingAlone) {
  const ArmParameters<double> arm = raven2().nominal;
  ArmPlant plant(arm);
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd y = random_state(plant, random);
    Eigen::VectorXd y_dot(y.size());
    plant.derivative(0, y.data(), y_dot.data());
    JointSignals<double> s[kMaxJoints];
    plant.drive().signals(0, y.data(), y.data() + 3, y.data() + 6, s);
    double lost = 0, scale = 0;
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = arm.joint[k];
      lost += friction(j.motor_coulomb, j.motor_viscous, j.motor_smoothing, s[k].motor_rate) * s[k].motor_rate;
      lost += friction(j.joint_coulomb, j.joint_viscous, j.joint_smoothing, s[k].joint_rate) * s[k].joint_rate;
      lost += 2 * j.damping * s[k].stretch_rate * s[k].stretch_rate;
      scale += std::abs(s[k].cable_force_joint * j.motor_travel() * s[k].motor_rate) +
               std::abs(s[k].cable_force_joint * j.pulley_radius * s[k].joint_rate);
    }
    // Both sides are sums of powers of this size, with some ten roundings.
    EXPECT_NEAR(y_dot(6 + plant.layout().lost_energy), lost, 1e-14 * scale);
  }
}

TEST(DriveTrain, RefusesACableOnAMotorWithoutInertia) {
  ArmParameters<double> arm = raven2().nominal;
  arm.joint[1].rotor_inertia = 0;
  try {
    ArmPlant plant(arm);
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "joint 2: a motor that drives a cable needs a rotor inertia above 0");
  }
}

TEST(ArmPlant, RefusesAnInertiaThatNoBodyHas) {
  ArmParameters<double> arm = raven2().nominal;
  arm.joint[2].inertia[0] = 1;
  try {
    ArmPlant plant(arm);
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "link 3: no body has this inertia: each of xx, yy, zz must be at most the sum of the others");
  }
}

TEST(RestingState, LeavesTheJointsWithoutAcceleration) {
  const ArmModel model = raven2();
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

TEST(Integration, OfAPendulumReturnsAfterThePeriodOfTheEllipticIntegral) {
  const double length = 0.3, amplitude = 2.0;
  ArmPlant plant(pendulum(0.5, length));
  Eigen::VectorXd y = Eigen::VectorXd::Zero(plant.layout().size());
  y(0) = amplitude;
  const double period = 4 * std::sqrt(length / 9.81) * std::comp_ellint_1(std::sin(amplitude / 2));
  IntegratorOptions options;
  options.relative_tolerance = 1e-8;
  const auto integrator = make_integrator(plant, options, 0, y);
  const double energy = plant.stored_energy(0, y.data());
  integrator->advance(period / 2);
  EXPECT_NEAR(integrator->state()(0), -amplitude, 1e-5);
  integrator->advance(period);
  // Local errors of 1e-8 over some hundred steps; the point's own inertia changes the period by 1e-11.
  EXPECT_NEAR(integrator->state()(0), amplitude, 1e-5);
  EXPECT_NEAR(plant.stored_energy(period, integrator->state().data()), energy, 1e-5);
}

TEST(Integration, OfARigidDriveCarriesTheRotorThroughTheSquareOfTheRatio) {
  ArmParameters<double> arm = pendulum(0.5, 0.3);
  arm.gravity[0] = 0;
  JointParameters<double>& j = arm.joint[0];
  j.drive = Drive::rigid;
  j.rotor_inertia = 2e-5;
  j.gear_ratio = 12;
  j.capstan_radius = 0.006;
  j.pulley_radius = 0.06;
  ArmPlant plant(arm);
  const double torque = 0.01, no_load = 0, ratio = 12 * 0.06 / 0.006, t = 0.5;
  plant.set_inputs(0, &torque, &no_load);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(plant.layout().size());
  const auto integrator = make_integrator(plant, {}, 0, start);
  integrator->advance(t);
  const double inertia = 0.5 * 0.3 * 0.3 + 1e-12 + 2e-5 * ratio * ratio;
  const Eigen::VectorXd& y = integrator->state();
  // A parabola: a third-order method is exact up to rounding and the Newton tolerance.
  EXPECT_NEAR(y(0), 0.5 * ratio * torque / inertia * t * t, 1e-6);
  EXPECT_NEAR(y(2 + plant.layout().input_energy), torque * ratio * y(0), 1e-6);
  EXPECT_NEAR(plant.stored_energy(t, y.data()), torque * ratio * y(0), 1e-6);
}

Scenario sines(double duration) {
  Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/experiment_a.xml");
  s.duration_s = duration;
  return s;
}

TEST(Simulation, ClosesTheEnergyBalance) {
  Scenario scenario = sines(10);
  scenario.integrator.relative_tolerance = 1e-8;
  scenario.integrator.absolute_tolerance = 1e-11;
  const EnergyBalance e = simulate(scenario).energy;
  EXPECT_GT(e.input, 10);  // J; there is something to balance
  EXPECT_GT(e.dissipated, 10);
  EXPECT_NEAR(e.input - e.stored, e.dissipated, 1e-6 * e.input);
}

}  // namespace
}  // namespace halyard
