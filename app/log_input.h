#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Reads a log of the model's arm. Entries NAME=COLUMN[,unit=..][,sign=..][,scale=..][,offset=..] go over the model's
/// own column map. Throws InputError as ColumnMap::add_entry and read_log do.
Log read_log_of(const ArmModel& model, const std::filesystem::path& path,
                const std::vector<std::string>& column_entries, bool torque_required = true);

/// "note: log.csv: columns that are not used: a, b", or nothing.
std::string ignored_columns_note(const Log& log);

/// Throws InputError if a log stands twice among those of --data and --holdout: it would look like twice the evidence.
void check_given_once(const std::vector<std::filesystem::path>& logs);

}  // namespace halyard
