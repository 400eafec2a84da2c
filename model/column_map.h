#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halyard {

/// The standard columns of a log are `time` and, for joints k = 1..n, each of these names followed by `_k`.
inline constexpr std::array<std::string_view, 5> kSignalNames = {"motor_torque", "motor_position", "joint_position",
                                                                 "joint_velocity", "joint_torque"};

/// Columns of the whole arm: position of a marker at the tool, measured by a camera, m in the base frame.
inline constexpr std::array<std::string_view, 3> kMarkerNames = {"marker_x", "marker_y", "marker_z"};

/// Where a standard column comes from: SI value = scale · (raw + wrap · laps) + offset.
///
/// A counter or an absolute encoder starts again after a period. From one sample that is not missing to the next,
/// `laps` changes such that the value moves by at most half a period.
struct ColumnSource {
  std::string column;              ///< name in the header of the file; empty: the log has no such column
  double scale = 1;                ///< SI unit per raw unit: unit, sign and scale in one factor, never zero
  double offset = 0;               ///< SI unit (s, rad or m, rad/s or m/s, N·m or N)
  double wrap = 0;                 ///< period of a position, in raw units; 0: the column is continuous
  std::string electric_unit = "";  ///< of a current or voltage without a scale to N m, such as "mA"
};

/// Maps columns of a foreign log, and their units, to the standard columns. Several standard columns may come from one
/// column of the file. Standard columns that the map does not name keep their own name.
///
///   time              s, ms, us
///   *_position_k, marker_*   rad, deg, turn, m, mm, um
///   *_velocity_k      rad/s, deg/s, rpm, m/s, mm/s
///   *_torque_k        N.m, mN.m, N.mm, N; A, mA, V, mV. Currents and voltages need a scale in N m per A
///                     or V, here or as the model's torque_scale
///
/// An empty unit is the SI unit. Angle and length units are interchangeable, and so are torque and force units, because
/// a scale may convert one into the other (a linear motor, a spindle).
class ColumnMap {
 public:
  /// SI value = sign · scale · unit · (raw + wrap · laps) + offset, with the offset in SI units and `wrap` in those of
  /// the file.
  /// Throws InputError, without file and line, for a name that is no standard column or is already mapped, an empty
  /// column, a unit that is unknown or of another quantity, a sign other than 1 or -1, a scale of zero, a number that
  /// is not finite, or a period that is negative or belongs to no position.
  void add(std::string_view name, std::string_view column, std::string_view unit = "", double sign = 1,
           double scale = 1, double offset = 0, double wrap = 0);

  /// States that the log has no such column. Throws InputError as add() does, and for `time` and a motor's position,
  /// which every log has.
  void leave_out(std::string_view name);

  /// Adds one command-line entry; all but NAME=COLUMN is optional. Without COLUMN it is left out:
  ///   motor_torque_1=capstan_torque_1_Nm,unit=N.m,sign=-1,scale=0.0816,offset=0.1
  ///   motor_position_1=angle_deg,unit=deg,wrap=360
  ///   joint_position_1=
  /// Throws InputError where add() and leave_out() do, and if the text does not have this form. The message quotes the
  /// entry.
  void add_entry(std::string_view entry);

  /// Adds all sources of `other`. If both maps name a standard column, the source in `other` replaces the source in
  /// this map.
  void override_with(const ColumnMap& other);

  /// Throws InputError if the map names a joint beyond n_joints.
  void check_joints(int n_joints) const;

  /// Sources by standard name. Adding each one with its `scale`, `offset` and `wrap` and an empty unit gives the same
  /// map; one with an electric unit is added with this unit and the sign of its scale instead.
  const std::map<std::string, ColumnSource, std::less<>>& sources() const { return sources_; }

 private:
  void insert(std::string_view name, const ColumnSource& source);

  std::map<std::string, ColumnSource, std::less<>> sources_;
};

}  // namespace halyard
