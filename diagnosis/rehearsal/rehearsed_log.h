#pragma once
/// A log as another arm would have given it that had moved its motors in the same way: what a rehearsal diagnoses.
///
///   x'(t) = x(t) - r(t; truth) + r(t'; found)
///
///   x   reading of a joint, or torque of a motor
///   r   what a hypothesis leaves of the log, in the band and on the grid of the fits, but not smoothed: the reading
///       minus the predicted one, or the torque residual (prediction.h)
///   t'  another time: the rows of each signal are moved on, by a random share of the log that is the same for all
///
/// So the noise of the rehearsed log is what the found model leaves of the real one, with its spectrum, at other times:
/// it has nothing in common with the motion any more. A torque at rest keeps its own residual, because static friction
/// can have any value there. Motor positions, loads, missing cells and a sensor's lateness are those of the log. Cells
/// at the ends of a record, where the filter of the motion makes things up, are left out.

#include "diagnosis/prediction/prediction.h"
#include "diagnosis/rehearsal/random.h"

namespace halyard {

class LoggedMotion {
 public:
  /// records: rehearsal_records() of the log, with their places and clocks. late: of its slow sensors, s. found: what
  /// the diagnosis found.
  LoggedMotion(Log log, std::vector<Record> records, double late, const ArmModel& model, const Hypothesis& found);

  /// Throws InputError if an arm with this truth cannot be integrated along the motion.
  Log as_of(const Hypothesis& truth, Random& random) const;
  /// The same with slow sensors that are not late.
  Log on_time_as_of(const Hypothesis& truth, Random& random) const;

  const std::vector<Record>& records() const { return records_; }

 private:
  /// A row of the log that has a reading, and where it lies in a record, in steps of its grid.
  struct Row {
    std::size_t row, record;
    double steps;
    bool is_moved;  ///< it gets the residual of another row
  };
  /// A column of the log that is made anew.
  struct Column {
    Signals Log::*signal;
    int joint;
    double late;        ///< s, against the record
    double resolution;  ///< to which it is rounded; 0: it is not
    std::vector<Row> rows = {};
  };

  void add(Column column, double motor_smoothing);
  Log made(const Hypothesis& truth, Random& random, bool on_time) const;
  /// later: seconds after the row's own time.
  double residual(const Column& column, const Row& row, const std::vector<FullPrediction>& of, double later) const;

  Log log_;
  std::vector<Record> records_;
  std::vector<FullPrediction> found_;
  std::vector<Column> columns_;
};

/// The records of a log as the fits see them, but predicted everywhere from the first row on, also between the readings
/// of a slow sensor.
std::vector<Record> rehearsal_records(const Log& log, const ArmModel& model);

}  // namespace halyard
