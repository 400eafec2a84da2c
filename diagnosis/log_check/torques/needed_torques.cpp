#include "diagnosis/log_check/torques/needed_torques.h"

#include <algorithm>
#include <cmath>

#include "model/input_error.h"

namespace halyard {
namespace {

/// Nothing if the part is too short for a record.
std::optional<TorqueComparison> torques_of_part(const LogUnderCheck& c, const Log& part) {
  try {
    return compare_torques(c.model, make_records(part, c.model, {}));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<TorqueComparison> needed_torques(const LogUnderCheck& c) {
  constexpr double kPart_s = 120;
  std::optional<TorqueComparison> all;
  const std::vector<double>& time = c.log.time;
  for (std::size_t begin = 0, end = 0; begin < time.size(); begin = end) {
    end = static_cast<std::size_t>(std::ranges::upper_bound(time, time[begin] + kPart_s) - time.begin());
    const auto part = torques_of_part(c, slice(c.log, begin, end));
    if (part && all) append(*all, *part);
    else if (part) all = part;
  }
  return all;
}

Correlation significant(const LogUnderCheck& c, const TorqueComparison& t, int recorded, int needed) {
  Correlation r = correlation_of(t.recorded[recorded], t.needed[needed]);
  const double independent = static_cast<double>(r.n) * t.step / c.rule.independent_s;
  if (independent < 4 || std::abs(r.r) * std::sqrt(independent) < c.rule.significance) return {};
  return r;
}

double unexplained(const Correlation& r) { return 1 - std::max(0.0, r.r) * r.r; }

bool has_known_scale(const LogUnderCheck& c, int k) { return c.model.joints[k].tolerances.torque_scale < 1; }

}  // namespace halyard
