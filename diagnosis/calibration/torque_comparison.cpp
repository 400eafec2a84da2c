#include "diagnosis/calibration/torque_comparison.h"

#include <cmath>
#include <limits>

#include "diagnosis/prediction/prediction.h"

namespace halyard {
namespace {

constexpr int kStride = 5;  ///< samples; torques are band-limited to 20 Hz
constexpr double kNoTorque = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TorqueComparison compare_torques(const ArmModel& model, const std::vector<Record>& records) {
  const int n = model.n();
  const Hypothesis once{model.nominal, model.effects};
  // A residual is recorded minus needed over scale: twice the scale halves the second term, which tells the two apart.
  Hypothesis twice = once;
  for (int k = 0; k < n; ++k) twice.nominal.joint[k].torque_scale *= 2;
  TorqueComparison c;
  c.recorded.resize(n), c.needed.resize(n);
  for (const Record& record : records) {
    c.step = kStride * record.dt;
    const std::vector<Residuals> e = predict(record, {once, twice}, kStride);
    c.is_predicted = c.is_predicted && e[0].finite;
    for (int k = 0; k < n; ++k) {
      const std::size_t samples = (record.size + kStride - 1) / kStride;
      for (std::size_t i = 0; i < samples; ++i) {
        if (!record.has_torque(k) || i >= e[0].channel[k].size()) {
          c.recorded[k].push_back(kNoTorque), c.needed[k].push_back(kNoTorque);
          continue;
        }
        const bool moves = std::abs(record.motor_rate[k][i * kStride]) > 2 * model.nominal.joint[k].motor_smoothing;
        const double recorded = 2 * e[1].channel[k][i] - e[0].channel[k][i];
        c.recorded[k].push_back(recorded);
        c.needed[k].push_back(moves ? recorded - e[0].channel[k][i] : kNoTorque);
      }
    }
  }
  return c;
}

void append(TorqueComparison& all, const TorqueComparison& more) {
  for (std::size_t k = 0; k < all.recorded.size(); ++k) {
    all.recorded[k].insert(all.recorded[k].end(), more.recorded[k].begin(), more.recorded[k].end());
    all.needed[k].insert(all.needed[k].end(), more.needed[k].begin(), more.needed[k].end());
  }
  all.is_predicted = all.is_predicted && more.is_predicted;
}

}  // namespace halyard
