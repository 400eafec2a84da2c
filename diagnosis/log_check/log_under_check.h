#pragma once
/// The check's own copy of a log, its findings so far, and the remedies that it proposes.

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/log_check/log_check.h"

namespace halyard {

/// A log on a uniform time grid of at most some thousand points; NaN in holes.
struct SampledMotion {
  double step = 0;           ///< s
  std::vector<double> time;  ///< s
  Signals expected;          ///< joint readings that the motors give without stretch; empty: no motor
  Signals own;               ///< the part of expected that the joint's own motor gives; the rest is coupling
  Signals joint;             ///< joint readings; empty: no sensor
};
SampledMotion sampled_motion(const Log& log, const ArmModel& model);

/// Value in SI units = factor · (value in the log) + offset. unit_factor multiplies the raw value beforehand, and
/// leaves the offset of the column's map, which is in SI units, as it is.
struct Correction {
  double factor = 1, offset = 0;
  double unit_factor = 1;
};

/// A unit that a column may be in by mistake.
struct UnitGuess {
  std::string name;   ///< as --column knows it; empty: it has no name there
  double factor = 1;  ///< SI unit per unit
  std::string what;   ///< "degrees"
};

/// "motor_position_2" of Log::motor_position and k = 1.
std::string column_name(Signals Log::*signal, int k);

/// A column of a log, by the signal and the joint that it stands for.
struct ColumnPlace {
  Signals Log::*signal;
  int k;
  std::string name() const { return column_name(signal, k); }
};
/// Columns that are exchanged: each takes the values behind the next one, and the last those behind the first.
using ColumnCircle = std::vector<ColumnPlace>;

class LogUnderCheck {
 public:
  LogUnderCheck(const Log& log, const ArmModel& model, const ColumnMap& columns, const LogCheckRule& rule)
      : log(log), model(model), rule(rule), sources_(columns.sources()) {}

  Log log;  ///< corrected as errors are found
  const ArmModel& model;
  const LogCheckRule& rule;
  std::vector<LogFinding> findings;

  int n() const { return log.n_joints; }
  bool is_driven(int k) const { return model.nominal.joint[k].drive != Drive::none; }
  double range(int k) const { return model.joints[k].upper - model.joints[k].lower; }
  /// Expected reading of joint k per reading of motor k.
  double joint_per_motor(int k) const;

  void suspect(const std::string& column, const std::string& what, const std::string& remedy) {
    findings.push_back({log.source, column, what, remedy, LogFinding::Severity::suspicious});
  }
  void reject(const std::string& column, const std::string& what, const std::string& remedy) {
    findings.push_back({log.source, column, what, remedy, LogFinding::Severity::gross});
  }
  bool has_gross() const;
  bool has_finding(const std::string& column) const;
  /// How implausible a position is in joint k's range; 0 if it is within the range. Adds 1 for each range by which its
  /// motion is wider. If its zero is known, adds 1 for each range by which its median lies outside.
  double beyond_range(int k, const std::vector<double>& position, bool zero_known) const;

  /// "--column joint_position_2=q2,unit=deg": reads the column with the correction on top of its map and of the
  /// corrections so far.
  std::string option(const std::string& column, const Correction& correction) const;
  /// Reads the column as one that starts again after a period, in the column's SI unit.
  std::string wrap_option(const std::string& column, double period) const;
  /// SI unit per raw unit according to the column's map, without the sign.
  double scale_of(const std::string& column) const { return std::abs(source_of(column).scale); }
  /// What is added to the column according to its map and to the corrections so far, in its SI unit.
  double offset_of(const std::string& column) const { return source_of(column).offset; }
  /// Period after which the column starts again according to its map, in its SI unit; 0: none.
  double wrap_of(const std::string& column) const;
  /// Whether the column's map has it in A or V, without a scale.
  bool is_electric(const std::string& column) const { return !source_of(column).electric_unit.empty(); }
  /// "0.7854 rad (45 deg)", "0.1 m" of a position of joint k.
  std::string position(int k, double value) const;
  /// "0 to 1.571 rad (0 to 90 deg)"
  std::string range_in_words(int k) const;
  /// Options that exchange the columns of the file behind the standard columns of a circle.
  std::string exchange_options(const ColumnCircle& circle) const;

  void correct(Signals Log::*signal, int k, const Correction& correction);
  /// Exchanges the raw values behind the columns of a circle. Each column keeps its own scale and offset; a period
  /// belongs to the values.
  void exchange(const ColumnCircle& circle);

 private:
  ColumnSource source_of(const std::string& column) const;
  /// The sources of the columns of a circle after their exchange.
  std::vector<ColumnSource> exchanged(const ColumnCircle& circle) const;
  ColumnSource corrected(const std::string& column, const Correction& correction) const;
  std::string option(const std::string& column, const ColumnSource& source) const;

  std::map<std::string, ColumnSource, std::less<>> sources_;  ///< with the corrections so far
};

/// Units of a joint's or a motor's position. Encoder counts are among them only if the model states the encoder's
/// resolution.
std::vector<UnitGuess> position_units(bool prismatic, double resolution);

}  // namespace halyard
