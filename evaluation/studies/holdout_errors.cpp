#include "evaluation/studies/holdout_errors.h"

#include <algorithm>
#include <exception>

#include "evaluation/judgement/error_statistics.h"
#include "evaluation/run/sensor_readings.h"
#include "model/homing.h"

namespace halyard {
namespace {

constexpr double kSkip = 0.5;  ///< s; a filter's start is not counted

}  // namespace

EstimatorErrors errors_of(const std::string& name, const ArmModel& model, const std::vector<HeldOutLog>& logs,
                          const ContainmentOptions& containment) {
  const auto n = static_cast<std::size_t>(model.n());
  EstimatorErrors result;
  result.innovation.resize(n);
  result.joint_rate.resize(n);
  Signals estimate(n), truth(n);
  std::vector<double> nis;
  try {
    for (const auto& [held, from] : logs) {
      Log log = *held;
      home_encoders(log, model);  // unknown zeros are those that this model gives
      const EstimatorRun run = run_contained(name, model, log, {.use_joint_torque = true}, containment);
      const Signals readings = sensor_readings(model, run);
      const std::size_t first = first_counted_sample(log.time, std::max(kSkip, from - log.time.front()));
      const auto append = [first](const std::vector<double>& from, std::vector<double>& to) {
        to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
      };
      append(log.time, result.time);
      append(run.nis, nis);
      for (std::size_t k = 0; k < n; ++k) {
        append(run.innovation[k], result.innovation[k]);
        append(run.estimates.joint_velocity[k], result.joint_rate[k]);
        if (log.joint_position[k].empty()) continue;
        append(readings[k], estimate[k]);
        append(log.joint_position[k], truth[k]);
      }
    }
  } catch (const std::exception& e) {
    EstimatorErrors failed;
    failed.failure = e.what();
    return failed;
  }
  result.mean_nis = mean_of(nis);
  for (std::size_t k = 0; k < n; ++k) {
    const ErrorStatistics error = error_statistics(estimate[k], truth[k]);
    result.rms.push_back(error.rms);
    result.peak.push_back(error.peak);
  }
  return result;
}

}  // namespace halyard
