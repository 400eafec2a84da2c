#include "diagnosis/log_check/log_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/exchanges/exchanges.h"
#include "model/homing.h"
#include "model/input_error.h"

namespace halyard {

std::vector<LogFinding> check_log(const Log& log, const ArmModel& model, const ColumnMap& columns,
                                  const LogCheckRule& rule) {
  LogUnderCheck c(log, model, columns, rule);
  check_clock(c);
  if (!c.has_gross()) check_length(c);
  if (c.has_gross()) return c.findings;
  home_encoders(c.log, model);
  check_torque_spikes(c);
  check_counters(c);
  if (c.has_gross()) return c.findings;
  check_exchanges_at_joints(c);
  check_position_exchanges(c);
  check_motor_exchanges(c);
  check_positions(c);
  check_columns(c);
  check_frozen_torques(c);
  check_torques(c);
  check_clipped_torques(c);
  check_zeros(c);
  check_delays(c);
  return c.findings;
}

std::vector<LogFinding> check_log(const Log& log, const ArmModel& model) {
  return check_log(log, model, model.columns);
}

const char* severity_word(LogFinding::Severity severity) {
  switch (severity) {
    case LogFinding::Severity::corrected: return "corrected";
    case LogFinding::Severity::suspicious: return "suspicious";
    case LogFinding::Severity::gross: break;
  }
  return "gross";
}

std::string finding_line(const LogFinding& f) {
  const std::string line = f.line > 0 ? fmt::format(":{}", f.line) : "";
  return fmt::format("{}{}: {}: {}; {}", f.log, line, f.column, f.what, f.remedy);
}

void stop_at_gross_finding(const std::vector<LogFinding>& findings, const std::string& where_others) {
  const auto is_gross = [](const LogFinding& f) { return f.severity == LogFinding::Severity::gross; };
  const auto first = std::ranges::find_if(findings, is_gross);
  if (first == findings.end()) return;
  const auto others = std::ranges::count_if(findings, is_gross) - 1;
  throw InputError(finding_line(*first) + (others > 0 ? fmt::format(" (and {} more{})", others, where_others) : ""));
}

}  // namespace halyard
