#include "model/model_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/small_arm.h"

namespace halyard {
namespace {

TEST(ModelFile, ReadsEveryElement) {
  ArmModel model = parse_model(kArm, "arm.xml");
  ASSERT_EQ(model.n(), 3);
  const JointParameters<double>&swing = model.nominal.joint[0], &slide = model.nominal.joint[1];
  EXPECT_EQ(model.nominal.gravity[2], -9.81);
  EXPECT_DOUBLE_EQ(model.nominal.payload_point[2], 0.3);
  EXPECT_EQ(swing.law, CableLaw::exponential);
  EXPECT_DOUBLE_EQ(swing.capstan_radius, 5.5e-3);
  EXPECT_DOUBLE_EQ(swing.joint_encoder_offset, -kDegree);
  EXPECT_EQ(swing.motor_encoder_offset, 0.1);
  EXPECT_EQ(model.joints[0].tolerances.length, 0.02);
  EXPECT_EQ(model.joints[0].tolerances.torque_scale, 0.01);
  EXPECT_EQ(model.joints[0].tolerances.stiffness, 0.3);
  EXPECT_EQ(model.joints[1].tolerances.stiffness, Tolerances().stiffness);
  EXPECT_EQ(model.joints[1].tolerances.coupling, 0.03);
  EXPECT_EQ(model.joints[0].tolerances.com, 2e-3);
  EXPECT_EQ(model.joints[1].tolerances.com, Tolerances().com);
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
  EXPECT_EQ(model.effects[1].joint, kWholeArm);
  EXPECT_EQ(model.effects[1].p[0], model.effects[1].effect->parameters(model.nominal, kWholeArm)[0].typical);
  const ColumnSource& source = model.columns.sources().at("motor_position_1");
  EXPECT_EQ(source.column, "spindle <deg>");
  EXPECT_DOUBLE_EQ(source.scale, -2 * kDegree);
  EXPECT_EQ(source.offset, 0.5);
  EXPECT_EQ(source.wrap, 360);
  EXPECT_EQ(model.estimators.at("sr_ukf"), (EstimatorOptions{{"alpha", "1e-3"}, {"notes", "as in the paper"}}));
}

TEST(ModelFile, EffectWithOneOfItsSizesGivenHasNoOther) {
  const auto effect = [](const std::string& attributes) {
    const ArmModel model = parse_model(
        replaced("<effect name=\"payload\"/>", "<effect name=\"external_force\" joint=\"2\" " + attributes + "/>"),
        "arm.xml");
    return std::pair(model.effects[1], model.effects[1].effect->parameters(model.nominal, 1));
  };
  const auto [typical, p] = effect("");
  const auto [forced, same] = effect("force=\"7\" start=\"1\"");
  ASSERT_EQ(p[0].name, "force");
  EXPECT_EQ(forced.p[0], 7);
  EXPECT_EQ(forced.p[1], 1);
  EXPECT_EQ(forced.p[2], p[2].typical) << "a shape";
  ASSERT_EQ(p[4].name, "contact_stiffness");
  EXPECT_NE(typical.p[4], 0);
  EXPECT_EQ(forced.p[4], 0);
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

TEST(ModelFile, TheNoiseOfASensorIsReadBesideAnUnknownZeroOfTheOther) {
  const ArmModel model = parse_model(
      replaced("motor_offset=\"0.1\"", "motor_noise=\"1e-3\" joint_noise=\"0.01 deg\" motor_offset=\"unknown\""),
      "arm.xml");
  EXPECT_EQ(model.nominal.joint[0].motor_encoder_noise, 1e-3);
  EXPECT_DOUBLE_EQ(model.nominal.joint[0].joint_encoder_noise, 0.01 * kDegree);
  const ArmModel again = parse_model(model_to_xml(model), "again.xml");
  EXPECT_EQ(again.nominal.joint[0].joint_encoder_noise, model.nominal.joint[0].joint_encoder_noise);
}

TEST(ModelFile, ATorqueIsCommandedUnlessItIsMeasured) {
  EXPECT_EQ(parse_model(kArm, "arm.xml").nominal.joint[0].torque_source, TorqueSource::commanded);
  const ArmModel model =
      parse_model(replaced("<motor inertia=\"2e-5\"", "<motor torque=\"measured\" inertia=\"2e-5\""), "arm.xml");
  EXPECT_EQ(model.nominal.joint[0].torque_source, TorqueSource::measured);
  EXPECT_EQ(parse_model(model_to_xml(model), "again.xml").nominal.joint[0].torque_source, TorqueSource::measured);
  EXPECT_FALSE(find_effect("actuator_saturation")->applies(model.nominal, 0));
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

TEST(ModelFile, AMatrixTypedWithFewDigitsBecomesTheNearestRotation) {
  const std::string typed = "0.866025 -0.5 0 0.5 0.866025 0 0 0 1";  // a turn of 30 degrees
  const ArmModel model = parse_model(replaced("rpy=\"10 20 30 deg\"", "matrix=\"" + typed + "\""), "arm.xml");
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(M_PI / 6), R[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(model.nominal.joint[1].frame_R[i][j], R[i][j], 3e-7);
  Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> found(&model.nominal.joint[1].frame_R[0][0]);
  EXPECT_LT((found * found.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
}

/// All numbers of a joint; padding does not count.
std::vector<double> numbers_of(const JointParameters<double>& j) {
  std::vector<double> all(&j.frame_R[0][0], &j.frame_R[0][0] + 9);
  for (const double x : j.frame_p) all.push_back(x);
  for (const double x : j.com) all.push_back(x);
  for (const double x : j.inertia) all.push_back(x);
  for (const double x : j.coupling) all.push_back(x);
  for (const double x : {j.mass,
                         j.rotor_inertia,
                         j.motor_coulomb,
                         j.motor_viscous,
                         j.motor_smoothing,
                         j.gear_ratio,
                         j.capstan_radius,
                         j.torque_scale,
                         j.torque_bias,
                         j.pulley_radius,
                         j.stiffness,
                         j.damping,
                         j.tension,
                         j.joint_coulomb,
                         j.joint_viscous,
                         j.joint_smoothing,
                         j.motor_encoder_offset,
                         j.joint_encoder_offset,
                         j.motor_encoder_resolution,
                         j.joint_encoder_resolution,
                         j.motor_encoder_noise,
                         j.joint_encoder_noise,
                         double(j.motor_zero_known),
                         double(j.joint_zero_known)}) {
    all.push_back(x);
  }
  all.push_back(static_cast<double>(j.type));
  all.push_back(static_cast<double>(j.drive));
  all.push_back(static_cast<double>(j.law));
  all.push_back(static_cast<double>(j.torque_source));
  return all;
}

std::vector<double> numbers_of(const JointDescription& d) {
  const Tolerances& t = d.tolerances;
  return {d.lower,  d.upper, d.home,      d.controller.kp, d.controller.kd, d.controller.torque_limit,
          t.length, t.mass,  t.stiffness, t.friction,      t.coupling,      t.torque_scale};
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << a[i] << " " << b[i];
  }
}

/// The model with an effect whose parameters lie at their lower bounds, and then with more friction.
ArmModel with_effect_at_bound_and_more_friction(const Effect& effect, EffectPlace place) {
  ArmModel model = read_model(kExamples / "raven2.xml");
  PlacedEffect placed = place_effect(effect, model.nominal, place);
  const std::vector<EffectParameter> parameters = effect.parameters(model.nominal, place);
  for (std::size_t i = 0; i < parameters.size(); ++i) placed.p[i] = parameters[i].lower;
  model.effects = {placed};
  for (int k = 0; k < model.n(); ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j.joint_coulomb *= 1.2, j.motor_coulomb *= 1.2, j.stiffness /= 1.2;
  }
  return model;
}

TEST(ModelFile, ReadsBackAnEffectAtItsBoundAfterTheArmHasChanged) {
  int refused = 0;
  for (const Effect* effect : effect_library()) {
    const std::vector<EffectPlace> places = effect_places(*effect, read_model(kExamples / "raven2.xml").nominal);
    ArmModel model = with_effect_at_bound_and_more_friction(*effect, places.back());
    try {
      parse_model(model_to_xml(model), "again.xml");
    } catch (const InputError&) {
      ++refused;
    }
    keep_within_bounds(model.effects[0], model.nominal);
    EXPECT_NO_THROW(parse_model(model_to_xml(model), "again.xml")) << effect->name();
  }
  EXPECT_GT(refused, 0) << "no effect's bounds depend on these numbers: the test is of no use";
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
    const ArmParameters<double>&a = again.nominal, &b = model.nominal;
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
      expect_same_bits({other.scale, other.offset, other.wrap}, {source.scale, source.offset, source.wrap});
    }
    EXPECT_EQ(again.estimators, model.estimators);
  }
}

TEST(ParameterInfo, NamesKeysUnitsAndTolerancesFollowTheModel) {
  ArmModel model = parse_model(kArm, "arm.xml");
  const std::vector<ParameterInfo> all = named_parameters(model.nominal);
  double nothing = 0;
  const auto find = [&](const std::string& key) -> ParameterInfo {
    for (const ParameterInfo& info : all) {
      if (info.key == key) return info;
    }
    return {"absent", key, "", -2, nullptr, ArmNumber(nothing), 0, 0};
  };
  const ParameterInfo stiffness = find("joint1.cable.stiffness");
  EXPECT_EQ(stiffness.name, "joint 1 cable stiffness");
  EXPECT_EQ(stiffness.unit, "N/m");
  EXPECT_EQ(stiffness.joint, 0);
  EXPECT_EQ(model.reach(stiffness), 0.3 * 720e3);
  stiffness.number.set(2 * stiffness.number.get());
  EXPECT_EQ(model.nominal.joint[0].stiffness, 1440e3);

  const ParameterInfo coupling = find("joint2.coupling.joint1");
  EXPECT_EQ(coupling.name, "joint 2 coupling with joint 1");
  EXPECT_EQ(coupling.unit, "m/rad");
  EXPECT_DOUBLE_EQ(model.reach(coupling), 0.03 * 0.0078);
  EXPECT_EQ(find("joint2.friction.viscous").unit, "N s/m");
  EXPECT_DOUBLE_EQ(model.reach(find("joint2.motor.torque_scale")), 0.01 * 1.1);
  EXPECT_EQ(model.reach(find("joint2.motor.torque_bias")), 0);
  EXPECT_EQ(find("joint2.rigid.pulley_radius").unit, "1");
  EXPECT_EQ(model.reach(find("joint1.motor.smoothing")), 0.2);
  // A rigid drive has no cable, a joint without drive no motor.
  EXPECT_EQ(find("joint2.cable.stiffness").name, "absent");
  EXPECT_EQ(find("joint3.motor.inertia").name, "absent");
  EXPECT_EQ(find("joint3.link.mass").name, "joint 3 link mass");
}

TEST(ParameterInfo, ACentreOfMassIsAsUncertainAsTheLinkIsLong) {
  ArmModel model = parse_model(kArm, "arm.xml");
  const JointParameters<double>& j = model.nominal.joint[0];
  const auto all = named_parameters(model.nominal);
  const auto x = std::ranges::find(all, "joint1.link.com.x", &ParameterInfo::key);
  ASSERT_NE(x, all.end());
  EXPECT_EQ(x->name, "joint 1 link centre of mass x");
  EXPECT_EQ(x->number.get(), j.com[0]);
  const double square = j.com[0] * j.com[0] + j.com[1] * j.com[1] + j.com[2] * j.com[2] +
                        (j.inertia[0] + j.inertia[1] + j.inertia[2]) / 2 / j.mass;
  EXPECT_DOUBLE_EQ(model.reach(*x), model.joints[0].tolerances.com * std::sqrt(square));
}

TEST(ParameterInfo, TheMomentsOfALinkStayInProportion) {
  ArmModel model = parse_model(kArm, "arm.xml");
  const JointParameters<double> before = model.nominal.joint[0];
  const auto all = named_parameters(model.nominal);
  const auto inertia = std::ranges::find(all, "joint1.link.inertia", &ParameterInfo::key);
  ASSERT_NE(inertia, all.end());
  EXPECT_EQ(inertia->number.get(), *std::max_element(before.inertia, before.inertia + 3));
  EXPECT_DOUBLE_EQ(model.reach(*inertia), 0.1 * inertia->number.get());
  inertia->number.set(2 * inertia->number.get());
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(model.nominal.joint[0].inertia[i], 2 * before.inertia[i]);
}

TEST(ParameterInfo, ANumberIsFoundWithoutItsName) {
  ArmModel model = parse_model(kArm, "arm.xml");
  const auto all = named_parameters(model.nominal);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ArmNumber found = named_number(model.nominal, i);
    const double before = all[i].number.get();
    found.set(before + 1);
    EXPECT_EQ(all[i].number.get(), before + 1) << all[i].key;
    found.set(before);
  }
  EXPECT_THROW(named_number(model.nominal, all.size()), std::bad_optional_access);
}

TEST(ModelFile, KeepsWhichColumnsAreLeftOut) {
  ArmModel model = read_model(kExamples / "raven2.xml");
  model.columns.add_entry("joint_position_1=");
  model.columns.add_entry("joint_position_2=elbow,unit=deg");
  const std::string xml = model_to_xml(model);
  EXPECT_NE(xml.find("<column name=\"joint_position_1\" left_out=\"true\"/>"), std::string::npos) << xml;
  const ColumnMap again = parse_model(xml, "again.xml").columns;
  EXPECT_EQ(again.sources().at("joint_position_1").column, "");
  EXPECT_EQ(again.sources().at("joint_position_2").column, "elbow");
}

TEST(ModelFile, KeepsThatAColumnIsACurrent) {
  ArmModel model = read_model(kExamples / "raven2.xml");
  model.columns.add_entry("motor_torque_1=current,unit=mA,sign=-1");
  const ColumnSource again = parse_model(model_to_xml(model), "again.xml").columns.sources().at("motor_torque_1");
  EXPECT_EQ(again.electric_unit, "mA");
  EXPECT_EQ(again.scale, -1e-3);
}

}  // namespace
}  // namespace halyard
