#include "plant/drive_train.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/plant_states.h"

namespace halyard {
namespace {

TEST(ArmPlant, SplitsOffTheCablesAndTheFrictionOfAllAxes) {
  ArmParameters<double> arm = nominal_raven2().nominal, free = arm;
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
  ArmParameters<double> arm = nominal_raven2().nominal, free = arm;
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
  const ArmParameters<double> arm = nominal_raven2().nominal;
  // Creep after an eccentric capstan and before a backlash: the account of energy has second derivatives of both.
  const std::vector<PlacedEffect> in_force = {placed("hysteresis", arm, 1), placed("pulley_friction", arm, 2)},
                                  in_stretch = {placed("capstan_eccentricity", arm, 2), placed("creep", arm, 2),
                                                placed("backlash", arm, 2), placed("creep", arm, 0)};
  for (const std::vector<PlacedEffect>& effects : {in_force, in_stretch}) {
    ArmPlant plant(arm, effects);
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
          drive.rates(terms, 0, at.data(), at.data() + n, at.data() + 2 * n, rates[side].data(),
                      rates[side].data() + n);
        }
        const Eigen::VectorXd difference = (rates[1] - rates[0]) / (2 * step);
        // Central differences: rounding eps·|rate| / step ~ 1e-4, curvature of tanh step²·slope / v_s² ~ 1e-9 relative.
        for (int r = 0; r < rows; ++r)
          EXPECT_NEAR(slopes(r, c), difference(r), 1e-3 + 1e-5 * std::abs(slopes(r, c))) << r << ", " << c;
      }
    }
  }
}

TEST(DriveTrain, OfPlainArmsIsThatOfArmsWithAnEffectThatDoesNothing) {
  ArmParameters<double> arm = nominal_raven2().nominal;
  std::mt19937_64 random(7);
  for (const CableLaw law : {CableLaw::paper, CableLaw::exponential, CableLaw::linear}) {
    for (int k = 0; k < 3; ++k) arm.joint[k].law = law;
    ArmPlant plain(arm), other(arm, {place_neutral_effect(*find_effect("joint_friction"), arm, 1)});
    const double command[] = {0.02, -0.03, 0.01}, load[] = {0.1, 0, -0.2};
    plain.set_inputs(0, command, load);
    other.set_inputs(0, command, load);
    for (int trial = 0; trial < 5; ++trial) {
      const Eigen::VectorXd y = random_state(plain, random);
      Eigen::VectorXd rates[2];
      Eigen::MatrixXd slopes[2];
      for (int i = 0; i < 2; ++i) {
        const DriveTrain& drive = (i == 0 ? plain : other).drive();
        rates[i].resize(3 + drive.layout().n_z);
        drive.rates(DriveTerms::all, 0, y.data(), y.data() + 3, y.data() + 6, rates[i].data(), rates[i].data() + 3);
        drive.slopes(DriveTerms::all, 0, y.data(), y.data() + 3, y.data() + 6, slopes[i]);
      }
      // Some ten roundings of powers and forces up to 1e4 and of slopes up to 1e10. Exponential cables multiply those
      // of the stretch, eps · 0.1 m, by k_e / T_0 = 1.4e4 / m.
      const double rounding = law == CableLaw::exponential ? 1e-12 : 1e-14;
      EXPECT_LT((rates[0] - rates[1]).cwiseAbs().maxCoeff(), rounding * (1e4 + rates[1].cwiseAbs().maxCoeff()));
      EXPECT_LT((slopes[0] - slopes[1]).cwiseAbs().maxCoeff(), rounding * slopes[1].cwiseAbs().maxCoeff());
    }
  }
}

TEST(DriveTrain, LosesEnergyInFrictionAndInCableDampingAlone) {
  const ArmParameters<double> arm = nominal_raven2().nominal;
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
  ArmParameters<double> arm = nominal_raven2().nominal;
  arm.joint[1].rotor_inertia = 0;
  try {
    ArmPlant plant(arm);
    FAIL() << "took it";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "joint 2: a motor that drives a cable needs a rotor inertia above 0");
  }
}

/// Forces, rates and accelerations at y, and their slopes.
struct Linearised {
  Eigen::VectorXd rates;
  Eigen::MatrixXd slopes;
};

Linearised linearised(const PlantKernels& kernels, const DriveTrain& drive, const Eigen::VectorXd& y) {
  const int n = drive.layout().n, rows = n + drive.layout().n_z, columns = drive.layout().size() - 2;
  Linearised at{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, columns)};
  const double *q = y.data(), *v = q + n, *z = v + n;
  kernels.slopes(drive.model(), DriveTerms::all, {0, q, v, z}, at.rates.data(), at.rates.data() + n, at.slopes.data(),
                 rows);
  Eigen::VectorXd alone(rows);
  kernels.rates(drive.model(), DriveTerms::all, {0, q, v, z}, alone.data(), alone.data() + n);
  kernels.accelerate(drive.arm(), q, v, alone.data());
  kernels.accelerate_with_slopes(drive.arm(), q, v, at.rates.data(), at.slopes.data(), rows, columns);
  EXPECT_LT((alone - at.rates).cwiseAbs().maxCoeff(), 1e-12 * at.rates.cwiseAbs().maxCoeff());
  return at;
}

TEST(PlantKernels, OfAllInstructionSetsAgree) {
  const ArmParameters<double> arm = nominal_raven2().nominal;
  const ArmPlant plain(arm), general(arm, {placed("hysteresis", arm, 1)});
  std::mt19937_64 random(9);
  for (const ArmPlant* plant : {&plain, &general}) {
    const Eigen::VectorXd y = random_state(*plant, random);
    const Linearised generic = linearised(plant_kernels().back(), plant->drive(), y);
    for (const PlantKernels& kernels : plant_kernels()) {
      const Linearised other = linearised(kernels, plant->drive(), y);
      // Some hundred roundings of the largest entries; M has a condition of about 100.
      EXPECT_LT((other.rates - generic.rates).cwiseAbs().maxCoeff(), 1e-12 * generic.rates.cwiseAbs().maxCoeff());
      EXPECT_LT((other.slopes - generic.slopes).cwiseAbs().maxCoeff(), 1e-12 * generic.slopes.cwiseAbs().maxCoeff());
    }
  }
}

}  // namespace
}  // namespace halyard
