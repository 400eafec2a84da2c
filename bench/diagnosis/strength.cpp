#include "bench/diagnosis/strength.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/fit/fit.h"
#include "model/input_error.h"

namespace halyard::blind {
namespace {

bool is_constant_error_of_a_sensor(const PlacedEffect& effect, const ArmParameters<double>& nominal) {
  ArmParameters<double> arm = nominal;
  effect.effect->change_parameters(arm, effect.joint, effect.p);
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>&with = arm.joint[k], &without = nominal.joint[k];
    if (with.motor_encoder_offset != without.motor_encoder_offset || with.torque_bias != without.torque_bias ||
        with.joint_encoder_offset != without.joint_encoder_offset)
      return true;
  }
  return false;
}

}  // namespace

StrengthMeter::StrengthMeter(const Log& training, const ArmModel& model)
    : evidence_(make_records(training, model, {}), model),
      nominal_{model.nominal, model.effects},
      base_(evidence_.fit_rows({nominal_})[0]) {
  const auto columns = sensitivities(evidence_, nominal_, baseline_parameters(model));
  const auto rows = static_cast<Eigen::Index>(evidence_.row_channel().size());
  const auto numbers = static_cast<Eigen::Index>(columns.size());
  // A row more for each number: |u|².
  whole_.J = Eigen::MatrixXd::Zero(rows + numbers, numbers);
  for (Eigen::Index i = 0; i < numbers; ++i) {
    for (Eigen::Index r = 0; r < rows; ++r)
      whole_.J(r, i) = columns[i][r] / evidence_.floor()[evidence_.row_channel()[r]];
    whole_.J(rows + i, i) = std::sqrt(evidence_.correlated_rows());
  }
  centred_.J = whole_.J;
  for (Eigen::Index i = 0; i < numbers; ++i) take_off_constants(centred_.J.col(i));
  for (Reach* reach : {&whole_, &centred_}) reach->qr.compute(reach->J);
}

void StrengthMeter::take_off_constants(Eigen::Ref<Eigen::VectorXd> rows) const {
  const std::vector<int>& channel = evidence_.row_channel();
  std::vector<double> sum(evidence_.channels(), 0), count(evidence_.channels(), 0);
  for (std::size_t r = 0; r < channel.size(); ++r)
    sum[channel[r]] += rows(static_cast<Eigen::Index>(r)), count[channel[r]] += 1;
  for (std::size_t r = 0; r < channel.size(); ++r)
    rows(static_cast<Eigen::Index>(r)) -= sum[channel[r]] / count[channel[r]];
}

double StrengthMeter::strength(const PlacedEffect& effect) const {
  std::vector<Hypothesis> with = {nominal_};
  with[0].effects.push_back(effect);
  const auto place = static_cast<int>(nominal_.effects.size());
  for (const FitParameter& p : effect_parameters(evidence_, with[0], nominal_.nominal, place))
    if (is_past(p)) {
      with.push_back(with[0]);
      set_parameter(with.back(), p, p.scale);
    }
  const auto rows = evidence_.fit_rows(with);
  if (std::ranges::any_of(rows, [](const auto& r) { return r.empty(); }) || base_.empty())
    return std::numeric_limits<double>::infinity();
  const bool of_constants = is_constant_error_of_a_sensor(effect, nominal_.nominal);
  const Reach& reach = of_constants ? whole_ : centred_;
  const auto beyond_reach = [&](const std::vector<double>& now, const std::vector<double>& before) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(reach.J.rows());
    for (std::size_t r = 0; r < now.size(); ++r)
      d(static_cast<Eigen::Index>(r)) = (now[r] - before[r]) / evidence_.floor()[evidence_.row_channel()[r]];
    if (!of_constants) take_off_constants(d);
    return Eigen::VectorXd(d - reach.J * reach.qr.solve(d));
  };
  Eigen::VectorXd d = beyond_reach(rows[0], base_);
  if (rows.size() > 1) {
    Eigen::MatrixXd past(d.size(), static_cast<Eigen::Index>(rows.size()) - 1);
    for (Eigen::Index i = 0; i < past.cols(); ++i)
      past.col(i) = beyond_reach(rows[static_cast<std::size_t>(i) + 1], rows[0]);
    d -= past * past.colPivHouseholderQr().solve(d);
  }
  std::vector<double> square(evidence_.channels(), 0), count(evidence_.channels(), 0);
  for (std::size_t r = 0; r < base_.size(); ++r) {
    square[evidence_.row_channel()[r]] += d(static_cast<Eigen::Index>(r)) * d(static_cast<Eigen::Index>(r));
    count[evidence_.row_channel()[r]] += 1;
  }
  double most = 0;
  for (int c = 0; c < evidence_.channels(); ++c)
    if (count[c] > 0) most = std::max(most, std::sqrt(square[c] / count[c]));
  return most;
}

}  // namespace halyard::blind
