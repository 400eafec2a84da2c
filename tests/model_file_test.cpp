#include "model/model_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "estimators/rigid_chain.h"
#include "model/input_error.h"
#include "model/xml_reader.h"
#include "transmission/path_matrix.h"

namespace halyard {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::filesystem::path kExamples = std::filesystem::path(HALYARD_SOURCE_DIR) / "examples" / "raven2";

/// A small arm that uses every element of the schema; the tests break one line of it at a time.
const std::string kArm = R"(<arm name="small">
<gravity>0 0 -9.81</gravity>
<payload point="0 0 300 mm"/>
<tolerances length="0.02" coupling="0.03" torque_scale="0.01"/>
<joint name="swing" type="revolute" drive="cable">
<dh alpha="90 deg" a="0.2" theta="0.3" d="100 mm"/>
<link mass="0.5" com="0.1 0 0" inertia="1e-3 2e-3 2.5e-3 1e-4 0 0"/>
<motor inertia="2e-5" coulomb="5e-3" viscous="1e-5" smoothing="0.4" gear_ratio="12" capstan_radius="5.5 mm"/>
<cable law="exponential" stiffness="720e3" damping="4000" tension="51" pulley_radius="0.063"/>
<friction coulomb="0.5" viscous="0.005" smoothing="0.01"/>
<encoders motor_counts="4000" joint_resolution="0.01 deg" motor_offset="0.1" joint_offset="-1 deg"/>
<controller kp="0.02" kd="6e-4" torque_limit="0.11"/>
<range lower="-90 deg" upper="90 deg" home="10 deg"/>
<tolerances stiffness="0.3"/>
</joint>
<joint name="slide" type="prismatic" drive="rigid">
<frame xyz="0 0 0.1" rpy="10 20 30 deg"/>
<link mass="0.4" com="0 0 0" inertia="0 0 0 0 0 0"/>
<motor inertia="0" coulomb="0" viscous="0" gear_ratio="1" capstan_radius="1" torque_scale="1.1" torque_bias="-3"/>
<rigid pulley_radius="1"/>
<coupling joint="1" coefficient="0.0078"/>
<friction coulomb="20" viscous="200"/>
<range lower="0" upper="0.5" home="0.25"/>
</joint>
<joint name="wrist" type="revolute" drive="none">
<frame xyz="0 0 0" rpy="0 0 0"/>
<link mass="0.1" com="0.05 0 0" inertia="1e-4 1e-4 1e-4 0 0 0"/>
<friction coulomb="0" viscous="0.01"/>
<range lower="-1" upper="1" home="0"/>
</joint>
<effects>
<effect name="backlash" joint="1" half_gap="0.35 mm"/>
<effect name="payload"/>
</effects>
<columns>
<column name="motor_position_1" from="spindle &lt;deg&gt;" unit="deg" sign="-1" scale="2" offset="0.5"/>
</columns>
<estimator name="sr_ukf" alpha="1e-3" notes="as in the paper"/>
</arm>
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kArm;
  const auto at = text.find(from);
  if (at == text.npos || text.find(from, at + 1) != text.npos) {
    ADD_FAILURE() << "the test's own text does not have exactly once: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

std::string message_for(const std::string& xml) {
  return message_of([&] { parse_model(xml, "arm.xml"); });
}

double parameter(ArmModel& model, const std::string& key) {
  for (const ParameterInfo& info : named_parameters(model.nominal)) {
    if (info.key == key) return *info.value;
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

TEST(ModelFile, RavenChainGivesTheIndependentDerivation) {
  const ArmParameters<double> arm = read_model(kExamples / "raven2.xml").nominal;
  const double q[3] = {30 * kDegree, 90 * kDegree, 0.40}, rest[3] = {}, v[3] = {0.5, -0.4, 0.1};
  const ChainPose<double> pose = chain_pose(arm, q);
  double M[kMaxJoints][kMaxJoints], holding[3], moving[3];
  mass_matrix(arm, pose, M);
  inverse_dynamics(arm, pose, rest, rest, holding);
  inverse_dynamics(arm, pose, v, rest, moving);
  // Half a unit of the last digit that the check values are given with.
  EXPECT_NEAR(M[0][0], 0.148012, 5e-7);
  EXPECT_NEAR(M[0][1], 0.021593, 5e-7);
  EXPECT_NEAR(M[0][2], -0.007846, 5e-7);
  EXPECT_NEAR(M[1][1], 0.080530, 5e-7);
  EXPECT_NEAR(M[1][2], 0.0000641, 5e-8);
  EXPECT_NEAR(M[2][2], 0.407, 1e-15);
  EXPECT_NEAR(holding[0], -0.402541, 5e-7);
  EXPECT_NEAR(holding[1], -0.545831, 5e-7);
  EXPECT_NEAR(holding[2], 3.7496, 5e-5);
  EXPECT_NEAR(moving[0] - holding[0], 0.00926842, 5e-9);
  EXPECT_NEAR(moving[1] - holding[1], -0.00143779, 5e-9);
  EXPECT_NEAR(moving[2] - holding[2], -0.0441737, 5e-8);
}

TEST(ModelFile, RavenPathMatrixIsEquation8) {
  for (const char* file : {"raven2.xml", "raven2_paper.xml"}) {
    const Eigen::MatrixXd R = path_matrix(read_model(kExamples / file).nominal);
    Eigen::Matrix3d expected;
    expected << 63.095e-3, 0, 0,                            //
        0.14545 * 56.298e-3, 56.298e-3, 0,                  //
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

TEST(ModelFile, ReadsEveryElement) {
  ArmModel model = parse_model(kArm, "arm.xml");
  ASSERT_EQ(model.n(), 3);
  const JointParameters<double> &swing = model.nominal.joint[0], &slide = model.nominal.joint[1];
  EXPECT_EQ(model.nominal.gravity[2], -9.81);
  EXPECT_DOUBLE_EQ(model.nominal.payload_point[2], 0.3);
  EXPECT_EQ(swing.law, CableLaw::exponential);
  EXPECT_DOUBLE_EQ(swing.capstan_radius, 5.5e-3);
  EXPECT_DOUBLE_EQ(swing.joint_encoder_offset, -kDegree);
  EXPECT_EQ(swing.motor_encoder_offset, 0.1);
  EXPECT_EQ(swing.tolerance.length, 0.02);
  EXPECT_EQ(swing.tolerance.torque_scale, 0.01);
  EXPECT_EQ(swing.tolerance.stiffness, 0.3);
  EXPECT_EQ(slide.tolerance.stiffness, Tolerances().stiffness);
  EXPECT_EQ(slide.tolerance.coupling, 0.03);
  EXPECT_EQ(slide.drive, Drive::rigid);
  EXPECT_EQ(slide.torque_scale, 1.1);
  EXPECT_EQ(slide.torque_bias, -3);
  EXPECT_EQ(slide.coupling[0], 0.0078);
  EXPECT_EQ(slide.coupling[1], 1);
  EXPECT_EQ(slide.coupling[2], 0);
  EXPECT_EQ(model.nominal.joint[2].drive, Drive::none);
  EXPECT_EQ(model.joints[1].controller.kp, 0);

  ASSERT_EQ(model.effects.size(), 2u);
  EXPECT_EQ(model.effects[0].effect->name(), "backlash");
  EXPECT_EQ(model.effects[0].joint, 0);
  EXPECT_DOUBLE_EQ(model.effects[0].p[0], 3.5e-4);
  EXPECT_EQ(model.effects[1].joint, -1);
  EXPECT_EQ(model.effects[1].p[0], model.effects[1].effect->parameters(model.nominal, -1)[0].typical);
  const ColumnSource& source = model.columns.sources().at("motor_position_1");
  EXPECT_EQ(source.column, "spindle <deg>");
  EXPECT_DOUBLE_EQ(source.scale, -2 * kDegree);
  EXPECT_EQ(source.offset, 0.5);
  EXPECT_EQ(model.estimators.at("sr_ukf"), (EstimatorOptions{{"alpha", "1e-3"}, {"notes", "as in the paper"}}));
}

TEST(ModelFile, EffectWithOneOfItsSizesGivenHasNoOther) {
  const auto effect = [](const std::string& attributes) {
    const ArmModel model = parse_model(
        replaced("<effect name=\"payload\"/>", "<effect name=\"external_force\" joint=\"2\" " + attributes + "/>"), "arm.xml");
    return std::pair(model.effects[1], model.effects[1].effect->parameters(model.nominal, 1));
  };
  const auto [typical, p] = effect("");
  const auto [forced, same] = effect("force=\"7\" start=\"1\"");
  ASSERT_EQ(p[0].name, "force");
  EXPECT_EQ(forced.p[0], 7);
  EXPECT_EQ(forced.p[1], 1);
  EXPECT_EQ(forced.p[2], p[2].typical) << "a shape";
  ASSERT_EQ(p[3].name, "contact_stiffness");
  EXPECT_NE(typical.p[3], 0);
  EXPECT_EQ(forced.p[3], 0);
  // A shape alone shapes typical sizes.
  EXPECT_EQ(effect("start=\"1\"").first.p[0], p[0].typical);
}

TEST(ModelFile, UnknownZeroOfAnEncoderLastsThroughWritingAndReading) {
  const ArmModel model = parse_model(replaced("motor_offset=\"0.1\"", "motor_offset=\"unknown\""), "arm.xml");
  EXPECT_FALSE(model.nominal.joint[0].motor_zero_known);
  EXPECT_TRUE(model.nominal.joint[0].joint_zero_known);
  EXPECT_EQ(model.nominal.joint[0].motor_encoder_offset, 0);
  EXPECT_FALSE(parse_model(model_to_xml(model), "again.xml").nominal.joint[0].motor_zero_known);
  EXPECT_FALSE(find_effect("encoder_offset")->applies(model.nominal, 0)) << "means nothing there";
}

TEST(ModelFile, DhRowIsCraigsConvention) {
  const JointParameters<double> joint = parse_model(kArm, "arm.xml").nominal.joint[0];
  // Rx(90 deg) Tx(0.2) Rz(0.3) Tz(0.1), by hand: x stays in the plane of x and z, z points along -y.
  const double c = std::cos(0.3), s = std::sin(0.3);
  const double R[3][3] = {{c, -s, 0}, {0, 0, -1}, {s, c, 0}}, p[3] = {0.2, -0.1, 0};
  for (int i = 0; i < 3; ++i) {
    // cos(90 deg) is 6e-17 in doubles; the products add a rounding.
    EXPECT_NEAR(joint.frame_p[i], p[i], 3e-16);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(joint.frame_R[i][j], R[i][j], 3e-16);
  }
}

TEST(ModelFile, RollPitchYawTurnAboutFixedAxes) {
  const ArmModel model = parse_model(replaced("10 20 30 deg", "90 0 90 deg"), "arm.xml");
  const JointParameters<double>& joint = model.nominal.joint[1];
  // Rz(90) Rx(90): x to y, y to z, z to x.
  const double R[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(joint.frame_R[i][j], R[i][j], 3e-16);
  }
}

/// All numbers of a joint; padding does not count.
std::vector<double> numbers_of(const JointParameters<double>& j) {
  std::vector<double> all(&j.frame_R[0][0], &j.frame_R[0][0] + 9);
  for (const double x : j.frame_p) all.push_back(x);
  for (const double x : j.com) all.push_back(x);
  for (const double x : j.inertia) all.push_back(x);
  for (const double x : j.coupling) all.push_back(x);
  const Tolerances& t = j.tolerance;
  for (const double x :
       {j.mass, j.rotor_inertia, j.motor_coulomb, j.motor_viscous, j.motor_smoothing, j.gear_ratio, j.capstan_radius,
        j.torque_scale, j.torque_bias, j.pulley_radius, j.stiffness, j.damping, j.tension, j.joint_coulomb,
        j.joint_viscous, j.joint_smoothing, j.motor_encoder_offset, j.joint_encoder_offset, j.motor_encoder_resolution,
        j.joint_encoder_resolution, t.length, t.mass, t.stiffness, t.friction, t.coupling, t.torque_scale,
        double(j.motor_zero_known), double(j.joint_zero_known)}) {
    all.push_back(x);
  }
  all.push_back(static_cast<double>(j.type));
  all.push_back(static_cast<double>(j.drive));
  all.push_back(static_cast<double>(j.law));
  return all;
}

std::vector<double> numbers_of(const JointDescription& d) {
  return {d.lower, d.upper, d.home, d.controller.kp, d.controller.kd, d.controller.torque_limit};
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << a[i] << " " << b[i];
  }
}

TEST(ModelFile, WrittenModelReadsBackToTheLastBit) {
  std::vector<ArmModel> models = {parse_model(kArm, "arm.xml"), read_model(kExamples / "raven2.xml")};
  models[1].nominal.joint[0].stiffness = 1.0 / 3;
  models[1].nominal.joint[1].motor_coulomb = 5e-324;
  models[1].joints[0].name = "a \"quoted\" <name> & more";
  for (const ArmModel& model : models) {
    const ArmModel again = parse_model(model_to_xml(model), "again.xml");
    ASSERT_EQ(again.n(), model.n());
    EXPECT_EQ(again.name, model.name);
    const ArmParameters<double> &a = again.nominal, &b = model.nominal;
    expect_same_bits({a.gravity, a.gravity + 3}, {b.gravity, b.gravity + 3});
    expect_same_bits({a.payload_point, a.payload_point + 3}, {b.payload_point, b.payload_point + 3});
    for (int k = 0; k < model.n(); ++k) {
      expect_same_bits(numbers_of(a.joint[k]), numbers_of(b.joint[k]));
      EXPECT_EQ(again.joints[k].name, model.joints[k].name);
      expect_same_bits(numbers_of(again.joints[k]), numbers_of(model.joints[k]));
    }
    ASSERT_EQ(again.effects.size(), model.effects.size());
    for (std::size_t i = 0; i < model.effects.size(); ++i) {
      EXPECT_EQ(again.effects[i].effect, model.effects[i].effect);
      EXPECT_EQ(again.effects[i].joint, model.effects[i].joint);
      EXPECT_TRUE(std::ranges::equal(again.effects[i].p, model.effects[i].p));
    }
    ASSERT_EQ(again.columns.sources().size(), model.columns.sources().size());
    for (const auto& [name, source] : model.columns.sources()) {
      const ColumnSource& other = again.columns.sources().at(name);
      EXPECT_EQ(other.column, source.column);
      expect_same_bits({other.scale, other.offset}, {source.scale, source.offset});
    }
    EXPECT_EQ(again.estimators, model.estimators);
  }
}

TEST(ModelFile, BadInputSaysWhereWhatAndWhatWasExpected) {
  struct Case {
    const char *from, *to, *message;
  };
  const std::vector<Case> cases = {
      {"stiffness=\"720e3\"", "stiffness=\"720e3N/m\"",
       "arm.xml:9: <cable stiffness=\"720e3N/m\">: expected a number in N/m, such as 720e3"},
      {"stiffness=\"720e3\"", "stifness=\"720e3\"",
       "arm.xml:9: <cable stifness=\"720e3\">: unknown attribute; expected one of law, stiffness, damping, tension, "
       "pulley_radius"},
      {" stiffness=\"720e3\"", "",
       "arm.xml:9: <cable>: attribute stiffness is missing; expected a number in N/m, such as 0.5"},
      {"stiffness=\"720e3\"", "stiffness=\"0\"",
       "arm.xml:9: <cable stiffness=\"0\">: expected a number greater than 0"},
      {"tension=\"51\"", "tension=\"0\"", "arm.xml:9: <cable tension=\"0\">: expected a number greater than 0"},
      {"law=\"exponential\"", "law=\"rubber\"",
       "arm.xml:9: <cable law=\"rubber\">: expected one of paper, exponential, linear"},
      {"damping=\"4000\"", "damping=\"inf\"",
       "arm.xml:9: <cable damping=\"inf\">: expected a number in N s/m, such as 0.5"},
      {"damping=\"4000\"", "damping=\"4000\" damping=\"5\"",
       "arm.xml:9: is not well-formed XML (parsing attribute); correct the tags and attributes near this line: "
       "each tag closed, each attribute once, in quotes"},
      {"a=\"0.2\"", "a=\"0.2 deg\"",
       "arm.xml:6: <dh a=\"0.2 deg\">: expected a number in m, such as 0.2, or 0.2 mm"},
      {"alpha=\"90 deg\"", "alpha=\"90deg\"",
       "arm.xml:6: <dh alpha=\"90deg\">: expected a number in rad, such as 90, or 90 deg"},
      {"0 0 -9.81", "0 -9.81",
       "arm.xml:2: <gravity>: text '0 -9.81': expected 3 numbers in m/s^2 with blanks between them"},
      {"mass=\"0.5\"", "mass=\"-0.5\"", "arm.xml:7: <link mass=\"-0.5\">: expected a number of at least 0"},
      {"1e-3 2e-3 2.5e-3 1e-4 0 0", "1e-3 1e-3 4e-3 0 0 0",
       "arm.xml:7: <link inertia=\"1e-3 1e-3 4e-3 0 0 0\">: joint 'swing' has principal moments 0.001, 0.001, 0.004 "
       "kg m^2; expected none above the sum of the other two (no body has that); check the entries, which are xx yy zz "
       "xy xz yz about the centre of mass"},
      {"1e-3 2e-3 2.5e-3 1e-4 0 0", "1e-3 2e-3 -1e-3 0 0 0",
       "arm.xml:7: <link inertia=\"1e-3 2e-3 -1e-3 0 0 0\">: joint 'swing' has principal moments -0.001, 0.001, 0.002 "
       "kg m^2; expected none below 0; check the signs of xy, xz, yz"},
      {"gear_ratio=\"12\"", "gear_ratio=\"0\"",
       "arm.xml:8: <motor gear_ratio=\"0\">: expected a number greater than 0"},
      {"capstan_radius=\"5.5 mm\"", "capstan_radius=\"-5.5 mm\"",
       "arm.xml:8: <motor capstan_radius=\"-5.5 mm\">: expected a number greater than 0"},
      {"inertia=\"2e-5\"", "inertia=\"0\"", "arm.xml:8: <motor inertia=\"0\">: expected a number greater than 0"},
      {"smoothing=\"0.01\"", "smoothing=\"0\"",
       "arm.xml:10: <friction smoothing=\"0\">: expected a number greater than 0"},
      {"motor_counts=\"4000\"", "motor_counts=\"4000\" motor_resolution=\"0.1\"",
       "arm.xml:11: <encoders motor_counts=\"4000\">: expected one of motor_counts and motor_resolution"},
      {"motor_offset=\"0.1\" joint_offset=\"-1 deg\"", "motor_offset=\"unknown\" joint_offset=\"unknown\"",
       "arm.xml:11: <encoders joint_offset=\"unknown\">: there is no other sensor whose zero is known; give this one's"},
      {"upper=\"90 deg\"", "upper=\"-100 deg\"",
       "arm.xml:13: <range upper=\"-100 deg\">: expected an upper end above the lower one"},
      {"home=\"10 deg\"", "home=\"91 deg\"",
       "arm.xml:13: <range home=\"91 deg\">: expected a position from lower to upper"},
      {"<range lower=\"-90 deg\" upper=\"90 deg\" home=\"10 deg\"/>\n", "",
       "arm.xml:5: <joint>: element <range> is missing; add it"},
      {"<tolerances stiffness=\"0.3\"/>", "<tolerance/>",
       "arm.xml:14: <tolerance>: unknown element; expected one of dh, frame, link, motor, cable, rigid, coupling, "
       "friction, encoders, controller, range, tolerances inside <joint>"},
      {"<tolerances stiffness=\"0.3\"/>", "soft",
       "arm.xml:5: <joint>: text 'soft': expected none here; values are attributes, name=\"value\""},
      {"<tolerances stiffness=\"0.3\"/>", "<rigid pulley_radius=\"1\"/>",
       "arm.xml:14: <rigid>: a joint with drive=\"cable\" has none; remove it, or change the drive"},
      {"<tolerances stiffness=\"0.3\"/>", "<coupling joint=\"1\" coefficient=\"1\"/>",
       "arm.xml:14: <coupling>: the first joint has no inboard joint that could move its cable; remove it"},
      {"joint=\"1\" coefficient", "joint=\"2\" coefficient",
       "arm.xml:21: <coupling joint=\"2\">: expected a whole number from 1 to 1"},
      {"<coupling joint=\"1\" coefficient=\"0.0078\"/>",
       "<coupling joint=\"1\" coefficient=\"0\"/><coupling joint=\"1\" coefficient=\"1\"/>",
       "arm.xml:21: <coupling joint=\"1\">: coupling with this joint is given twice; give it once"},
      {"coefficient=\"0.0078\"", "coefficient=\"1e18\"",
       "arm.xml:1: <arm>: coupling matrix [3 x 3] has rank 1: some joint direction moves no motor; correct the "
       "coupling coefficients"},
      {"rpy=\"10 20 30 deg\"", "matrix=\"1 0 0 0 1 0 0 0 -1\"",
       "arm.xml:17: <frame matrix=\"1 0 0 0 1 0 0 0 -1\">: expected a rotation matrix, row by row; its rows are not "
       "orthonormal and right-handed"},
      {" rpy=\"10 20 30 deg\"", "", "arm.xml:17: <frame>: expected one of rpy and matrix; give one rotation"},
      {"<frame xyz=\"0 0 0.1\" rpy=\"10 20 30 deg\"/>\n", "",
       "arm.xml:16: <joint>: expected one of <dh> and <frame>; give one frame"},
      {"name=\"slide\"", "name=\"swing\"",
       "arm.xml:16: <joint name=\"swing\">: another joint has this name; give it its own"},
      {"<link mass=\"0.1\" com=\"0.05 0 0\" inertia=\"1e-4 1e-4 1e-4 0 0 0\"/>",
       "<link mass=\"0\" com=\"0 0 0\" inertia=\"0 0 0 0 0 0\"/>",
       "arm.xml:25: <joint>: this joint moves no mass; give its link or a link outboard of it a mass"},
      {"name=\"backlash\"", "name=\"backlsh\"",
       "arm.xml:32: <effect name=\"backlsh\">: unknown effect; expected one of "},
      {"half_gap=\"0.35 mm\"", "gap=\"0.35 mm\"",
       "arm.xml:32: <effect gap=\"0.35 mm\">: unknown attribute; expected one of name, joint, half_gap"},
      {"half_gap=\"0.35 mm\"", "half_gap=\"-0.35 mm\"",
       "arm.xml:32: <effect half_gap=\"-0.35 mm\">: expected a number from 0 to 0.011 m"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "joint=\"2\"",
       "arm.xml:32: <effect joint=\"2\">: effect backlash cannot be at joint 2 of this arm; remove the effect"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "joint=\"4\"",
       "arm.xml:32: <effect joint=\"4\">: expected a whole number from 1 to 3"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "",
       "arm.xml:32: <effect>: attribute joint is missing; expected a whole number from 1 to 3"},
      {"<effect name=\"payload\"/>", "<effect name=\"payload\" joint=\"1\"/>",
       "arm.xml:33: <effect joint=\"1\">: effect payload is of the whole arm; remove the joint"},
      {"motor_position_1", "motor_position_4",
       "arm.xml:36: <column>: column map: 'motor_position_4': the last joint of the arm is 3; remove this column from "
       "the map"},
      {"sign=\"-1\"", "sign=\"-2\"",
       "arm.xml:36: <column>: column 'motor_position_1': expected sign 1 or -1; other factors belong in scale"},
      {"/>\n</arm>", "/>\n<estimator name=\"sr_ukf\"/></arm>",
       "arm.xml:39: <estimator name=\"sr_ukf\">: options of this estimator are given twice; put them in one element"},
      {"</effects>", "</effect>",
       "arm.xml:31: is not well-formed XML (mismatched element); correct the tags and attributes near this line: "
       "each tag closed, each attribute once, in quotes"},
      {"</arm>\n", "</arm>\n<arm/>\n",
       "arm.xml:40: expected nothing after </arm>; an XML file has one root element"},
  };
  for (const Case& c : cases) {
    const std::string message = message_for(replaced(c.from, c.to));
    // The list of all effects grows with the library: only its beginning is compared.
    const bool is_prefix = std::string(c.message).ends_with("one of ");
    EXPECT_EQ(is_prefix ? message.substr(0, std::strlen(c.message)) : message, c.message) << c.to;
  }
}

TEST(ModelFile, UnknownEffectListsTheKnownOnes) {
  const std::string message = message_for(replaced("name=\"backlash\"", "name=\"play\""));
  for (const Effect* effect : effect_library()) EXPECT_NE(message.find(effect->name()), message.npos) << message;
}

TEST(ModelFile, AnArmHasOneToSevenJoints) {
  const std::string begin = "<arm name=\"a\"><gravity>0 0 0</gravity>\n", end = "</arm>";
  const auto joint = [](int k) {
    return "<joint name=\"j" + std::to_string(k) +
           "\" type=\"revolute\" drive=\"none\"><frame xyz=\"0 0 0\" rpy=\"0 0 0\"/>"
           "<link mass=\"1\" com=\"0.1 0 0\" inertia=\"0 0 0 0 0 0\"/><friction coulomb=\"0\" viscous=\"0\"/>"
           "<range lower=\"-1\" upper=\"1\" home=\"0\"/></joint>\n";
  };
  std::string joints;
  EXPECT_EQ(message_for(begin + end), "arm.xml:1: <arm>: element <joint> is missing; give 1 to 7");
  for (int k = 1; k <= 7; ++k) joints += joint(k);
  EXPECT_EQ(parse_model(begin + joints + end, "arm.xml").n(), 7);
  EXPECT_EQ(message_for(begin + joints + joint(8) + end),
            "arm.xml:9: <joint>: the arm has 8 joints; expected 1 to 7");
}

TEST(ModelFile, FileThatIsNoModelIsNamed) {
  EXPECT_EQ(message_of([] { read_model("absent.xml"); }), "absent.xml: no such file; give the path of an XML file");
  EXPECT_EQ(message_of([] { read_model(kExamples); }),
            kExamples.string() + ": is a directory; give the path of an XML file");
  EXPECT_EQ(message_for("<scenario/>"),
            "arm.xml:1: <scenario>: expected a file whose root element is <arm>; give such a file");
  EXPECT_EQ(message_for(std::string("<arm\0/>", 7)), "arm.xml: is not text; give an XML file in UTF-8");
  EXPECT_EQ(message_for(""), "arm.xml: is empty; give an XML file in UTF-8");
}

TEST(ParameterInfo, NamesKeysUnitsAndTolerancesFollowTheModel) {
  ArmModel model = parse_model(kArm, "arm.xml");
  const std::vector<ParameterInfo> all = named_parameters(model.nominal);
  const auto find = [&](const std::string& key) -> ParameterInfo {
    for (const ParameterInfo& info : all) {
      if (info.key == key) return info;
    }
    return {"absent", key, "", -2, 0, nullptr};
  };
  const ParameterInfo stiffness = find("joint1.cable.stiffness");
  EXPECT_EQ(stiffness.name, "joint 1 cable stiffness");
  EXPECT_EQ(stiffness.unit, "N/m");
  EXPECT_EQ(stiffness.joint, 0);
  EXPECT_EQ(stiffness.tolerance, 0.3);
  *stiffness.value *= 2;
  EXPECT_EQ(model.nominal.joint[0].stiffness, 1440e3);

  const ParameterInfo coupling = find("joint2.coupling.joint1");
  EXPECT_EQ(coupling.name, "joint 2 coupling with joint 1");
  EXPECT_EQ(coupling.unit, "m/rad");
  EXPECT_EQ(coupling.tolerance, 0.03);
  EXPECT_EQ(find("joint2.friction.viscous").unit, "N s/m");
  EXPECT_EQ(find("joint2.motor.torque_scale").tolerance, 0.01);
  EXPECT_EQ(find("joint2.motor.torque_bias").tolerance, 0);
  EXPECT_EQ(find("joint2.rigid.pulley_radius").unit, "1");
  // A rigid drive has no cable, a joint without drive no motor.
  EXPECT_EQ(find("joint2.cable.stiffness").name, "absent");
  EXPECT_EQ(find("joint3.motor.inertia").name, "absent");
  EXPECT_EQ(find("joint3.link.mass").name, "joint 3 link mass");
}

TEST(XmlElement, TypedAttributesOfOtherFilesAreReadTheSameWay) {
  const XmlElement root = XmlElement::parse(
      "<sweep model=\"../arm.xml\" jobs=\"4\" resume=\"true\">"
      "<at>1 2.5 3</at><run f=\"0.3 0.4\"/><run f=\"5\"/></sweep>",
      "folder/sweep.xml", "sweep");
  EXPECT_NO_THROW(root.only({"model", "jobs", "resume"}, {"at", "run"}));
  EXPECT_EQ(root.path("model"), "folder/../arm.xml");
  EXPECT_EQ(root.integer("jobs", 1, 8), 4);
  EXPECT_EQ(root.integer_or("shard", 7, 1, 8), 7);
  EXPECT_TRUE(root.flag_or("resume", false));
  EXPECT_FALSE(root.flag_or("verbose", false));
  EXPECT_EQ(root.child("at").text_numbers(""), (std::vector<double>{1, 2.5, 3}));
  ASSERT_EQ(root.children("run").size(), 2u);
  EXPECT_EQ(root.children("run")[0].numbers("f", ""), (std::vector<double>{0.3, 0.4}));
  EXPECT_FALSE(root.optional_child("absent").has_value());
  EXPECT_EQ(message_of([&] { root.integer("jobs", 1, 3); }),
            "folder/sweep.xml:1: <sweep jobs=\"4\">: expected a whole number from 1 to 3");
  EXPECT_EQ(message_of([&] { root.child("run"); }),
            "folder/sweep.xml:1: <run>: stands twice inside <sweep>; give it once");
  EXPECT_EQ(message_of([&] { root.flag_or("jobs", true); }),
            "folder/sweep.xml:1: <sweep jobs=\"4\">: expected one of true, false");
}

TEST(XmlElement, OutlivesTheDocumentItCameFrom) {
  const XmlElement child = XmlElement::parse("<a><b x=\"1\"/></a>", "a.xml", "a").child("b");
  EXPECT_EQ(child.number("x", "m"), 1);
}

}  // namespace
}  // namespace halyard
