/// Where joints come to rest when the motors are held.

#include "estimators/process/static_equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/process/standstill.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "tests/support/pendulum.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

TEST(StaticEquilibrium, CablesCarryGravityAndTheLoad) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const ArmParameters<double>& arm = process.arm();
  const Eigen::Vector3d home = model.home(), load(0.3, -0.2, 1);
  const Eigen::VectorXd q_m = unstretched_motors(arm, home);
  const Eigen::VectorXd q = static_equilibrium(process, 0, q_m, load, Eigen::VectorXd(), home);
  // Γ of the cables' pull against gravity and load.
  double path[3], g[3], reaction[3];
  cable_path(arm, q.data(), path);
  for (int k = 0; k < 3; ++k) g[k] = cable_force(arm.joint[k], arm.joint[k].motor_travel() * q_m(k) - path[k], 0.0);
  joint_reaction(arm, g, reaction);
  const Eigen::VectorXd gravity = gravity_force(arm, q);
  // Converged to 1e-12 in position, at a stiffness of 18500 N/m or 5700 N m/rad.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(reaction[k] + load(k), gravity(k), 2e-8);
  EXPECT_GT((q - home).norm(), 1e-4);  // it does sag
}

TEST(StaticEquilibrium, GravityTakesABacklashToOneSide) {
  ArmModel model = raven2();
  add_effect(model, "backlash", 1, {3.5e-4});
  const ProcessModel process(model);
  const ArmParameters<double>& arm = process.arm();
  const Eigen::VectorXd home = model.home(), none = Eigen::VectorXd::Zero(3);
  const Eigen::VectorXd q_m = unstretched_motors(arm, home);
  const Eigen::VectorXd q = static_equilibrium(process, 0, q_m, none, Eigen::VectorXd(), home);
  double path[3];
  cable_path(arm, q.data(), path);
  const double stretch = arm.joint[1].motor_travel() * q_m(1) - path[1];
  const double force = 2 * arm.joint[1].stiffness * (std::abs(stretch) - 3.5e-4) * (stretch > 0 ? 1 : -1);
  // Cable 3 pulls on joint 2 as well: by 0.008 m of 3.7 N.
  const double pull_of_3 = arm.joint[2].coupling[1] * gravity_force(arm, q)(2);
  // The paper's law is a straight line to 1e-6 of its force.
  EXPECT_NEAR(arm.joint[1].pulley_radius * force + pull_of_3, gravity_force(arm, q)(1), 1e-6);
}

TEST(StaticEquilibrium, AJointWithoutMotorStaysWhereTheSearchBegins) {
  const ProcessModel process(pendulum());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  // Gravity pulls it to π.
  const Eigen::VectorXd q = static_equilibrium(process, 0, none, none, Eigen::VectorXd(), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(q(0), 1);
}

TEST(StaticEquilibrium, CablesOfTheOtherJointsCarryGravityWhereverTheMotorIsMissing) {
  for (int undriven = 0; undriven < 3; ++undriven) {
    ArmModel model = raven2();
    model.nominal.joint[undriven].drive = Drive::none;
    const ProcessModel process(model);
    const ArmParameters<double>& arm = process.arm();
    const Eigen::Vector3d home = model.home(), load(0.3, -0.2, 1);
    const Eigen::VectorXd q_m = unstretched_motors(arm, home);
    const Eigen::VectorXd q = static_equilibrium(process, 0, q_m, load, Eigen::VectorXd(), home);
    EXPECT_NEAR(q(undriven), home(undriven), 4 * kEps) << undriven;  // the roundings of a solution and of a sum
    double path[3], g[3] = {}, reaction[3];
    cable_path(arm, q.data(), path);
    for (int k = 0; k < 3; ++k)
      if (k != undriven) g[k] = cable_force(arm.joint[k], arm.joint[k].motor_travel() * q_m(k) - path[k], 0.0);
    joint_reaction(arm, g, reaction);
    const Eigen::VectorXd gravity = gravity_force(arm, q);
    for (int k = 0; k < 3; ++k) {
      if (k == undriven) EXPECT_GT(std::abs(reaction[k] + load(k) - gravity(k)), 0.01) << "nothing would hold it";
      else EXPECT_NEAR(reaction[k] + load(k), gravity(k), 2e-8) << undriven << ", " << k;  // as above
    }
  }
}

TEST(StaticEquilibrium, ARigidJointStandsWhereItsMotorSays) {
  ArmModel model = raven2();
  model.nominal.joint[1].drive = Drive::rigid;
  const ProcessModel process(model);
  const Eigen::VectorXd home = model.home(), none = Eigen::VectorXd::Zero(3);
  const Eigen::VectorXd q_m = unstretched_motors(process.arm(), home);
  const Eigen::VectorXd q = static_equilibrium(process, 0, q_m, none, Eigen::VectorXd(), home);
  const Eigen::VectorXd travel = path_matrix(process.arm()) * q;
  EXPECT_NEAR(travel(1), process.arm().joint[1].motor_travel() * q_m(1), 1e-12);
  EXPECT_NE(q(0), home(0));
  // The free joints are at rest: what accelerates them, with the motor of joint 2 held, is nothing.
  const Eigen::VectorXd x = process.state_at_rest(q_m, q);
  double path[3], g[3] = {};
  cable_path(process.arm(), q.data(), path);
  for (const int k : {0, 2})
    g[k] = cable_force(process.arm().joint[k], process.arm().joint[k].motor_travel() * q_m(k) - path[k], 0.0);
  const Eigen::VectorXd gravity = gravity_force(process.arm(), q);
  const JointParameters<double>&j1 = process.arm().joint[0], &j2 = process.arm().joint[1], &j3 = process.arm().joint[2];
  const double g2 = (gravity(1) - j3.coupling[1] * g[2]) / j2.pulley_radius;  // what holds joint 2
  const double on_joint_1 = j1.pulley_radius * g[0] + j2.pulley_radius * j2.coupling[0] * g2 + j3.coupling[0] * g[2];
  EXPECT_NEAR(on_joint_1, gravity(0), 2e-8);  // as above
  EXPECT_NEAR(g[2], gravity(2), 2e-8);
}

TEST(StaticEquilibrium, NoneOfASlideThatFallsIsToldWithTheJointAndItsForce) {
  // A rigid lift along gravity that carries a slide on a cable without stiffness, 60° from it.
  ArmModel model = pendulum();
  model.nominal.n = 2;
  model.joints.resize(2, model.joints[0]);
  for (int k = 0; k < 2; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j.type = JointType::prismatic;
    j.drive = k == 0 ? Drive::rigid : Drive::cable;
    j.mass = k == 0 ? 5 : 2;
    j.coupling[k] = 1;
  }
  model.nominal.joint[1].rotor_inertia = 1;
  double(&R)[3][3] = model.nominal.joint[1].frame_R;
  R[1][1] = R[2][2] = 0.5, R[2][1] = std::sqrt(0.75), R[1][2] = -R[2][1];
  model.nominal.gravity[0] = 0;
  model.nominal.gravity[2] = -10;
  const ProcessModel process(model);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(2);
  try {
    static_equilibrium(process, 2.5, none, none, Eigen::VectorXd(), none);
    FAIL() << "found one";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "static equilibrium: none found for the motor angles at 2.5 s: joint 2 is left with a force of -10; "
                 "check its cable's stiffness and the motor encoder's offset");
  }
}

}  // namespace
}  // namespace halyard
