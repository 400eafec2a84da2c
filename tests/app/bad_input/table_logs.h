#pragma once

#include "tests/app/bad_input/table.h"

namespace halyard::testing_program {

inline std::vector<BadInputRow> bad_logs() {
  return {
      {"Empty", Wrong::log, whole(""), "bad.csv: is empty; give a CSV log with a header row and samples"},
      {"Binary", Wrong::log, put("time", std::string(1, '\0')), "bad.csv: is not text; give a CSV log in UTF-8"},
      {"HeaderOnly", Wrong::log, whole(kHeader), "bad.csv: has a header but no samples; give a log with samples"},
      {"NoHeader", Wrong::log, put(kHeader, ""),
       "bad.csv:1: the first row starts with the number '0'; put a row of column names above it"},
      {"Semicolons", Wrong::log, all(",", ";"),
       "bad.csv:1: the columns are separated by semicolons or tabs; separate them by commas"},
      {"NoTime", Wrong::log, put(R"(time)", R"(t)"),
       "bad.csv:1: no column 'time'; the file has 't', 'motor_torque_1', 'motor_torque_2', 'motor_torque_3', "
       "'motor_position_1', 'motor_position_2', 'motor_position_3'; say which column of the file it is, in the model "
       "file or by --column time=NAME"},
      {"ColumnAbsent", Wrong::log, put(R"(motor_position_2)", R"(elbow_rad)"),
       "bad.csv:1: no column 'motor_position_2'; the file has 'time', 'motor_torque_1', 'motor_torque_2', "
       "'motor_torque_3', 'motor_position_1', 'elbow_rad', 'motor_position_3'; say which column of the file it is, in "
       "the model file or by --column motor_position_2=NAME"},
      {"ColumnTwice", Wrong::log, put(R"(motor_torque_2)", R"(motor_torque_1)"),
       "bad.csv:1: column 'motor_torque_1' stands twice in the header; rename one of the two"},
      {"Words", Wrong::log, put(R"(107)", R"(zero)"),
       "bad.csv:2: column 'motor_position_1': 'zero' is not a number; write a finite decimal number, or leave "
       "the cell empty for a missing sample"},
      {"NaN", Wrong::log, put(R"(107)", R"(nan)"),
       "bad.csv:2: column 'motor_position_1': 'nan' is not a number; write a finite decimal number, or leave the "
       "cell empty for a missing sample"},
      {"Infinite", Wrong::log, put(R"(107)", R"(inf)"),
       "bad.csv:2: column 'motor_position_1': 'inf' is not a number; write a finite decimal number, or leave the "
       "cell empty for a missing sample"},
      {"BeyondDouble", Wrong::log, put(R"(107)", R"(1e999)"),
       "bad.csv:2: column 'motor_position_1': '1e999' is not a number; write a finite decimal number, or leave "
       "the cell empty for a missing sample"},
      {"BeyondAnyReading", Wrong::log, put(R"(107)", R"(1e300)"),
       "bad.csv:2: column 'motor_position_1': '1e300' is too large once scaled; expected a magnitude of at most 1e50 "
       "in SI units; correct it, or leave the cell empty for a missing sample"},
      {"JointBeyondAnyReading", Wrong::log,
       whole(replaced(kHeader, "\n", ",joint_position_2\n") + R"(0,0,0,0,107,204,904,1.6
0.001,0,0,0,107,204,904,-1e300
)"),
       "bad.csv:3: column 'joint_position_2': '-1e300' is too large once scaled; expected a magnitude of at most 1e50 "
       "in SI units; correct it, or leave the cell empty for a missing sample"},
      {"RowCutShort", Wrong::log,
       put(R"(204,904
)",
           R"(204
)"),
       "bad.csv:2: the row has 6 cells, the header 7; complete the row, or remove it if the recording was cut "
       "off there"},
      {"TimeAbsent", Wrong::log, put(R"(0.001,)", R"(,)"),
       "bad.csv:3: the time is missing; give every row its time, or remove the row"},
      {"TimeBackwards", Wrong::log, put(R"(0.002,)", R"(0.0005,)"),
       "bad.csv:4: time 0.0005 s follows 0.001 s; time must increase: sort the rows and remove repeated ones"},
      {"TimeTwice", Wrong::log, put(R"(0.002,)", R"(0.001,)"),
       "bad.csv:4: time 0.001 s follows 0.001 s; time must increase: sort the rows and remove repeated ones"},
      {"ColumnWithoutSamples", Wrong::log, all(R"(107)", R"()"),
       "bad.csv: motor_position_1 is empty in every row; give a log that has this signal"},
      {"TimeInMilliseconds", Wrong::clock, scaled({"time"}, 1e3),
       "bad.csv: time: a sample follows another after 1 s; expected at least 10 and at most 50000 samples a "
       "second; it looks like a time in milliseconds; read it with --column time=time,unit=ms"},
      {"TimeInNanoseconds", Wrong::clock, scaled({"time"}, 1e9),
       "bad.csv: time: a sample follows another after 1e+06 s; expected at least 10 and at most 50000 samples a "
       "second; "
       "it looks like a time in nanoseconds; read it with --column time=time,scale=1e-09"},
      {"TimeInMinutes", Wrong::clock, scaled({"time"}, 1. / 60),
       "bad.csv: time: a sample follows another after 1.7e-05 s; expected at least 10 and at most 50000 samples a "
       "second; it looks like a time in minutes; read it with --column time=time,scale=60"},
      {"NineRowsASecond", Wrong::clock, scaled({"time"}, 110),
       "bad.csv: time: a sample follows another after 0.11 s; expected at least 10 and at most 50000 samples a "
       "second; give the times in s, or a record with at least 10 samples a second"},
      {"MotorInDegrees", Wrong::motion, scaled({"motor_position_1"}, 180 / std::numbers::pi),
       "bad.csv: motor_position_1: joint 1 moves 0.01747 times as far as motor 1 says (slope; expected 1 within "
       "a factor of 1.5), as if it were degrees; read it with --column motor_position_1=motor_position_1,unit=deg"},
      {"SwitchedOff", Wrong::motion, scaled(kMotorColumns, 0),
       "bad.csv: motor_position_1: no motor moves and no torque is commanded, as of a robot that is switched "
       "off: there is nothing to learn from; expected a motion; give a record in which the motors move; if they "
       "did, give the columns of their encoders, such as --column motor_position_1=NAME"},
      {"MotorReversed", Wrong::motion, scaled({"motor_position_1"}, -1),
       "bad.csv: motor_position_1: is reversed: joint 1 moves against its motor (slope -1, expected 1), and "
       "joint_position_1 is within the joint's range; read it with --column "
       "motor_position_1=motor_position_1,sign=-1"},
      {"JointReversed", Wrong::motion, scaled({"joint_position_2"}, -1),
       "bad.csv: joint_position_2: is reversed: joint 2 moves against its motor (slope -1, expected 1), and "
       "motor_position_2 is within the joint's range; read it with --column "
       "joint_position_2=joint_position_2,sign=-1"},
      {"MotorFreezes", Wrong::motion, frozen("motor_position_1", 1000),
       "bad.csv: motor_position_1: stands still for 2 s while the joint moves, longest from 1 to 3 s; expected "
       "the angle of the motor; give the column of this motor's encoder, or a record in which it works"},
      {"MotorsSwapped", Wrong::motion, put("motor_position_2,motor_position_3", "motor_position_3,motor_position_2"),
       "bad.csv: motor_position_2: seems to be exchanged with motor_position_3: joint 2's reading follows motor 3, and "
       "the reverse; expected its own motor; exchange them with --column motor_position_2=motor_position_3 --column "
       "motor_position_3=motor_position_2"},
      {"MotorsInACircle", Wrong::motion,
       put("motor_position_1,motor_position_2,motor_position_3", "motor_position_2,motor_position_3,motor_position_1"),
       "bad.csv: motor_position_1: seems to be exchanged in a circle with motor_position_2, motor_position_3: joint "
       "1's "
       "reading follows motor 2, joint 2's motor 3, joint 3's motor 1; expected its own motor; exchange them with "
       "--column motor_position_1=motor_position_2 --column motor_position_2=motor_position_3 --column "
       "motor_position_3=motor_position_1"},
      {"MotorForItsJoint", Wrong::motion, exchanged("motor_position_1", "joint_position_1"),
       "bad.csv: motor_position_1: seems to be exchanged with joint_position_1: once exchanged, joint 1's reading "
       "follows its motor; as they are, it does not; exchange them with --column motor_position_1=joint_position_1 "
       "--column joint_position_1=motor_position_1"},
      {"TorqueForItsMotor", Wrong::motion, exchanged("motor_position_2", "motor_torque_2"),
       "bad.csv: motor_position_2: seems to be exchanged with motor_torque_2: once exchanged, joint 2's reading "
       "follows "
       "its motor; as they are, it does not; exchange them with --column motor_position_2=motor_torque_2 --column "
       "motor_torque_2=motor_position_2"},
      {"MotorWraps", Wrong::motion,
       changed({"motor_position_1"},
               [](int, double x) { return x - 2 * std::numbers::pi * std::floor(x / (2 * std::numbers::pi)); }),
       "bad.csv: motor_position_1: starts again after 1 turn; expected a continuous position; unwrap it with --column "
       "motor_position_1=motor_position_1,wrap=6.28318530718"},
      {"TorqueOf1e6", Wrong::motion, single("motor_torque_1", 60, 1e6),
       "bad.csv:62: motor_torque_1: 1e+06 N m at 0.06 s; 95 % of the torques are below 0.0325 N m; correct this "
       "cell, or leave it empty"},
  };
}

}  // namespace halyard::testing_program
