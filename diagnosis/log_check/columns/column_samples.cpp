#include "diagnosis/log_check/columns/column_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/statistics/quantile.h"

namespace halyard {

Samples::Samples(const Log& log, const std::vector<double>& column) {
  for (std::size_t i = 0; i < column.size(); ++i)
    if (std::isfinite(column[i])) time.push_back(log.time[i]), x.push_back(column[i]);
}

std::vector<Run> runs_of(const std::vector<double>& x) {
  std::vector<Run> runs;
  for (std::size_t begin = 0, end = 0; begin < x.size(); begin = end) {
    for (end = begin + 1; end < x.size() && x[end] == x[begin];) ++end;
    runs.push_back({begin, end});
  }
  return runs;
}

double usual_length(const std::vector<Run>& runs) {
  std::vector<double> lengths;
  for (const Run& run : runs) lengths.push_back(static_cast<double>(run.size()));
  // A column that hardly changes has no usual length: at most a twentieth of it.
  return std::min(median(lengths), static_cast<double>(runs.back().end) / 20);
}

std::vector<PositionColumn> position_columns(const LogUnderCheck& c) {
  std::vector<PositionColumn> columns;
  for (int k = 0; k < c.n(); ++k) {
    const JointParameters<double>& j = c.model.nominal.joint[k];
    const double least = c.rule.least_motion * c.range(k);
    if (c.is_driven(k) && !c.log.motor_position[k].empty())
      columns.push_back(
          {{&Log::motor_position, k}, j.motor_encoder_resolution, least / std::abs(c.joint_per_motor(k)), true});
    if (!c.log.joint_position[k].empty())
      columns.push_back({{&Log::joint_position, k}, j.joint_encoder_resolution, least, j.type == JointType::revolute});
  }
  return columns;
}

std::string leave_out(const PositionColumn& column) {
  return column.signal == &Log::joint_position
             ? fmt::format("leave these cells empty, or read the log without this sensor with --column {}=",
                           column.name())
             : "leave these cells empty";
}

std::string Jumps::description() const {
  return fmt::format("jumps by {:.5g} between two samples at {:.4g} s", step, when) +
         (count > 1 ? fmt::format(", the first of {} jumps", count) : "");
}

Jumps jumps_of(const LogUnderCheck& c, const PositionColumn& column) {
  const Samples s(c.log, (c.log.*column.signal)[column.k]);
  std::vector<double> steps, rates;
  for (std::size_t i = 1; i < s.size(); ++i) {
    steps.push_back(std::abs(s.x[i] - s.x[i - 1]));
    rates.push_back(steps.back() / (s.time[i] - s.time[i - 1]));
  }
  Jumps jumps{.usual = quantile(steps, 0.99)};
  const double usual_rate = quantile(rates, 0.99);
  for (std::size_t i = 2; i + 2 < s.size(); ++i) {
    const double step = s.x[i] - s.x[i - 1];
    if (std::abs(step) < column.significant || rates[i - 1] < c.rule.jump * usual_rate) continue;
    // A jump stays; an outlier returns.
    const double stays = 0.5 * (s.x[i] + s.x[i + 1]) - 0.5 * (s.x[i - 1] + s.x[i - 2]);
    if (std::abs(stays / step - 1) > 0.25) continue;
    if (jumps.count++ == 0) jumps.step = step, jumps.when = s.time[i];
    jumps.alike = jumps.alike && std::abs(std::abs(step) - std::abs(jumps.step)) < 4 * jumps.usual;
  }
  return jumps;
}

}  // namespace halyard
