#include "app/log_input.h"

namespace halyard {

Log read_log_of(const ArmModel& model, const std::filesystem::path& path,
                const std::vector<std::string>& column_entries, bool torque_required) {
  ColumnMap given;
  for (const std::string& entry : column_entries) given.add_entry(entry);
  ColumnMap map = model.columns;
  map.override_with(given);
  return read_log(path, model.n(), map, {.torque_required = torque_required});
}

std::string ignored_columns_note(const Log& log) {
  std::string names;
  for (const std::string& name : log.ignored_columns) names.append(names.empty() ? "" : ", ").append(name);
  return names.empty() ? "" : "note: " + log.source + ": columns that are not used: " + names;
}

}  // namespace halyard
