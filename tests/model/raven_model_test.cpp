// The numbers of the RAVEN-II model files against the paper and an independent derivation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/small_arm.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

double parameter(ArmModel& model, const std::string& key) {
  for (const ParameterInfo& info : named_parameters(model.nominal)) {
    if (info.key == key) return info.number.get();
  }
  ADD_FAILURE() << "no parameter " << key;
  return std::nan("");
}

TEST(ModelFile, EveryNumberOfTheRavenArrives) {
  ArmModel model = read_model(kExamples / "raven2.xml");
  ASSERT_EQ(model.n(), 3);
  EXPECT_EQ(model.source, (kExamples / "raven2.xml").string());
  EXPECT_EQ(model.joints[2].name, "insertion");
  EXPECT_EQ(model.nominal.gravity[0], -9.81);
  EXPECT_EQ(model.nominal.payload_point[2], -0.48);
  const std::vector<std::pair<std::string, std::array<double, 3>>> table = {
      {"link.mass", {0.503, 0.753, 0.407}},
      {"motor.inertia", {2.324e-5, 2.324e-5, 2.324e-5}},
      {"motor.coulomb", {6.62e-3, 3.36e-3, 4.17e-3}},
      {"motor.viscous", {1.55e-5, 1.47e-5, 5.80e-5}},
      {"motor.gear_ratio", {12.25, 12.25, 12.25}},
      {"motor.capstan_radius", {5.675e-3, 5.675e-3, 5.675e-3}},
      {"motor.torque_scale", {1, 1, 1}},
      {"motor.torque_bias", {0, 0, 0}},
      {"cable.stiffness", {720e3, 88e3, 9.25e3}},
      {"cable.damping", {4000, 1380, 400}},
      {"cable.tension", {51.0, 43.1, 41.2}},
      {"cable.pulley_radius", {63.095e-3, 56.298e-3, 1}},
      {"friction.coulomb", {0.505, 0.49, 0.53}},
      {"friction.viscous", {0.00505, 0.0049, 0.0053}},
  };
  for (const auto& [key, values] : table) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(parameter(model, "joint" + std::to_string(k + 1) + "." + key), values[k]) << key << " " << k + 1;
    }
  }
  const std::array lower = {0.0, 45 * kDegree, 0.23}, upper = {90 * kDegree, 135 * kDegree, 0.56};
  const std::array home = {45 * kDegree, 90 * kDegree, 0.40}, smoothing = {5e-3, 5e-3, 5e-4};
  const std::array resolution = {2 * std::numbers::pi / 80000, 2 * std::numbers::pi / 80000, 5e-6};
  const std::array kp = {0.02449, 0.02449, 0.01224}, kd = {6.53e-4, 6.53e-4, 9.80e-4}, limit = {0.110, 0.110, 0.088};
  for (int k = 0; k < 3; ++k) {
    const JointParameters<double>& joint = model.nominal.joint[k];
    EXPECT_EQ(joint.type, k < 2 ? JointType::revolute : JointType::prismatic);
    EXPECT_EQ(joint.drive, Drive::cable);
    EXPECT_EQ(joint.law, CableLaw::paper);
    EXPECT_EQ(joint.motor_smoothing, 0.5);
    EXPECT_EQ(joint.joint_smoothing, smoothing[k]);
    EXPECT_EQ(joint.motor_encoder_resolution, 2 * std::numbers::pi / 4000);
    EXPECT_EQ(joint.joint_encoder_resolution, resolution[k]);
    const JointDescription& description = model.joints[k];
    // Degrees are converted with one multiplication: one rounding.
    EXPECT_DOUBLE_EQ(description.lower, lower[k]);
    EXPECT_DOUBLE_EQ(description.upper, upper[k]);
    EXPECT_DOUBLE_EQ(model.home()(k), home[k]);
    EXPECT_EQ(description.controller.kp, kp[k]);
    EXPECT_EQ(description.controller.kd, kd[k]);
    EXPECT_EQ(description.controller.torque_limit, limit[k]);
  }
}

TEST(ModelFile, RavenPathMatrixIsEquation8) {
  for (const char* file : {"raven2.xml", "raven2_paper.xml"}) {
    const Eigen::MatrixXd R = path_matrix(read_model(kExamples / file).nominal);
    Eigen::Matrix3d expected;
    expected << 63.095e-3, 0, 0,            //
        0.14545 * 56.298e-3, 56.298e-3, 0,  //
        0.007797, 0.008077, 1;
    EXPECT_EQ(R, expected) << file;
  }
}

TEST(ModelFile, PaperLiteralModelDiffersInMotorRowsAndControllerOnly) {
  ArmModel paper = read_model(kExamples / "raven2_paper.xml"), consistent = read_model(kExamples / "raven2.xml");
  const double N = 12.25;
  const std::array coulomb = {8.11e-2, 4.11e-2, 5.11e-2}, viscous = {1.9e-4, 1.8e-4, 7.1e-4};
  for (int k = 0; k < 3; ++k) {
    const std::string joint = "joint" + std::to_string(k + 1);
    EXPECT_EQ(parameter(paper, joint + ".motor.inertia"), 2.847e-4);
    EXPECT_EQ(parameter(paper, joint + ".motor.coulomb"), coulomb[k]);
    EXPECT_EQ(parameter(paper, joint + ".motor.viscous"), viscous[k]);
    for (const char* name : {".motor.inertia", ".motor.coulomb", ".motor.viscous"}) {
      const double printed = parameter(paper, joint + name);
      // The consistent numbers are rounded to 3 or 4 digits: at most 0.5 in 145.
      EXPECT_NEAR(parameter(consistent, joint + name) * N, printed, 3.5e-3 * printed) << name;
    }
    const ControllerParameters &at_gearbox = paper.joints[k].controller, &at_shaft = consistent.joints[k].controller;
    EXPECT_DOUBLE_EQ(at_gearbox.kp, N * at_shaft.kp);
    EXPECT_DOUBLE_EQ(at_gearbox.kd, N * at_shaft.kd);
    EXPECT_DOUBLE_EQ(at_gearbox.torque_limit, N * at_shaft.torque_limit);

    JointParameters<double>& to = paper.nominal.joint[k];
    const JointParameters<double>& from = consistent.nominal.joint[k];
    to.rotor_inertia = from.rotor_inertia, to.motor_coulomb = from.motor_coulomb, to.motor_viscous = from.motor_viscous;
    paper.joints[k].controller = consistent.joints[k].controller;
  }
  paper.name = consistent.name;
  EXPECT_EQ(model_to_xml(paper), model_to_xml(consistent));
}

}  // namespace
}  // namespace halyard
