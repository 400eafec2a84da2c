#pragma once
/// Reads a log with the column map and the encoder zeros of its arm's model.

#include <filesystem>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// The model's column map with the entries of --column in place of its own.
ColumnMap columns_of(const ArmModel& model, const std::vector<std::string>& column_entries);

/// Reads a log of the model's arm with the model's column map. If the model does not know an encoder's zero, estimates
/// the zero from the log and subtracts it (homing.h).
/// column_entries, NAME=COLUMN[,unit=U][,sign=-1][,scale=S][,offset=O], replace entries of the model's map.
/// torque_required: every joint with a motor needs its motor_torque_k.
/// Throws InputError as ColumnMap::add_entry(), read_log() and home_encoders() do.
Log read_log_of(const ArmModel& model, const std::filesystem::path& path,
                const std::vector<std::string>& column_entries = {}, bool torque_required = true);

/// "note: log.csv: columns that are not used: a, b"; empty if all are used.
std::string ignored_columns_note(const Log& log);

/// "note: log.csv: has no motor_torque_2: nothing is compared with the torques of these motors"; empty if it has all.
std::string missing_torques_note(const Log& log, const ArmModel& model);

}  // namespace halyard
