// What reading a model file says of a flaw: where, what, and what was expected.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/small_arm.h"

namespace halyard {
namespace {

TEST(ModelFile, BadInputSaysWhereWhatAndWhatWasExpected) {
  struct Case {
    const char *from, *to, *message;
  };
  const std::vector<Case> cases = {
      {"stiffness=\"720e3\"", "stiffness=\"720e3N/m\"",
       "arm.xml:9: <cable stiffness=\"720e3N/m\">: expected a number in N/m, with nothing behind it, such as 1.5e3"},
      {"stiffness=\"720e3\"", "stifness=\"720e3\"",
       "arm.xml:9: <cable stifness=\"720e3\">: unknown attribute; expected one of law, stiffness, damping, tension, "
       "pulley_radius"},
      {" stiffness=\"720e3\"", "",
       "arm.xml:9: <cable>: attribute stiffness is missing; expected a number in N/m, with nothing behind it, such as "
       "1.5e3"},
      {"stiffness=\"720e3\"", "stiffness=\"0\"",
       "arm.xml:9: <cable stiffness=\"0\">: expected a number greater than 0"},
      {"tension=\"51\"", "tension=\"0\"", "arm.xml:9: <cable tension=\"0\">: expected a number greater than 0"},
      {"law=\"exponential\"", "law=\"rubber\"",
       "arm.xml:9: <cable law=\"rubber\">: expected one of paper, exponential, linear"},
      {"damping=\"4000\"", "damping=\"inf\"",
       "arm.xml:9: <cable damping=\"inf\">: expected a number in N s/m, with nothing behind it, such as 1.5e3"},
      {"damping=\"4000\"", "damping=\"4000\" damping=\"5\"",
       "arm.xml:9: is not well-formed XML (parsing attribute); correct the tags and attributes near this line: "
       "each tag closed, each attribute once, in quotes"},
      {"a=\"0.2\"", "a=\"0.2 deg\"",
       "arm.xml:6: <dh a=\"0.2 deg\">: expected a number in m, or one with mm behind it, such as 1.5 mm"},
      {"alpha=\"90 deg\"", "alpha=\"90deg\"",
       "arm.xml:6: <dh alpha=\"90deg\">: expected a number in rad, or one with deg behind it, such as 1.5 deg"},
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
      {"motor_counts=\"4000\"", "motor_counts=\"1e-308\"",
       "arm.xml:11: <encoders motor_counts=\"1e-308\">: expected at least 1 count per turn"},
      {"motor_offset=\"0.1\"", "joint_noise=\"-0.1 deg\"",
       "arm.xml:11: <encoders joint_noise=\"-0.1 deg\">: expected a number of at least 0"},
      {"motor_offset=\"0.1\" joint_offset=\"-1 deg\"", "motor_offset=\"unknown\" joint_offset=\"unknown\"",
       "arm.xml:11: <encoders joint_offset=\"unknown\">: there is no other sensor whose zero is known; give this "
       "one's"},
      {"upper=\"90 deg\"", "upper=\"-100 deg\"",
       "arm.xml:13: <range upper=\"-100 deg\">: expected an upper end above the lower one"},
      {"home=\"10 deg\"", "home=\"91 deg\"",
       "arm.xml:13: <range home=\"91 deg\">: expected a position from lower to upper"},
      {"<range lower=\"-90 deg\" upper=\"90 deg\" home=\"10 deg\"/>\n", "",
       "arm.xml:5: <joint>: element <range> is missing; add it"},
      {"<tolerances stiffness=\"0.3\" com=\"2e-3\" inertia=\"0.1\" smoothing=\"0.5\"/>", "<tolerance/>",
       "arm.xml:14: <tolerance>: unknown element; expected one of dh, frame, link, motor, cable, rigid, coupling, "
       "friction, encoders, controller, range, tolerances inside <joint>"},
      {"<tolerances stiffness=\"0.3\" com=\"2e-3\" inertia=\"0.1\" smoothing=\"0.5\"/>", "soft",
       "arm.xml:5: <joint>: text 'soft': expected none here; values are attributes, name=\"value\""},
      {"<tolerances stiffness=\"0.3\" com=\"2e-3\" inertia=\"0.1\" smoothing=\"0.5\"/>", "<rigid pulley_radius=\"1\"/>",
       "arm.xml:14: <rigid>: a joint with drive=\"cable\" has none; remove it, or change the drive"},
      {"<tolerances stiffness=\"0.3\" com=\"2e-3\" inertia=\"0.1\" smoothing=\"0.5\"/>",
       "<coupling joint=\"1\" coefficient=\"1\"/>",
       "arm.xml:14: <coupling>: the first joint has no inboard joint that could move its cable; remove it"},
      {"joint=\"1\" coefficient", "joint=\"2\" coefficient",
       "arm.xml:21: <coupling joint=\"2\">: expected the number of a joint nearer the base, 1 to 1: only its motion "
       "moves this cable"},
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
      {"com=\"0.05 0 0\" inertia=\"1e-4 1e-4 1e-4 0 0 0\"", "com=\"0 0 0.1\" inertia=\"1e-3 1e-3 0 0 0 0\"",
       "arm.xml:25: <joint>: at home this joint moves without inertia while the joints inboard of it are free (the "
       "mass matrix is singular); give its link or a link outboard of it an inertia about its axis"},
      {"name=\"backlash\"", "name=\"backlsh\"",
       "arm.xml:32: <effect name=\"backlsh\">: unknown effect; expected one of "},
      {"half_gap=\"0.35 mm\"", "gap=\"0.35 mm\"",
       "arm.xml:32: <effect gap=\"0.35 mm\">: unknown attribute; expected one of name, joint, half_gap, rounding"},
      {"half_gap=\"0.35 mm\"", "half_gap=\"-0.35 mm\"",
       "arm.xml:32: <effect half_gap=\"-0.35 mm\">: expected a number from 0 to 0.011 m"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "joint=\"2\"",
       "arm.xml:32: <effect joint=\"2\">: effect backlash cannot be at joint 2 of this arm; remove the effect"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "joint=\"4\"",
       "arm.xml:32: <effect joint=\"4\">: expected a whole number from 1 to 3"},
      {"joint=\"1\" half_gap=\"0.35 mm\"", "",
       "arm.xml:32: <effect>: attribute joint is missing; expected a whole number from 1 to 3"},
      {"<effect name=\"payload\"/>",
       "<effect name=\"external_force\" joint=\"1\" force=\"0.1\" start=\"6\" stop=\"2\"/>",
       "arm.xml:33: <effect>: stop is before start; exchange them"},
      {"<effect name=\"payload\"/>",
       "<effect name=\"friction_drift\" joint=\"1\" start=\"-0.7\"/>"
       "<effect name=\"friction_drift\" joint=\"1\" start=\"-0.7\"/>",
       "arm.xml:33: <effect start=\"-0.7\">: with the other effects of this kind at the joint it is -1.4, expected a "
       "sum from -1 to 5"},
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
      {"</arm>\n", "</arm>\n<arm/>\n", "arm.xml:40: expected nothing after </arm>; an XML file has one root element"},
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
  EXPECT_EQ(message_for(begin + joints + joint(8) + end), "arm.xml:9: <joint>: the arm has 8 joints; expected 1 to 7");
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

/// With two effects of these attributes at the place of the last one.
std::string with_effects(const std::string& first, const std::string& second) {
  return replaced("<effect name=\"payload\"/>", "<effect " + first + "/>\n<effect " + second + "/>");
}

TEST(ModelFile, EffectsThatAreFineAloneMustNotChangeTheArmToOneThatCannotBe) {
  const std::string friction = "name=\"joint_friction\" joint=\"1\" coulomb_change=";
  EXPECT_EQ(message_for(with_effects(friction + "\"-0.25\"", friction + "\"-0.375\"")),
            "arm.xml:34: <effect>: with joint_friction of joint 1 after the effects before it, the coulomb of "
            "<friction> of joint 1 becomes -0.125, expected at least 0; make the change smaller, or remove one of the "
            "effects");
  // 0.5 - 0.4 - 0.1 is -3e-17 after rounding.
  EXPECT_EQ(message_for(with_effects(friction + "\"-0.4\"", friction + "\"-0.1\"")), "no InputError");

  const std::string payload = "name=\"payload\" mass=\"-0.0625\"";
  EXPECT_EQ(message_for(with_effects(payload, payload)),
            "arm.xml:34: <effect>: with payload after the effects before it, the mass of <link> of joint 3 becomes "
            "-0.025, expected at least 0; make the change smaller, or remove one of the effects");
}

}  // namespace
}  // namespace halyard
