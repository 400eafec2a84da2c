#include "diagnosis/record/coarse_record.h"

#include <algorithm>

namespace halyard {
namespace {

std::vector<double> every_nth(const std::vector<double>& x, std::size_t n, std::size_t first = 0) {
  std::vector<double> y;
  for (std::size_t i = first; i < x.size(); i += n) y.push_back(x[i]);
  return y;
}

/// The largest of the `n` samples about every n-th one.
std::vector<double> largest_about(const std::vector<double>& x, std::size_t n) {
  std::vector<double> y;
  for (std::size_t i = 0; i < x.size(); i += n) {
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, n / 2));
    const auto to = x.begin() + static_cast<std::ptrdiff_t>(std::min(i + (n + 1) / 2, x.size()));
    y.push_back(*std::max_element(from, to));
  }
  return y;
}

}  // namespace

Record coarse_record(const Record& record, int times) {
  const auto n = static_cast<std::size_t>(times);
  Record coarse = record;
  coarse.dt = record.dt * times;
  coarse.size = (record.size + n - 1) / n;
  for (Signals* signals :
       {&coarse.motor_angle, &coarse.motor_rate, &coarse.motor_acceleration, &coarse.torque, &coarse.joint,
        &coarse.joint_raw, &coarse.external, &coarse.joint_valid, &coarse.torque_valid})
    for (std::vector<double>& signal : *signals) signal = every_nth(signal, n);
  for (Signals* signals : {&coarse.joint_measured, &coarse.torque_measured})
    for (std::vector<double>& signal : *signals) signal = largest_about(signal, n);
  coarse.compare = every_nth(record.compare, n, (record.compare.size() / 2) % n);
  return coarse;
}

}  // namespace halyard
