#pragma once

#include "tests/app/bad_input/table.h"

namespace halyard::testing_program {

inline std::vector<BadInputRow> bad_sweeps() {
  return {
      {"NoAxis", Wrong::sweep, put(R"(<axis parameter="joint1.cable.stiffness" values="1e5 2e5"/>)", R"()"),
       "bad.xml:1: <sweep>: element <axis> is missing; give one or more"},
      {"ScenarioAbsent", Wrong::sweep, put(R"(experiment_a.xml)", R"(none.xml)"),
       "bad.xml:1: <sweep scenario=\"none.xml\">: none.xml: no such file; correct the path, which is relative to "
       "this file's folder"},
      {"UnknownNumber", Wrong::sweep, put(R"(cable.stiffness)", R"(cable.stifness)"),
       "bad.xml:2: <axis parameter=\"joint1.cable.stifness\">: parameter 'joint1.cable.stifness': the model has "
       "none of that name; expected one of joint1.link.mass, {any}, jointK.effect.NAME.PARAMETER or "
       "arm.effect.NAME.PARAMETER"},
      {"ValueOfNoArm", Wrong::sweep, put(R"(2e5)", R"(-2)"),
       "bad.xml, at joint1.cable.stiffness = -2 N/m, robot:8: <cable stiffness=\"-2\">: expected a number "
       "greater than 0"},
      {"ValueNaN", Wrong::sweep, put(R"(2e5)", R"(nan)"),
       "bad.xml:2: <axis values=\"1e5 nan\">: expected numbers with blanks between them"},
      {"UnknownEstimator", Wrong::sweep, put(R"("kinematics")", R"("kalman")"),
       "bad.xml: no estimator is named 'kalman'; found: camera_sr_ukf disturbance_sr_ukf ekf kinematics smoother "
       "sr_ukf; give one of these, or the path of a module such as ./kalman.so"},
      {"EstimatorOfAMegabyte", Wrong::sweep, put(R"("kinematics")", "\"" + std::string(1'000'000, 'k') + "\""),
       "bad.xml: no estimator is named 'kkk{any}kkk...'; found: camera_sr_ukf disturbance_sr_ukf ekf kinematics "
       "smoother sr_ukf; give one of these, or the path of a module such as ./" +
           std::string(80, 'k') + "....so"},
      {"EstimatorIsAFolder", Wrong::sweep, put(R"("kinematics")", R"("./.")"),
       "bad.xml: plugin {any}: not a file; give the path of a module (.so)"},
      {"EstimatorTwice", Wrong::sweep, put(R"("kinematics")", R"("ekf,ekf")"),
       "bad.xml:1: <sweep estimators=\"ekf,ekf\">: estimators 'ekf,ekf': 'ekf' is listed twice; list it once"},
      {"TooManyPoints", Wrong::sweep, put(R"(values="1e5 2e5"/>)", R"(from="1e5" to="2e5" steps="2000"/>
<axis parameter="joint2.cable.stiffness" from="1e5" to="2e5" steps="2000"/>)"),
       "bad.xml:1: <sweep>: 4e+06 points; expected at most 1e+06; take fewer values"},
      {"LogarithmOfZero", Wrong::sweep, put(R"(values="1e5 2e5")", R"(from="0" to="2e5" steps="2" scale="log")"),
       "bad.xml:2: <axis from=\"0\">: expected a number greater than 0"},
      {"NothingIsCounted", Wrong::sweep, put(R"(skip="0")", R"(duration="1" skip="1")"),
       "bad.xml:1: <sweep skip=\"1\">: expected less than the duration, 1 s; of the first 1 s no error is counted"},
      {"ShorterThanWhatIsSkipped", Wrong::sweep, put(R"(skip="0")", R"(duration="0.4")"),
       "bad.xml:1: <sweep>: skip: expected less than the duration, 0.4 s; of the first 0.5 s no error is counted"},
      {"DurationBeyondMemory", Wrong::sweep, put(R"(skip="0")", R"(duration="1e12" skip="0")"),
       "bad.xml:1: <sweep duration=\"1e12\">: scenario 'A: high tension': the run: needs about 5.52e+08 GB of memory, "
       "and {any} GB are there; take a shorter duration or a longer control period"},
      {"NoRepeats", Wrong::sweep, put(R"(name="s")", R"(name="s" repeats="0")"),
       "bad.xml:1: <sweep repeats=\"0\">: expected a whole number from 1 to 100000"},
      {"FactorOfAnAbsentNoise", Wrong::sweep,
       put(R"(parameter="joint1.cable.stiffness" values="1e5 2e5")",
           R"(parameter="joint1.sensors.torque_noise" values="1 2" factor="true")"),
       "bad.xml:2: <axis parameter=\"joint1.sensors.torque_noise\">: parameter 'joint1.sensors.torque_noise': is "
       "0 or absent, and so is every multiple of it; give it a value in its own file, or leave out factor"},
      {"FactorOfAnAbsentEffect", Wrong::sweep,
       put(R"(parameter="joint1.cable.stiffness" values="1e5 2e5")",
           R"(parameter="joint1.effect.backlash.half_gap" values="1 2" factor="true")"),
       "bad.xml:2: <axis parameter=\"joint1.effect.backlash.half_gap\">: parameter "
       "'joint1.effect.backlash.half_gap': is 0 or absent, and so is every multiple of it; give it a value in "
       "its own file, or leave out factor"},
      {"ZeroPeriod", Wrong::sweep,
       put(R"(parameter="joint1.cable.stiffness" values="1e5 2e5")", R"(parameter="control.period" values="0 1e-3")"),
       "bad.xml, at control.period = 0 s, control.period = 0 s: expected a number above 0"},
      {"OptionOutOfRange", Wrong::sweep,
       put(R"("kinematics">
<axis parameter="joint1.cable.stiffness" values="1e5 2e5")",
           R"("ekf">
<axis parameter="estimator.ekf.gate" values="0.9 20")"),
       "bad.xml, at estimator.ekf.gate = 20: raven2.xml: estimator ekf: option gate = '20': expected a number "
       "from 0.5 to 1; correct it, or leave the option out"},
  };
}

}  // namespace halyard::testing_program
