#include "evaluation/run/estimate.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "estimators/log_sample.h"
#include "evaluation/csv.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The log's rows as samples, with the loads.
class Samples {
 public:
  Samples(const Log& log, bool use_joint_torque) : log_(log) {
    const auto present = [](const std::vector<double>& column) { return !column.empty(); };
    if (use_joint_torque && std::ranges::any_of(log.joint_torque, present))
      sample_.joint_torque = Eigen::VectorXd::Zero(log.n_joints);
  }

  /// Missing torques and positions stay NaN, a missing load keeps its last value.
  const Sample& at(std::size_t i) {
    read_row(log_, i, sample_);
    for (Eigen::Index k = 0; k < sample_.joint_torque.size(); ++k) {
      const std::vector<double>& load = log_.joint_torque[static_cast<std::size_t>(k)];
      if (!load.empty() && !std::isnan(load[i])) sample_.joint_torque[k] = load[i];
    }
    return sample_;
  }

  /// As at(), with a motor's last reading and torque where this row has none. A torque that never came is none.
  Sample first(std::size_t i) {
    Sample sample;
    for (std::size_t before = 0; before <= i; ++before) {
      const Sample& row = at(before);
      if (before == 0) sample = row;
      for (int k = 0; k < log_.n_joints; ++k) {
        if (!std::isnan(row.motor_position[k])) sample.motor_position[k] = row.motor_position[k];
        if (!std::isnan(row.motor_torque[k])) sample.motor_torque[k] = row.motor_torque[k];
      }
    }
    sample.time_s = log_.time[i];
    sample.joint_torque = sample_.joint_torque;
    sample.marker = sample_.marker;
    for (int k = 0; k < log_.n_joints; ++k)
      if (std::isnan(sample.motor_torque[k]) && !log_.motor_position[k].empty()) sample.motor_torque[k] = 0;
    return sample;
  }

 private:
  const Log& log_;
  Sample sample_;
};

/// The first row at which every motor has been read lately: motors may be read in different rows.
std::size_t first_row_with_all_motors(const Log& log) {
  constexpr double kOldest = 0.1;  // s
  std::vector<double> read_at(log.motor_position.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < log.size(); ++i) {
    bool all = true;
    for (std::size_t k = 0; k < read_at.size(); ++k) {
      const std::vector<double>& column = log.motor_position[k];
      if (column.empty()) continue;
      if (!std::isnan(column[i])) read_at[k] = log.time[i];
      all = all && log.time[i] - read_at[k] <= kOldest;
    }
    if (all) return i;
  }
  throw InputError(
      fmt::format("{}: at no time has every motor been read within {:g} s; give a log with such a time to start from",
                  log.source, kOldest));
}

void record(EstimatorRun& run, const Estimate& estimate, std::size_t i) {
  if (!estimate.joint_position.allFinite() || !estimate.joint_velocity.allFinite() ||
      !estimate.joint_position_std.allFinite()) {
    throw std::runtime_error("the estimate is not finite");
  }
  for (int k = 0; k < run.estimates.n_joints; ++k) {
    run.estimates.joint_position[k][i] = estimate.joint_position[k];
    run.estimates.joint_velocity[k][i] = estimate.joint_velocity[k];
    run.joint_position_std[k][i] = estimate.joint_position_std[k];
    for (std::size_t f = 0; f < run.extra_outputs.size(); ++f)
      run.extra_outputs[f][k][i] = estimate.extra_outputs(k, static_cast<Eigen::Index>(f));
  }
}

/// What the estimator has to say of samples first..last after all.
void record_revisions(EstimatorRun& run, Estimator& estimator, std::size_t first, std::size_t last, bool at_end) {
  const auto begin = run.estimates.time.begin();
  while (const std::optional<Revision> revision = estimator.revise(at_end)) {
    const auto found = std::lower_bound(begin + first, begin + last + 1, revision->time_s);
    if (found == begin + last + 1 || *found != revision->time_s)
      throw std::runtime_error(fmt::format("revises its estimate of {:.12g} s, where no sample is", revision->time_s));
    record(run, revision->estimate, static_cast<std::size_t>(found - begin));
  }
}

void record(EstimatorRun& run, const Innovation& innovation, const Log& log, std::size_t i) {
  const Eigen::VectorXd white = innovation.S_root.triangularView<Eigen::Lower>().solve(innovation.nu);
  run.nis[i] = innovation.nis() / double(innovation.nu.size());
  // Its entries belong to the motors that were read, in their order.
  Eigen::Index entry = 0;
  for (int k = 0; k < log.n_joints && entry < white.size(); ++k)
    if (!log.motor_position[k].empty() && !std::isnan(log.motor_position[k][i])) run.innovation[k][i] = white(entry++);
}

}  // namespace

double mean_of(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double v : values)
    if (!std::isnan(v)) sum += v, count += 1;
  return count > 0 ? sum / count : kNan;
}

EstimatorRun no_run(const std::string& name, const Log& log) {
  EstimatorRun run;
  run.name = name;
  run.estimates = Log(log.n_joints);
  run.estimates.time = log.time;
  run.estimates.clock_start = log.clock_start;
  run.estimates.source = log.source;
  const std::vector<double> unknown(log.size(), kNan);
  run.estimates.joint_position.assign(log.n_joints, unknown);
  run.estimates.joint_velocity.assign(log.n_joints, unknown);
  run.joint_position_std.assign(log.n_joints, unknown);
  run.nis = unknown;
  run.innovation.assign(log.n_joints, unknown);
  run.microseconds_per_step = kNan;
  return run;
}

EstimatorRun run_estimator(Estimator& estimator, const std::string& name, const Log& log,
                           const EstimateOptions& options) {
  const std::size_t start = first_row_with_all_motors(log);
  EstimatorRun run = no_run(name, log);
  run.extra_output_names = estimator.extra_output_names();
  run.extra_outputs.assign(run.extra_output_names.size(), Signals(log.n_joints, std::vector<double>(log.size(), kNan)));
  Samples samples(log, options.use_joint_torque);
  const std::size_t report_every = std::max<std::size_t>(1, log.size() / 100);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t i = start;
  const auto place = [&] {
    return fmt::format("estimator {} on {} at {:.12g} s: ", name, log.source, log.time[std::min(i, log.size() - 1)]);
  };
  try {
    estimator.reset(samples.first(start));
    record(run, estimator.estimate(), start);
    record_revisions(run, estimator, start, start, false);
    if (options.row_done) options.row_done(start);
    for (i = start + 1; i < log.size(); ++i) {
      const Innovation innovation = estimator.update(samples.at(i));
      record(run, estimator.estimate(), i);
      record_revisions(run, estimator, start, i, false);
      // An estimator without a covariance has no innovation to judge.
      if (innovation.nu.size() > 0 && innovation.S_root.size() > 0) record(run, innovation, log, i);
      if (options.row_done) options.row_done(i);
      if (options.progress && i % report_every == 0) options.progress(double(i) / double(log.size()));
    }
    record_revisions(run, estimator, start, log.size() - 1, true);
  } catch (const InputError& error) {
    throw EstimatorRefusal(place() + "refused: " + error.what());
  } catch (const std::bad_alloc&) {
    throw;  // a fault of the machine, not of the estimator
  } catch (const std::exception& error) {
    throw std::runtime_error(place() + error.what());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.microseconds_per_step = 1e6 * seconds / double(log.size() - start);
  run.report = estimator.report();
  return run;
}

void write_estimates(const std::filesystem::path& path, const EstimatorRun& run, const std::string& comment) {
  const int n = run.estimates.n_joints;
  std::vector<std::string> names = {"joint_position", "joint_velocity", "joint_position_std"};
  std::vector<const Signals*> signals = {&run.estimates.joint_position, &run.estimates.joint_velocity,
                                         &run.joint_position_std};
  for (std::size_t f = 0; f < run.extra_outputs.size(); ++f) {
    names.push_back(run.extra_output_names[f]);
    signals.push_back(&run.extra_outputs[f]);
  }
  std::vector<std::string> header = {"time"};
  for (const std::string& name : names) {
    for (int k = 0; k < n; ++k) header.push_back(fmt::format("{}_{}", name, k + 1));
  }
  CsvTable table(header, comment);
  for (std::size_t i = 0; i < run.estimates.size(); ++i) {
    table.add_time(run.estimates.clock_start + run.estimates.time[i]);
    for (const Signals* signal : signals) {
      for (const auto& column : *signal) table.add(column[i]);
    }
  }
  table.write(path);
}

}  // namespace halyard
