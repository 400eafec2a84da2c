#pragma once
/// A log as another arm would have given it that had moved its motors in the same way: what a rehearsal diagnoses.
///
///   x'(t) = x(t) - r(t; truth) + r(t'; found)
///
///   x   reading of a joint, or torque of a motor
///   r   what a hypothesis leaves of the log, in the band and on the grid of the fits, but not smoothed: the reading
///       minus the predicted one, or the torque residual (prediction.h)
///   t'  t, moved by a random time that is the same for all signals of the log
///
/// So the noise of the rehearsed log is what the found model leaves of the real one, with its spectrum, at other times:
/// it has nothing in common with the motion any more. A torque at rest keeps its own residual, because static friction
/// can have any value there. Motor positions, loads, missing cells and a sensor's lateness are those of the log.

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

  const std::vector<Record>& records() const { return records_; }

 private:
  /// A row of the log that has a reading, and where it lies in a record, in steps of its grid.
  struct Row {
    std::size_t row, record;
    double place;
    bool is_moved;  ///< it gets the residual of another row
  };
  /// A column of the log that is made anew.
  struct Column {
    Signals Log::*signal;
    int joint;
    std::vector<Row> rows = {};
  };

  Column column_of(Signals Log::*signal, int joint, double late, double motor_smoothing) const;
  double residual(const Column& column, const Row& row, const std::vector<FullPrediction>& by) const;

  Log log_;
  std::vector<Record> records_;
  std::vector<FullPrediction> found_;
  std::vector<Column> columns_;
};

/// The records of a log as the fits see them, but not smoothed, and predicted everywhere from the first row on, also
/// between the readings of a slow sensor.
std::vector<Record> rehearsal_records(const Log& log, const ArmModel& model);

}  // namespace halyard
