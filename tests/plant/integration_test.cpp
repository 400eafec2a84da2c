#include <gtest/gtest.h>

#include <cmath>

#include "plant/arm_plant.h"
#include "plant/integrators/integrator.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

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
  // A parabola: methods of the third and fourth order are exact up to rounding and the Newton tolerance.
  EXPECT_NEAR(y(0), 0.5 * ratio * torque / inertia * t * t, 1e-6);
  EXPECT_NEAR(y(2 + plant.layout().input_energy), torque * ratio * y(0), 1e-6);
  EXPECT_NEAR(plant.stored_energy(t, y.data()), torque * ratio * y(0), 1e-6);
}

/// Where the arm of the pendulum is after 0.1 s, with these effects.
Eigen::VectorXd after_a_while(IntegratorKind kind, const std::vector<PlacedEffect>& effects) {
  ArmPlant plant(pendulum(0.5, 0.3), effects);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(plant.layout().size());
  y(0) = 1;
  const auto integrator = make_integrator(plant, {.kind = kind}, 0, y);
  integrator->advance(0.1);
  return integrator->state();
}

TEST(Integration, OfTheAutomaticKindIsDirkIfAnEffectMayLookBackAndRosenbrockIfNot) {
  const PlacedEffect delay = place_effect(*find_effect("delay"), pendulum(0.5, 0.3), kWholeArm);
  EXPECT_EQ(after_a_while(IntegratorKind::automatic, {}), after_a_while(IntegratorKind::rosenbrock, {}));
  EXPECT_EQ(after_a_while(IntegratorKind::automatic, {delay}), after_a_while(IntegratorKind::dirk, {delay}));
  EXPECT_NE(after_a_while(IntegratorKind::dirk, {}), after_a_while(IntegratorKind::rosenbrock, {}));
}

Scenario sines(double duration) {
  Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/experiment_a.xml");
  s.duration_s = duration;
  return s;
}

TEST(Simulation, ClosesTheEnergyBalance) {
  for (const bool creeps : {false, true}) {
    Scenario scenario = sines(10);
    scenario.integrator.relative_tolerance = 1e-8;
    scenario.integrator.absolute_tolerance = 1e-11;
    if (creeps)
      for (const int k : {1, 2})
        scenario.robot.effects.push_back(place_effect(*find_effect("creep"), scenario.robot.nominal, k));
    const EnergyBalance e = simulate(scenario).energy;
    EXPECT_GT(e.input, 10);  // J; there is something to balance
    EXPECT_GT(e.dissipated, 10);
    EXPECT_NEAR(e.input - e.stored, e.dissipated, 1e-6 * e.input) << creeps;
  }
}

}  // namespace
}  // namespace halyard
