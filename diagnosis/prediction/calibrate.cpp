#include "diagnosis/prediction/calibrate.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/prediction/prediction.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr int kStride = 5;         ///< samples; torques are band-limited to 20 Hz
constexpr double kGoesWith = 0.3;  ///< least correlation of recorded and needed torque

bool is_unknown(const ArmModel& model, int k) {
  return model.nominal.joint[k].drive != Drive::none && model.joints[k].tolerances.torque_scale >= 1;
}

/// Sums of a linear regression of y over x.
struct Regression {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double at, double value) {
    n += 1, x += at, y += value, xx += at * at, xy += at * value, yy += value * value;
  }
  double covariance() const { return n * xy - x * y; }
  double slope() const { return covariance() / (n * xx - x * x); }
  double correlation() const { return covariance() / std::sqrt((n * xx - x * x) * (n * yy - y * y)); }
};

}  // namespace

ArmModel calibrated(const ArmModel& model, const std::vector<Record>& records) {
  const int n = model.n();
  const Hypothesis once{model.nominal, model.effects};
  Hypothesis twice = once;
  bool any = false;
  for (int k = 0; k < n; ++k)
    if (is_unknown(model, k)) twice.nominal.joint[k].torque_scale *= 2, any = true;
  if (!any) return model;

  std::vector<Regression> needed_over_recorded(n);
  for (const Record& record : records) {
    const std::vector<Residuals> e = predict(record, {once, twice}, kStride);
    for (int k = 0; k < n; ++k) {
      if (!record.has_torque(k) || !is_unknown(model, k)) continue;
      for (std::size_t i = 0; i < e[0].channel[k].size(); ++i) {
        const bool moves = std::abs(record.motor_rate[k][i * kStride]) > 2 * model.nominal.joint[k].motor_smoothing;
        const double recorded = e[1].channel[k][i] - e[0].channel[k][i], needed = recorded - e[0].channel[k][i];
        if (moves && std::isfinite(needed)) needed_over_recorded[k].add(recorded, needed);
      }
    }
  }
  ArmModel result = model;
  for (int k = 0; k < n; ++k) {
    const Regression& r = needed_over_recorded[k];
    if (r.n == 0) continue;
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}: motor_torque_{}, of unknown scale, {}", records.front().source, k + 1, what));
    };
    const double correlation = r.correlation();
    if (correlation < -kGoesWith)
      fail(
          "goes against the torque that the motion needs; give its column sign=-1, or correct the sign of the motor's "
          "position");
    if (!(correlation > kGoesWith))
      fail(fmt::format(
          "does not go with the motor's motion (correlation {:.2f}); give a record in which the motor moves, "
          "and that motor's own column",
          correlation));
    result.nominal.joint[k].torque_scale *= r.slope();
  }
  return result;
}

bool is_unknown_scale(const ArmModel& model, int named_parameter) {
  ArmParameters<double> arm = model.nominal;
  const ParameterInfo info = named_parameters(arm)[named_parameter];
  return info.value == &arm.joint[info.joint].torque_scale && is_unknown(model, info.joint);
}

}  // namespace halyard
