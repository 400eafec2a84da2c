#include "app/log_input.h"

#include <algorithm>

#include "diagnosis/log_check/clock_check.h"
#include "model/arm_log.h"

namespace halyard {

Log read_timed_log(const ArmModel& model, const std::filesystem::path& path,
                   const std::vector<std::string>& column_entries, bool torque_required) {
  Log log = read_log_of(model, path, column_entries, torque_required);
  stop_at_gross_finding(check_times(log, model, columns_of(model, column_entries)));
  return log;
}

bool need_torque(const std::vector<std::string>& estimators) {
  return std::ranges::any_of(estimators, [](const std::string& name) { return name != "kinematics"; });
}

void check_has_load(const Log& log) {
  if (std::ranges::all_of(log.joint_torque, [](const auto& column) { return column.empty(); }))
    throw InputError(log.source +
                     ": has no column joint_torque_k for --use-joint-torque; leave the option out, or say "
                     "which column of the file it is by --column joint_torque_1=NAME");
}

void check_given_once(const std::vector<std::filesystem::path>& logs) {
  for (std::size_t i = 0; i < logs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (std::filesystem::equivalent(logs[i], logs[j], error) && !error)
        throw InputError(logs[i].string() + ": is given twice among --data and --holdout; give each log once");
    }
}

std::optional<std::string> explained_by_log(const std::string& failure, const std::vector<Log>& logs,
                                            const ArmModel& model, const std::vector<std::string>& column_entries) {
  const ColumnMap columns = columns_of(model, column_entries);
  for (const Log& log : logs)
    for (const LogFinding& finding : check_log(log, model, columns))
      if (finding.severity == LogFinding::Severity::gross && !finding.stands_still)
        return finding_line(finding) + " (" + failure + ")";
  return std::nullopt;
}

std::vector<std::string> gross_errors(const Log& log, const ArmModel& model,
                                      const std::vector<std::string>& column_entries) {
  std::vector<std::string> lines;
  for (const LogFinding& finding : check_log(log, model, columns_of(model, column_entries)))
    if (finding.severity == LogFinding::Severity::gross && !finding.stands_still)
      lines.push_back(finding_line(finding));
  return lines;
}

}  // namespace halyard
