#include "estimators/built_in.h"

#include <limits>

#include "estimators/arm_filter.h"
#include "estimators/ekf.h"
#include "estimators/kinematics.h"
#include "estimators/sr_ukf.h"

namespace halyard {

std::unique_ptr<Estimator> make_sr_ukf(const ArmModel& model, const EstimatorOptions& options) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto process = std::make_shared<const ProcessModel>(model);
  OptionReader reader("sr_ukf", options);
  UkfWeights weights;
  weights.alpha = reader.number("alpha", weights.alpha, 1e-5, 10);
  weights.beta = reader.number("beta", weights.beta, 0, kInfinity);
  weights.kappa = reader.number("kappa", weights.kappa, 1e-3 - process->n_states(), kInfinity);
  weights.curvature_limit = reader.number("curvature_limit", 0.03, 0, kInfinity);
  const ArmFilterOptions arm_options = read_arm_filter_options(reader, model, *process);
  reader.finish();
  return std::make_unique<ArmFilter>(model, process, arm_options, std::make_unique<SquareRootUkf>(weights));
}

std::unique_ptr<Estimator> make_ekf(const ArmModel& model, const EstimatorOptions& options) {
  const auto process = std::make_shared<const ProcessModel>(model);
  OptionReader reader("ekf", options);
  const ArmFilterOptions arm_options = read_arm_filter_options(reader, model, *process);
  reader.finish();
  return std::make_unique<ArmFilter>(model, process, arm_options, std::make_unique<ExtendedKalmanFilter>());
}

std::unique_ptr<Estimator> make_kinematics(const ArmModel& model, const EstimatorOptions& options) {
  OptionReader("kinematics", options).finish();
  return std::make_unique<KinematicsEstimator>(model);
}

}  // namespace halyard
