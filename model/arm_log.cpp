#include "model/arm_log.h"

#include <algorithm>
#include <cmath>

#include "model/homing.h"
#include "model/name_list.h"

namespace halyard {

ColumnMap columns_of(const ArmModel& model, const std::vector<std::string>& column_entries) {
  ColumnMap given;
  for (const std::string& entry : column_entries) given.add_entry(entry);
  ColumnMap map = model.columns;
  map.override_with(given);
  return map;
}

Log read_log_of(const ArmModel& model, const std::filesystem::path& path,
                const std::vector<std::string>& column_entries, bool torque_required) {
  const ColumnMap map = columns_of(model, column_entries);
  ReadOptions options{.torque_required = torque_required};
  for (int k = 0; k < model.n(); ++k)
    if (model.nominal.joint[k].drive == Drive::none) options.without_motor.push_back(k);
  Log log = read_log(path, model.n(), map, options);
  home_encoders(log, model);
  return log;
}

std::string ignored_columns_note(const Log& log) {
  std::vector<std::string> names;
  bool has_further_motor = false;
  for (const std::string& name : log.ignored_columns) {
    names.push_back(shortened(name));
    has_further_motor = has_further_motor || name == "motor_position_" + std::to_string(log.n_joints + 1);
  }
  if (names.empty()) return "";
  return "note: " + log.source + ": columns that are not used: " + listed(names) +
         (has_further_motor
              ? "; the model has " + std::to_string(log.n_joints) + " joints: this may be the log of another arm"
              : "");
}

std::string missing_torques_note(const Log& log, const ArmModel& model) {
  std::vector<std::string> names;
  for (int k = 0; k < model.n(); ++k)
    if (model.nominal.joint[k].drive != Drive::none &&
        std::ranges::none_of(log.motor_torque[k], [](double x) { return std::isfinite(x); }))
      names.push_back("motor_torque_" + std::to_string(k + 1));
  return names.empty() ? ""
                       : "note: " + log.source + ": has no " + listed(names) +
                             ": nothing is compared with the torques of these motors";
}

}  // namespace halyard
