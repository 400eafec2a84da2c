#include "diagnosis/prediction/lane_residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/prediction/measured_units.h"

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t rows_of(const Record& record, int stride) { return (record.size + stride - 1) / stride; }

/// Takes off the mean: where the zero of an encoder is unknown, that is what it says.
void take_off_mean(std::vector<double>& residual) {
  double sum = 0, count = 0;
  for (const double e : residual)
    if (!std::isnan(e)) sum += e, count += 1;
  for (double& e : residual) e -= sum / count;
}

/// K_c * x around a sample that can be compared, over the samples that were measured.
template <class Signal>
Lanes compared(const Record& record, const std::vector<double>& measured, std::size_t at, const Signal& x) {
  const std::size_t reach = record.compare.size() / 2, size = record.size;
  Lanes sum = 0.0;
  double weight = 0;
  for (std::size_t t = at - std::min(at, reach); t <= std::min(at + reach, size - 1); ++t) {
    const double w = record.compare[t + reach - at] * measured[t];
    if (w > 0) sum += Lanes(w) * x(t);
    weight += w;
  }
  return sum / Lanes(weight);
}

/// The channels of the hypotheses in the lanes of one drive.
class LaneResiduals {
 public:
  LaneResiduals(const Record& record, int stride, const std::vector<LaneOwner>& owners)
      : record_(record), stride_(stride), owners_(owners) {}

  template <class Signal>
  void take(int channel, const std::vector<double>& valid, const std::vector<double>& measured, const Signal& signal) {
    for (const LaneOwner& owner : owners_) owner.residuals->channel[channel].assign(rows(), kNone);
    for (std::size_t i = 0; i < rows(); ++i) {
      const std::size_t at = i * stride_;
      if (!(valid[at] > 0)) continue;
      const Lanes row = compared(record_, measured, at, signal);
      for (std::size_t l = 0; l < owners_.size(); ++l)
        owners_[l].residuals->channel[channel][i] = row[static_cast<int>(l)];
    }
  }

  /// Marks the hypotheses whose signal is not finite at a compared sample.
  template <class Signal>
  void check_finite(const Signal& signal) {
    Lanes sum = 0.0;
    for (std::size_t i = 0; i < rows(); ++i) sum += Lanes(0.0) * signal(i * stride_);
    for (std::size_t l = 0; l < owners_.size(); ++l)
      if (!std::isfinite(sum[static_cast<int>(l)])) owners_[l].residuals->finite = false;
  }

 private:
  std::size_t rows() const { return rows_of(record_, stride_); }

  const Record& record_;
  int stride_;
  const std::vector<LaneOwner>& owners_;
};

void finish_joint(const Record& record, const CommandHistory& history, const Hypothesis& h, int k, Residuals& r) {
  if (record.has_torque(k)) {
    // Otherwise a hypothesis by which the motor makes less than it was commanded would win by shrinking the data.
    const double ratio = acting_over_commanded(record, h, k, history);
    for (double& e : r.channel[k]) e /= ratio;
  }
  const JointParameters<double>& sensors = h.nominal.joint[k];
  if (!sensors.motor_zero_known || !sensors.joint_zero_known) take_off_mean(r.channel[record.n + k]);
}

}  // namespace

void take_residuals(const Record& record, const CommandHistory& history, int stride, const std::vector<Lanes>& out,
                    const std::vector<LaneOwner>& owners) {
  const int n = record.n;
  LaneResiduals lanes(record, stride, owners);
  for (const LaneOwner& owner : owners) owner.residuals->channel.assign(2 * n, {});
  for (int k = 0; k < n; ++k) {
    const auto residual = [&, k](std::size_t t) { return out[t * 2 * n + k]; };
    const auto reading = [&, k](std::size_t t) { return out[t * 2 * n + n + k]; };
    const auto error = [&, k](std::size_t t) { return Lanes(record.joint[k][t]) - reading(t); };
    lanes.check_finite(residual);
    lanes.check_finite(reading);
    if (record.has_torque(k)) lanes.take(k, record.torque_valid[k], record.torque_measured[k], residual);
    if (record.has_joint(k)) lanes.take(n + k, record.joint_valid[k], record.joint_measured[k], error);
    for (const LaneOwner& owner : owners) finish_joint(record, history, *owner.hypothesis, k, *owner.residuals);
  }
}

Residuals unknown_residuals(const Record& record, int stride) {
  Residuals unknown{std::vector<std::vector<double>>(2 * record.n), false};
  for (int k = 0; k < record.n; ++k) {
    if (record.has_torque(k)) unknown.channel[k].assign(rows_of(record, stride), kNone);
    if (record.has_joint(k)) unknown.channel[record.n + k].assign(rows_of(record, stride), kNone);
  }
  return unknown;
}

}  // namespace halyard
