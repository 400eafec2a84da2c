#pragma once
/// Checks a log against the model of its arm before anything is concluded from it.
///
/// The check compares each joint's reading with the reading that the motors' angles give through an unstretched
/// transmission, and each motor's torque with the torque that its motion requires. An error of the log (a sign, a
/// unit, a swapped column) changes these relations by far more than any physical effect. All estimates are robust:
/// medians, and slopes that minimise the sum of absolute errors.
///
///   s   slope of the reading over the expected reading; 1 in a correct log       1
///   w   share of the reading's motion that s times the expected motion explains, 1 - Σ|Δq - s Δp| / Σ|Δq|
///   r   correlation of the recorded torque with the required torque while the motor moves

#include <string>
#include <vector>

#include "diagnosis/log_check/outliers.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// An error of a log, or what looks like one.
struct LogFinding {
  enum class Severity {
    corrected,   ///< an error that the diagnosis measures and takes out; there is nothing to do
    suspicious,  ///< may be an effect of the arm as well; a diagnosis continues
    gross,       ///< an error of the log; a diagnosis would be meaningless
  };
  std::string log;     ///< path of the log
  std::string column;  ///< standard name of the column, such as motor_position_2, or time
  std::string what;    ///< observation and expectation
  std::string remedy;  ///< option or model attribute that corrects it
  Severity severity = Severity::suspicious;
  std::size_t line = 0;       ///< of the file, if the error is in one line
  bool stands_still = false;  ///< the numbers may be right, but there is nothing to learn from them
};

/// Thresholds of the check.
struct LogCheckRule {
  /// Least motion of a joint from which a conclusion is drawn, as a share of its range. The same share as in
  /// stuck_joint_sensors(): rounding, backlash and stretch are well below it.
  double least_motion = 0.05;
  /// Least w for a conclusion from a slope. Two unrelated motions have w below 0.3; backlash of a fifth of the motion
  /// leaves 0.6.
  double explained = 0.5;
  /// w below which a joint does not follow its motor. Every effect leaves more.
  double unrelated = 0.15;
  /// Least w of a swapped column after it is put in its right place. The swap removes the whole mismatch; 0.8 leaves a
  /// margin for effects.
  double explained_by_swap = 0.8;
  /// A slope in 1/ratio..ratio may be an effect. Capstans wear by some 10 %, and model tolerances of lengths reach 5 %;
  /// the closest unit is 2π away.
  double ratio = 1.5;
  /// Unknown ratios beyond this factor are gross: no transmission deviates that much from its model.
  double gross_ratio = 3;
  /// No ratio of a drive is wrong by more than this factor: it is that between a unit and its thousandth, and gears
  /// reach some 300. Beyond it the column is another one, and a scale would hide that.
  double most_ratio = 1000;
  /// A wrong unit explains a slope that is within this factor of the slope which that unit would give. The margin is
  /// wider than the change by an effect, and far below the factor between two units.
  double unit = 1.25;
  /// r below which a torque opposes the motion. Friction makes r positive in every arm that moves.
  double torque_opposes = -0.5;
  /// Least r for a conclusion from a torque's size, and for a swapped torque in its right place.
  double torque_goes_with = 0.7;
  /// Two torques are swapped if two conditions hold for each of them. After the exchange, its unexplained share of the
  /// variance, 1 - r², is at most swap_leaves times the one before; and its r before was at most own_torque. Joints
  /// that move together have torques that resemble each other.
  double swap_leaves = 0.25, own_torque = 0.9;
  /// A torque's size may deviate by this factor because of effects: friction times three and a payload together.
  double torque_ratio = 6;
  /// A unit explains the size of a torque within this factor; effects change the size as well. A motor that saturates
  /// explains it if it does so better than every factor within this one (saturating_torque.h), by a log-likelihood of
  /// significance² / 2.
  double torque_unit = 2.5;
  /// Samples further apart than this count as independent, s. The same time as in the diagnosis' tests.
  double independent_s = 0.25;
  /// A correlation is significant beyond this many standard deviations of chance.
  double significance = 4;
  /// Share of the range by which a position may lie outside its range, and by which a zero may be off. A zero that is
  /// off by more than the effect encoder_offset reaches is told, however wide the range is.
  double outside = 0.25, zero = 0.5;
  /// Slowest and fastest plausible sample rate, Hz. Records need 10 Hz.
  double slowest_hz = 10, fastest_hz = 50e3;
  /// Most samples a second that the controller of an arm takes; its current loops may be faster.
  double controller_hz = 10e3;
  /// Width of the central 90 % of the sample intervals, relative to the median, that counts as jitter.
  double jitter = 0.3;
  /// An interval longer than this many median intervals is a gap and no jitter.
  double gap = 2.5;
  /// Across more median intervals of a column than this, a step is no lap of a counter: the joint may have moved by any
  /// way. Reason: above `gap`, so that a sensor that loses two readings in a row still shows its laps.
  double lap_within = 4;
  /// Share of all rows from which on missing rows are reported.
  double missing = 1e-3;
  /// A column is late if it is late by more than this many of its own sample intervals, and by more than late_s. Cables
  /// and gears delay a joint by a few ms.
  double late_samples = 3, late_s = 6e-3;
  /// Share of the squared mismatch that a shift in time must remove before it is called late. Backlash and hysteresis
  /// resemble a delay, but a shift removes at most 80 % of them.
  double late_explains = 0.9;
  /// A step from one sample to the next is a jump if its rate exceeds this many times the 99th percentile.
  double jump = 20;
  OutlierRule outlier;
  /// A torque beyond this many times the 95th percentile of its column is a wrong number: no motor has such a peak.
  double torque_spike = 1000;
  /// A torque that stays at exactly its largest value for this share of the samples is clipped.
  double clipped = 0.01;
  /// The largest torques are at the model's torque_limit within this share of it: sensors of current err by about 1 %,
  /// and the largest of many readings by three to four times as much.
  double at_limit = 0.05;
};

/// Findings about a log, the most fundamental first. A gross finding about the clock or a counter ends the
/// check, because later checks would only repeat it. A column that is found wrong is corrected in the check's own copy
/// before the next column is compared, so that one error is one finding.
///
/// columns: the map with which the log was read; remedies repeat its scales and offsets.
/// Throws InputError as home_encoders() does.
std::vector<LogFinding> check_log(const Log& log, const ArmModel& model, const ColumnMap& columns,
                                  const LogCheckRule& rule = {});
/// For a log that was read with the model's own map.
std::vector<LogFinding> check_log(const Log& log, const ArmModel& model);

/// "corrected", "suspicious" or "gross".
const char* severity_word(LogFinding::Severity severity);

/// "log.csv: motor_position_2: what; remedy", with the line after the path if there is one.
std::string finding_line(const LogFinding& finding);

/// Throws InputError with the first gross finding, if there is one; the message says how many others there are, and
/// where they are told.
void stop_at_gross_finding(const std::vector<LogFinding>& findings,
                           const std::string& where_others = ": run halyard check on the log");

}  // namespace halyard
