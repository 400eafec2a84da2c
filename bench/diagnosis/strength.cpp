#include "bench/diagnosis/strength.h"

#include <cmath>
#include <limits>

#include "diagnosis/fit.h"
#include "model/input_error.h"

namespace halyard::blind {

StrengthMeter::StrengthMeter(const Log& training, const ArmModel& model)
    : evidence_(make_records(training, model, {}), model),
      nominal_{model.nominal, model.effects},
      base_(evidence_.fit_rows({nominal_})[0]) {
  const auto columns = sensitivities(evidence_, nominal_, baseline_parameters(model.nominal));
  const auto rows = static_cast<Eigen::Index>(evidence_.row_channel().size());
  const auto numbers = static_cast<Eigen::Index>(columns.size());
  // A row more for each number: |u|².
  J_ = Eigen::MatrixXd::Zero(rows + numbers, numbers);
  for (Eigen::Index i = 0; i < numbers; ++i) {
    for (Eigen::Index r = 0; r < rows; ++r) J_(r, i) = columns[i][r] / evidence_.floor()[evidence_.row_channel()[r]];
    J_(rows + i, i) = std::sqrt(evidence_.correlated_rows());
  }
  qr_.compute(J_);
}

double StrengthMeter::strength(const PlacedEffect& effect) const {
  Hypothesis with = nominal_;
  with.effects.push_back(effect);
  const std::vector<double> changed = evidence_.fit_rows({with})[0];
  if (changed.empty() || base_.empty()) return std::numeric_limits<double>::infinity();
  Eigen::VectorXd d = Eigen::VectorXd::Zero(J_.rows());
  for (std::size_t r = 0; r < changed.size(); ++r)
    d(static_cast<Eigen::Index>(r)) = (changed[r] - base_[r]) / evidence_.floor()[evidence_.row_channel()[r]];
  d -= J_ * qr_.solve(d);
  std::vector<double> square(evidence_.channels(), 0), count(evidence_.channels(), 0);
  for (std::size_t r = 0; r < changed.size(); ++r) {
    square[evidence_.row_channel()[r]] += d(static_cast<Eigen::Index>(r)) * d(static_cast<Eigen::Index>(r));
    count[evidence_.row_channel()[r]] += 1;
  }
  double most = 0;
  for (int c = 0; c < evidence_.channels(); ++c)
    if (count[c] > 0) most = std::max(most, std::sqrt(square[c] / count[c]));
  return most;
}

}  // namespace halyard::blind
