#pragma once

#include "tests/app/bad_input/table.h"

namespace halyard::testing_program {

inline std::vector<BadInputRow> bad_models() {
  return {
      {"NotXml", Wrong::model, whole(R"(stiffness: 3)"),
       "bad.xml:1: is no XML: it does not begin with '<'; give the path of an XML file"},
      {"Empty", Wrong::model, whole(""), "bad.xml: is empty; give an XML file in UTF-8"},
      {"Binary", Wrong::model, put("<arm", std::string(1, '\0')), "bad.xml: is not text; give an XML file in UTF-8"},
      {"EndMissing", Wrong::model, put(R"(</arm>)", R"()"),
       "bad.xml:8: is not well-formed XML (parsing); correct the tags and attributes near this line: each tag "
       "closed, each attribute once, in quotes"},
      {"TextAfterItsEnd", Wrong::model, put(R"(</arm>)", R"(</arm><arm/>)"),
       "bad.xml:67: expected nothing after </arm>; an XML file has one root element"},
      {"UnknownElement", Wrong::model, put(R"(<gravity>)", R"(<payloads/><gravity>)"),
       "bad.xml:10: <payloads>: unknown element; expected one of gravity, payload, tolerances, joint, effects, "
       "columns, estimator inside <arm>"},
      {"UnknownAttribute", Wrong::model, put(R"(stiffness="720e3")", R"(stifness="720e3")"),
       "bad.xml:24: <cable stifness=\"720e3\">: unknown attribute; expected one of law, stiffness, damping, "
       "tension, pulley_radius"},
      {"MissingAttribute", Wrong::model, put(R"(mass="0.503")", R"()"),
       "bad.xml:18: <link>: attribute mass is missing; expected a number in kg, with nothing behind it, such as 1.5e3"},
      {"NumberWithAUnit", Wrong::model, put(R"(stiffness="720e3")", R"(stiffness="720e3N/m")"),
       "bad.xml:24: <cable stiffness=\"720e3N/m\">: expected a number in N/m, with nothing behind it, such as 1.5e3"},
      {"NaN", Wrong::model, put(R"(mass="0.503")", R"(mass="nan")"),
       "bad.xml:18: <link mass=\"nan\">: expected a number in kg, with nothing behind it, such as 1.5e3"},
      {"Infinite", Wrong::model, put(R"(mass="0.503")", R"(mass="inf")"),
       "bad.xml:18: <link mass=\"inf\">: expected a number in kg, with nothing behind it, such as 1.5e3"},
      {"BeyondDouble", Wrong::model, put(R"(mass="0.503")", R"(mass="1e999")"),
       "bad.xml:18: <link mass=\"1e999\">: expected a number in kg, with nothing behind it, such as 1.5e3"},
      {"NegativeMass", Wrong::model, put(R"(mass="0.503")", R"(mass="-0.503")"),
       "bad.xml:18: <link mass=\"-0.503\">: expected a number of at least 0"},
      {"InertiaOfNoBody", Wrong::model,
       put(R"(inertia="3.0309e-3 1.4398e-3 1.6716e-3 0.0286e-3 -0.0762e-3 -1.2880e-3")",
           R"(inertia="1e-3 1e-3 4e-3 0 0 0")"),
       "bad.xml:19: <link inertia=\"1e-3 1e-3 4e-3 0 0 0\">: joint 'shoulder' has principal moments 0.001, "
       "0.001, 0.004 kg m^2; expected none above the sum of the other two (no body has that); check the entries, "
       "which are xx yy zz xy xz yz about the centre of mass"},
      {"NegativeInertia", Wrong::model,
       put(R"(inertia="3.0309e-3 1.4398e-3 1.6716e-3 0.0286e-3 -0.0762e-3 -1.2880e-3")",
           R"(inertia="1e-3 1e-3 1e-3 5e-3 0 0")"),
       "bad.xml:19: <link inertia=\"1e-3 1e-3 1e-3 5e-3 0 0\">: joint 'shoulder' has principal moments -0.004, "
       "0.001, 0.005999999999999998 kg m^2; expected none below 0; check the signs of xy, xz, yz"},
      {"ZeroRatio", Wrong::model, put(R"(gear_ratio="12.25")", R"(gear_ratio="0")"),
       "bad.xml:21: <motor gear_ratio=\"0\">: expected a number greater than 0"},
      {"SingularCoupling", Wrong::model, put(R"(coefficient="0.007797")", R"(coefficient="1e18")"),
       "bad.xml:8: <arm>: coupling matrix [3 x 3] has rank 1: some joint direction moves no motor; correct the "
       "coupling coefficients"},
      {"AngleInDegrees", Wrong::model, put(R"(theta="205 deg")", R"(theta="205")"),
       "bad.xml:16: <dh theta=\"205\">: expected an angle of at most one turn, 2 pi rad; write deg behind a number "
       "in degrees"},
      {"AnglesInDegrees", Wrong::model,
       put(R"(<dh alpha="0" a="0" theta="205 deg" d="0"/>)", R"(<frame xyz="0 0 0" rpy="0 -90 0"/>)"),
       "bad.xml:16: <frame rpy=\"0 -90 0\">: expected an angle of at most one turn, 2 pi rad; write deg behind a "
       "number "
       "in degrees"},
      {"HomeOutsideTheRange", Wrong::model, put(R"(home="45 deg")", R"(home="100 deg")"),
       "bad.xml:31: <range home=\"100 deg\">: expected a position from lower to upper"},
      {"RangeUpsideDown", Wrong::model, put(R"(lower="0 deg")", R"(lower="91 deg")"),
       "bad.xml:31: <range upper=\"90 deg\">: expected an upper end above the lower one"},
      {"JointNameTwice", Wrong::model, put(R"(name="elbow")", R"(name="shoulder")"),
       "bad.xml:34: <joint name=\"shoulder\">: another joint has this name; give it its own"},
      {"ControlCharacterInAName", Wrong::model, put(R"(name="elbow")", R"(name="el&#27;[31mbow")"),
       "bad.xml:34: <joint name=\"el?[31mbow\">: expected a text without control characters; remove them"},
      {"EffectUnknown", Wrong::model,
       put(R"(</arm>)", R"(<effects><effect name="backlsh" joint="1"/></effects></arm>)"),
       "bad.xml:67: <effect name=\"backlsh\">: unknown effect; expected one of payload, gravity_tilt, "
       "motor_friction, joint_friction, motor_presliding, joint_presliding, stribeck, pulley_friction, hysteresis, "
       "backlash, slack, stiffness, coupling, creep, capstan_ratio, capstan_eccentricity, encoder_offset, "
       "encoder_eccentricity, torque_ripple, torque_scale, delay, cable_slip, external_force, friction_drift, "
       "actuator_saturation, or one of a module given by --effects"},
      {"EffectOutOfBounds", Wrong::model,
       put(R"(</arm>)", R"(<effects><effect name="backlash" joint="1" half_gap="-1"/></effects></arm>)"),
       "bad.xml:67: <effect half_gap=\"-1\">: expected a number from 0 to 0.01135 m"},
      {"EffectAtNoJoint", Wrong::model,
       put(R"(</arm>)", R"(<effects><effect name="backlash" joint="9"/></effects></arm>)"),
       "bad.xml:67: <effect joint=\"9\">: expected a whole number from 1 to 3"},
      {"ColumnOfUnknownUnit", Wrong::model,
       put(R"(</arm>)", R"(<columns><column name="motor_position_1" from="p" unit="degree"/></columns></arm>)"),
       "bad.xml:67: <column>: column 'motor_position_1': unit 'degree': expected one of rad, deg, turn, m, mm, "
       "um; for any other unit leave it out and give a scale to SI"},
      {"ColumnMappedTwice", Wrong::model,
       put(R"(</arm>)", R"(<columns><column name="time" from="t"/><column name="time" from="u"/></columns></arm>)"),
       "bad.xml:67: <column>: column 'time': is mapped twice; remove one of the two"},
      {"EstimatorOptionUnknown", Wrong::options, put(R"(</arm>)", R"(<estimator name="ekf" colour="blue"/></arm>)"),
       "bad.xml: estimator ekf: unknown option 'colour'; known are encoder_noise, torque_noise, "
       "joint_force_noise, noise_time, effect_noise_time, adaptation_time, max_step, restart_gap, gate"},
      {"EstimatorOptionOutOfRange", Wrong::options, put(R"(</arm>)", R"(<estimator name="ekf" gate="x"/></arm>)"),
       "bad.xml: estimator ekf: option gate = 'x': expected a number from 0.5 to 1; correct it, or leave the "
       "option out"},
  };
}

}  // namespace halyard::testing_program
