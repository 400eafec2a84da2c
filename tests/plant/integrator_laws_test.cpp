/// Laws of mechanics that each integrator keeps.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/plant/smooth_arm.h"

namespace halyard {
namespace {

/// Without friction and motors, under gravity along the axis of its first joint, which is vertical.
ArmParameters<double> swinging_arm() {
  ArmParameters<double> arm = halyard::random_arm(5, CableLaw::paper);
  arm.gravity[0] = 0, arm.gravity[2] = -9.81;
  for (JointParameters<double>& j : arm.joint) j.drive = Drive::none, j.joint_coulomb = j.joint_viscous = 0;
  // The second axis is horizontal and 0.4 m from the first.
  double(&R)[3][3] = arm.joint[1].frame_R;
  R[1][1] = R[2][2] = 0, R[1][2] = -1, R[2][1] = 1;
  arm.joint[1].frame_p[0] = 0.4;
  arm.joint[2].frame_p[1] = 0.3;
  return arm;
}

/// About the first axis: ∂T/∂q_1'. No energy depends on q_1.
double angular_momentum(ArmPlant& plant, const Eigen::VectorXd& y) {
  return plant.mass_matrix(y.head(3)).row(0).dot(y.segment(3, 3));
}

TEST(Momentum, AboutAVerticalAxisIsKeptByEachIntegrator) {
  for (const auto& [kind, name] : integrator_names()) {
    ArmPlant plant(swinging_arm());
    Eigen::VectorXd start = Eigen::VectorXd::Zero(plant.layout().size());
    start.head(6) << 0.3, 0.5, 0.4, 1.2, -0.8, 0.5;
    const auto integrator = make_integrator(plant, {kind, 1e-8, 1e-10}, 0, start);
    const double momentum = angular_momentum(plant, start), energy = plant.stored_energy(0, start.data());
    double of_momentum = 0, of_energy = 0;
    for (int tick = 1; tick <= 20; ++tick) {
      integrator->advance(0.1 * tick);
      const Eigen::VectorXd& y = integrator->state();
      of_momentum = std::max(of_momentum, std::abs(angular_momentum(plant, y) / momentum - 1));
      of_energy = std::max(of_energy, std::abs(plant.stored_energy(0.1 * tick, y.data()) / energy - 1));
    }
    EXPECT_GT(std::abs(integrator->state()(1) - start(1)), 0.1) << name << ": it hardly moves";
    std::printf("%s: momentum %.1e, energy %.1e\n", name.c_str(), of_momentum, of_energy);
    // Empirical: cpodes has 5e-7 and 4e-6, dirk 1e-7 and 2e-6, the others less.
    EXPECT_LT(of_momentum, 2e-6) << name;
    EXPECT_LT(of_energy, 1e-5) << name;
  }
}

TEST(EnergyBalance, IsClosedByEachIntegrator) {
  for (const auto& [kind, name] : integrator_names()) {
    SmoothMotion motion;
    const PlantLayout& l = motion.plant.layout();
    const auto integrator = make_integrator(motion.plant, {kind, 1e-8, 1e-10}, 0, motion.start);
    for (int tick = 1; tick <= 10; ++tick) integrator->advance(0.1 * tick);
    const Eigen::VectorXd& y = integrator->state();
    const double stored = motion.plant.stored_energy(1, y.data()) - motion.plant.stored_energy(0, motion.start.data());
    const double in = y(2 * l.n + l.input_energy), lost = y(2 * l.n + l.lost_energy);
    EXPECT_GT(lost, 1) << name;  // J
    std::printf("%s: in %.3f lost %.3f stored %.3f, gap %.1e\n", name.c_str(), in, lost, stored, in - lost - stored);
    // Empirical: imex has 4e-7 of what is lost, the others less.
    EXPECT_NEAR(in - lost, stored, 2e-6 * lost) << name;
  }
}

}  // namespace
}  // namespace halyard
