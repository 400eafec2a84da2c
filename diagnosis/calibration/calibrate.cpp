#include "diagnosis/calibration/calibrate.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/calibration/torque_comparison.h"
#include "model/input_error.h"

namespace halyard {
namespace {

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
  bool any = false;
  for (int k = 0; k < n; ++k) any = any || is_unknown(model, k);
  if (!any) return model;

  const TorqueComparison torques = compare_torques(model, records);
  ArmModel result = model;
  for (int k = 0; k < n; ++k) {
    if (!is_unknown(model, k)) continue;
    Regression r;
    for (std::size_t i = 0; i < torques.needed[k].size(); ++i)
      if (std::isfinite(torques.needed[k][i])) r.add(torques.recorded[k][i], torques.needed[k][i]);
    if (r.n == 0) continue;
    const double correlation = r.correlation();
    if (!(correlation > kGoesWith))
      throw InputError(fmt::format(
          "{}: motor_torque_{}, of unknown scale, does not go with the motor's motion (correlation {:.2f}); give a "
          "record in which the motor moves, and that motor's own column",
          records.front().source, k + 1, correlation));
    result.nominal.joint[k].torque_scale *= r.slope();
  }
  return result;
}

bool is_unknown_scale(const ArmModel& model, std::size_t named_parameter) {
  ArmParameters<double> arm = model.nominal;
  const ParameterInfo info = named_parameters(arm)[named_parameter];
  return info.tolerance == &Tolerances::torque_scale && is_unknown(model, info.joint);
}

}  // namespace halyard
