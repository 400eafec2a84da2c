#pragma once

#include "tests/app/bad_input/table.h"

namespace halyard::testing_program {

inline const std::string kThirdSines = R"(joint="3" kind="sines" center="0.40">
    <sine amplitude="40 mm" frequency="0.4565"/>)";

inline std::vector<BadInputRow> bad_scenarios() {
  return {
      {"ModelAbsent", Wrong::scenario, put(R"(model="raven2.xml")", R"(model="none.xml")"),
       "bad.xml:4: <scenario model=\"none.xml\">: none.xml: no such file; correct the path, which is relative to "
       "this file's folder"},
      {"ModelIsAFolder", Wrong::scenario, put(R"(model="raven2.xml")", R"(model=".")"),
       "bad.xml:4: <scenario model=\".\">: .: is a directory; correct the path, which is relative to this file's "
       "folder"},
      {"UnknownEngine", Wrong::scenario, put(R"(model="raven2.xml")", R"(model="raven2.xml" engine="mujoco")"),
       "bad.xml:4: <scenario engine=\"mujoco\">: expected one of simbody, halyard"},
      {"ZeroDuration", Wrong::scenario, put(R"(duration="0.1")", R"(duration="0")"),
       "bad.xml:4: <scenario duration=\"0\">: expected a number greater than 0"},
      {"ShorterThanAPeriod", Wrong::scenario, put(R"(duration="0.1")", R"(duration="1e-6")"),
       "bad.xml: scenario 'A: high tension': the duration must be at least one control period, and both above 0 s"},
      {"DurationBeyondMemory", Wrong::scenario, put(R"(duration="0.1")", R"(duration="1e9")"),
       "bad.xml: scenario 'A: high tension': the run: needs about 5.52e+05 GB of memory, and {any} GB are there; "
       "take a shorter duration or a longer control period"},
      {"DurationNaN", Wrong::scenario, put(R"(duration="0.1")", R"(duration="nan")"),
       "bad.xml:4: <scenario duration=\"nan\">: expected a number in s, with nothing behind it, such as 1.5e3"},
      {"ZeroPeriod", Wrong::scenario, put(R"(period="0.001")", R"(period="0")"),
       "bad.xml:14: <control period=\"0\">: expected a number greater than 0"},
      {"PeriodBelowAMicrosecond", Wrong::scenario, put(R"(period="0.001")", R"(period="5e-7")"),
       "bad.xml: scenario 'A: high tension': the control period must be at least 1e-6 s: logs give times to a "
       "microsecond"},
      {"MotionOutsideTheRange", Wrong::scenario, put(R"(center="0.40")", R"(center="4.0")"),
       "bad.xml: scenario 'A: high tension': trajectory of joint 3: asks for 4.000000 m at 0.000000 s, outside "
       "the joint's range 0.230000 to 0.560000 m; make it smaller or move its center"},
      {"TrajectoryTwice", Wrong::scenario, put(R"(<trajectory joint="2")", R"(<trajectory joint="1")"),
       "bad.xml:8: <trajectory joint=\"1\">: another <trajectory> is of this joint; remove one of them"},
      {"SampleFileAbsent", Wrong::scenario, put(kThirdSines, R"(joint="3" kind="samples" file="motion.csv">)"),
       "bad.xml:11: <trajectory file=\"motion.csv\">: motion.csv: no such file; correct the path, which is "
       "relative to this file's folder"},
      {"SampleColumnAbsent", Wrong::scenario, put(kThirdSines, R"(joint="3" kind="samples" file="log.csv">)"),
       "bad.xml:11: <trajectory>: log.csv has no column 'joint_position_3'; it has 'time', 'motor_torque_1', "
       "'motor_torque_2', 'motor_torque_3', 'motor_position_1', 'motor_position_2', 'motor_position_3'; give one "
       "of these as column"},
      {"ChangeOfNoNumber", Wrong::scenario,
       put(R"(<control period=)", R"(<set parameter="joint1.cable.stifness" value="1"/><control period=)"),
       "bad.xml:14: <set parameter=\"joint1.cable.stifness\">: the model has no such number; expected one of "
       "joint1.link.mass, joint1.link.com.x, joint1.link.com.y, joint1.link.com.z, joint1.link.inertia, "
       "joint1.motor.inertia, joint1.motor.coulomb, joint1.motor.viscous, "
       "joint1.motor.smoothing, joint1.motor.gear_ratio, joint1.motor.capstan_radius, joint1.motor.torque_scale, "
       "joint1.motor.torque_bias, joint1.cable.stiffness, joint1.cable.damping, joint1.cable.tension, "
       "joint1.cable.pulley_radius, joint1.friction.coulomb, joint1.friction.viscous, joint1.friction.smoothing"},
      {"ChangeToAnImpossibleArm", Wrong::scenario,
       put(R"(<control period=)", R"(<set parameter="joint1.link.mass" value="-1"/><control period=)"),
       "bad.xml:14: <set value=\"-1\">: the model so changed:6: <link mass=\"-1\">: expected a number of at "
       "least 0"},
      {"InertiaWithoutMass", Wrong::scenario,
       put(R"(<control period=)", R"(<set parameter="joint1.link.mass" value="0"/><control period=)"),
       "bad.xml: scenario 'A: high tension': link 1: has inertia and no mass, which Simbody cannot compute; give "
       "it a mass, or take engine=\"halyard\""},
      {"IntegratorOfAnotherEngine", Wrong::scenario,
       [](const std::string& text) {
         return put(R"(<control period=)", R"(<integrator treatment="simbody_rkm"/><control period=)")(
             put(R"(model="raven2.xml")", R"(model="raven2.xml" engine="halyard")")(text));
       },
       "bad.xml: scenario 'A: high tension': an integrator of Simbody's needs engine=\"simbody\" of the scenario"},
      {"NoiseOfTooFewJoints", Wrong::scenario, put(R"(homed="true")", R"(torque_noise="1e-3 1e-3")"),
       "bad.xml:15: <sensors torque_noise=\"1e-3 1e-3\">: expected one number, or one for each of the 3 joints "
       "with blanks between, none of them negative"},
  };
}

}  // namespace halyard::testing_program
