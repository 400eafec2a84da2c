#include "diagnosis/log_check/usable_logs.h"

#include <fmt/format.h>

#include "diagnosis/log_check/own_readings.h"

namespace halyard {
namespace {

LogFinding finding_of(const Log& log, const RepeatedReadings& r) {
  return {log.source, fmt::format("{}_position_{}", r.signal == &Log::motor_position ? "motor" : "joint", r.joint + 1),
          fmt::format("repeats each reading until the next one, {:.3g} ms later", 1e3 * r.interval),
          "nothing to do: the diagnosis has left the repeated ones out", LogFinding::Severity::corrected};
}

}  // namespace

UsableLogs usable_logs(const ArmModel& model, std::vector<Log> training, std::optional<Log> holdout,
                       const ColumnMap& columns) {
  UsableLogs usable{std::move(training), std::move(holdout), {}};
  std::vector<Log*> logs;
  for (Log& log : usable.training) logs.push_back(&log);
  if (usable.holdout) logs.push_back(&*usable.holdout);
  for (const Log* log : logs)
    for (LogFinding& finding : check_log(*log, model, columns)) usable.findings.push_back(std::move(finding));
  stop_at_gross_finding(usable.findings);
  for (Log* log : logs) {
    for (const RepeatedReadings& r : keep_own_readings(*log, model)) usable.findings.push_back(finding_of(*log, r));
    *log = without_outliers(std::move(*log));
  }
  return usable;
}

}  // namespace halyard
