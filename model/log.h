#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "model/column_map.h"

namespace halyard {

/// One signal of all joints: [n_joints] vectors of [n_samples]. An empty inner vector means that the record lacks the
/// column; NaN is a missing sample.
using Signals = std::vector<std::vector<double>>;

/// One record of an arm. Joints are numbered from 0 here and from 1 in the names of columns.
///
///   member           column of a file          unit
///   time             time                      s, strictly increasing, gaps allowed
///   motor_torque     motor_torque_k            N·m at the motor shaft, absent at a joint without a motor
///   motor_position   motor_position_k          rad at the motor shaft, absent at a joint without a motor
///   joint_position   joint_position_k          rad | m
///   joint_velocity   joint_velocity_k          rad/s | m/s
///   joint_torque     joint_torque_k            N·m | N, external load on the joint
///   marker           marker_x, _y, _z          m, base frame; all three or none
struct Log {
  Log() = default;
  /// A log without samples; every column absent.
  explicit Log(int joints)
      : n_joints(joints),
        motor_torque(joints),
        motor_position(joints),
        joint_position(joints),
        joint_velocity(joints),
        joint_torque(joints),
        marker(kMarkerNames.size()) {}

  int n_joints = 0;
  std::vector<double> time;
  double clock_start = 0;  ///< subtracted from the file's times, s: see read_log
  Signals motor_torque, motor_position, joint_position, joint_velocity, joint_torque;
  Signals marker;                            ///< x, y, z
  std::vector<std::string> ignored_columns;  ///< columns of the file that are not in this log, in the file's order
  std::string source;                        ///< path as given to read_log, for messages

  std::size_t size() const { return time.size(); }
  /// Last time minus first time, s; 0 without samples.
  double duration() const { return time.empty() ? 0 : time.back() - time.front(); }

  /// Whether the record has the column of joint k = 0..n_joints-1. Throws std::out_of_range for any other k.
  bool has_motor_torque(int k) const { return !motor_torque.at(k).empty(); }
  bool has_joint_position(int k) const { return !joint_position.at(k).empty(); }
  bool has_marker() const { return !marker.empty() && !marker[0].empty(); }
};

/// Calls visit(name, values) for the column of every signal, joint and axis, absent ones too, in the order of the
/// table.
template <class AnyLog, class Visit>
void for_each_column(AnyLog& log, Visit visit) {
  constexpr std::array kSignals = {&Log::motor_torque, &Log::motor_position, &Log::joint_position, &Log::joint_velocity,
                                   &Log::joint_torque};
  static_assert(kSignals.size() == kSignalNames.size());
  for (std::size_t s = 0; s < kSignals.size(); ++s) {
    for (int k = 0; k < log.n_joints; ++k) {
      visit(std::string(kSignalNames[s]) + "_" + std::to_string(k + 1), (log.*kSignals[s]).at(k));
    }
  }
  for (std::size_t i = 0; i < log.marker.size(); ++i) visit(std::string(kMarkerNames[i]), log.marker[i]);
}

struct ReadOptions {
  bool torque_required = true;          ///< require motor_torque_k of every joint with a motor
  std::vector<int> without_motor = {};  ///< 0-based joints whose motor_torque_k and motor_position_k are not read
};

/// Reads a CSV file: UTF-8, one header row, commas, `#` starts a comment line, an empty cell is a missing sample. A
/// byte-order mark, carriage returns, blank lines and a missing last line break are accepted. Columns that are neither
/// standard nor mapped are not parsed. An optional column without any sample counts as absent. If the first time is
/// more than 100 s from zero, like a Unix time, times are counted from the first sample.
///
/// Throws InputError `file:line: what; remedy` for a file that is missing, unreadable, empty, without samples or not
/// text; a required or mapped column, or one axis of the marker, that is absent; a column that appears twice; a
/// required column without any sample; a mapped joint beyond n_joints; a row with more or fewer cells than the header;
/// a cell that is not a finite number, or beyond 1e50 in SI units; a time that is missing or does not increase.
/// Throws std::invalid_argument if n_joints < 1.
Log read_log(const std::filesystem::path& path, int n_joints, const ColumnMap& map = {},
             const ReadOptions& options = {});

/// The names of a file's columns, read as read_log() does; none if the file has no header. Throws InputError as it
/// does.
std::vector<std::string> column_names(const std::filesystem::path& path);

/// The line of the file log.source that holds a sample, as an editor counts; 0 if it cannot be told.
std::size_t line_of_sample(const Log& log, std::size_t sample);

/// The text of a log's file: the columns that the log has, in the order of the table above, time on the clock of the
/// log's file (clock_start) with up to 6 decimals, other values with 9 significant digits. Each line of `comment`
/// becomes a comment line at the top.
///
/// Throws std::invalid_argument for a column whose length differs from that of time, for an infinite value, or for
/// times that do not increase after rounding to 6 decimals.
std::string log_csv(const Log& log, const std::string& comment = "");

/// Writes log_csv() as a file that is complete or absent. Throws as log_csv() and write_file_whole() do.
void write_log(const std::filesystem::path& path, const Log& log, const std::string& comment = "");

/// The samples begin..end-1 of a log. If there are none, every column of the result is absent. Throws std::out_of_range
/// unless begin <= end <= log.size().
Log slice(const Log& log, std::size_t begin, std::size_t end);

/// Splits a log in time: the part before `fraction` of its duration, and the rest. The log must have a sample.
std::pair<Log, Log> split_log(const Log& log, double fraction);

}  // namespace halyard
