/// What single columns of torques show, whatever the motion requires.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/log_check/checks.h"
#include "diagnosis/log_check/columns/column_samples.h"
#include "diagnosis/log_check/robust.h"

namespace halyard {
namespace {

void check_clipped_torque(LogUnderCheck& c, int k) {
  const Samples s(c.log, c.log.motor_torque[k]);
  const double limit = c.model.joints[k].controller.torque_limit, usual = 0.5 * spread(s.x);
  if (s.size() < 20 || usual == 0) return;
  const auto [low, high] = std::ranges::minmax(s.x);
  for (const double end : {low, high}) {
    const bool is_limit = limit > 0 && std::abs(std::abs(end) / limit - 1) < c.rule.at_limit;
    double held = 0;
    for (const Run& run : runs_of(s.x))
      if (s.x[run.begin] == end && run.size() >= 3) held += static_cast<double>(run.size());
    const double share = held / static_cast<double>(s.size());
    if (std::abs(end) > 0 && !is_limit && share > c.rule.clipped && share < 0.5 && std::abs(end) > 0.5 * usual)
      c.suspect(
          column_name(&Log::motor_torque, k),
          fmt::format("is exactly {:.6g} in {:.2g} % of the samples, its extreme value: clipped", end, 100 * share),
          "record the torque with a larger range; if the drive limits it, state the model's torque_limit");
  }
}

}  // namespace

void check_torque_spikes(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k) {
    std::vector<double>& torque = c.log.motor_torque[k];
    std::vector<double> size;
    for (const double x : torque)
      if (std::abs(x) > 0) size.push_back(std::abs(x));
    const double usual = quantile(size, 0.95), limit = c.rule.torque_spike * usual;
    const auto is_spike = [limit](double x) { return std::abs(x) > limit; };
    const auto first = std::ranges::find_if(torque, is_spike);
    if (first == torque.end()) continue;
    const auto row = static_cast<std::size_t>(first - torque.begin());
    const auto others = std::count_if(first + 1, torque.end(), is_spike);
    c.reject(column_name(&Log::motor_torque, k),
             fmt::format("{:g} N m at {:.6g} s{}; 95 % of the torques are below {:.3g} N m", *first, c.log.time[row],
                         others > 0 ? fmt::format(" (and {} more)", others) : "", usual),
             "correct this cell, or leave it empty");
    c.findings.back().line = line_of_sample(c.log, row);
    std::ranges::replace_if(torque, is_spike, std::numeric_limits<double>::quiet_NaN());
  }
}

void check_clipped_torques(LogUnderCheck& c) {
  for (int k = 0; k < c.n(); ++k)
    if (c.is_driven(k)) check_clipped_torque(c, k);
}

}  // namespace halyard
