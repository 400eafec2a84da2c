#include "diagnosis/record/resting.h"

#include <algorithm>
#include <cmath>

namespace halyard {

bool rests(const Record& record, int k, std::size_t at, double v_s) {
  const std::size_t reach = record.compare.size() / 2;
  double still = 0;
  for (std::size_t t = at - std::min(at, reach); t <= std::min(at + reach, record.size - 1); ++t)
    if (std::abs(record.motor_rate[k][t]) < 2 * v_s) still += record.compare[t + reach - at];
  return still > 0.5;
}

double slowest_smoothing(const ArmModel& model, int k) {
  return model.nominal.joint[k].motor_smoothing * std::max(0.1, 1 - model.joints[k].tolerances.smoothing);
}

}  // namespace halyard
