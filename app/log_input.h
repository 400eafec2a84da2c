#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/input_error.h"
#include "model/log.h"

namespace halyard {

/// Reads a log that an estimator or an identification runs over. Throws InputError as read_log_of() does, and for times
/// that are not in seconds.
Log read_timed_log(const ArmModel& model, const std::filesystem::path& path,
                   const std::vector<std::string>& column_entries, bool torque_required = true);

/// Whether one of the estimators uses the torques of the motors; `kinematics` does not.
bool need_torque(const std::vector<std::string>& estimators);

/// For --use-joint-torque: throws InputError if the log has no measured load.
void check_has_load(const Log& log);

/// Throws InputError if a log occurs twice in --data and --holdout, because it would then count as twice the evidence.
void check_given_once(const std::vector<std::filesystem::path>& logs);

/// After a failure on a log: the first gross error that the check of the log finds (diagnosis/log_check/log_check.h),
/// and behind it the failure. Nothing if the check finds none: then the log does not explain the failure.
std::optional<std::string> explained_by_log(const std::string& failure, const std::vector<Log>& logs,
                                            const ArmModel& model, const std::vector<std::string>& column_entries);

/// "LOG: joint_position_1: ...", a line for each gross error that the check of the log finds. An estimator runs over
/// such a log all the same, and its result means nothing.
std::vector<std::string> gross_errors(const Log& log, const ArmModel& model,
                                      const std::vector<std::string>& column_entries);

/// What `run` returns. If it fails and an error of the logs explains that, throws InputError with that error.
template <class Run>
auto blaming_wrong_logs(const std::vector<Log>& logs, const ArmModel& model,
                        const std::vector<std::string>& column_entries, const Run& run) {
  try {
    return run();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    if (const auto why = explained_by_log(error.what(), logs, model, column_entries)) throw InputError(*why);
    throw;
  }
}

}  // namespace halyard
