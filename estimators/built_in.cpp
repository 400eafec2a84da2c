#include "estimators/built_in.h"

#include <limits>

#include "estimators/filters/arm_filter.h"
#include "estimators/filters/camera_filter.h"
#include "estimators/filters/disturbance_filter.h"
#include "estimators/filters/ekf.h"
#include "estimators/filters/fixed_lag_smoother.h"
#include "estimators/filters/kinematics.h"
#include "estimators/filters/sr_ukf.h"
#include "model/input_error.h"

namespace halyard {
namespace {

UkfWeights read_weights(OptionReader& reader, int n_states) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  UkfWeights weights;
  weights.alpha = reader.number("alpha", weights.alpha, 1e-5, 10);
  weights.beta = reader.number("beta", weights.beta, 0, kInfinity);
  weights.kappa = reader.number("kappa", weights.kappa, 1e-3 - n_states, kInfinity);
  weights.curvature_limit = reader.number("curvature_limit", 0.03, 0, kInfinity);
  return weights;
}

}  // namespace

std::unique_ptr<Estimator> make_sr_ukf(const ArmModel& model, const EstimatorOptions& options) {
  const auto process = std::make_shared<const ProcessModel>(model);
  OptionReader reader("sr_ukf", options);
  const UkfWeights weights = read_weights(reader, process->n_states());
  const ArmFilterOptions arm_options = read_arm_filter_options(reader, model, *process);
  reader.finish();
  return std::make_unique<ArmFilter>(model, process, arm_options, std::make_unique<SquareRootUkf>(weights));
}

std::unique_ptr<Estimator> make_camera_sr_ukf(const ArmModel& model, const EstimatorOptions& options) {
  OptionReader reader("camera_sr_ukf", options);
  const CameraOptions camera = read_camera_options(reader, model);
  const UnknownLevels levels = read_force_levels(reader, model);
  const ArmModel augmented = with_unknown_offsets(with_unknown_forces(model, levels), camera);
  const auto process = std::make_shared<const ProcessModel>(augmented);
  const UkfWeights weights = read_weights(reader, process->n_states());
  const ArmFilterOptions arm_options = read_arm_filter_options(reader, augmented, *process);
  reader.finish();
  return std::make_unique<CameraFilter>(augmented, process, with_force_wander(arm_options, *process, levels), camera,
                                        std::make_unique<SquareRootUkf>(weights));
}

std::unique_ptr<Estimator> make_disturbance_sr_ukf(const ArmModel& model, const EstimatorOptions& options) {
  OptionReader reader("disturbance_sr_ukf", options);
  const UnknownLevels levels = read_force_levels(reader, model);
  const ArmModel augmented = with_unknown_forces(model, levels);
  const auto process = std::make_shared<const ProcessModel>(augmented);
  const UkfWeights weights = read_weights(reader, process->n_states());
  ArmFilterOptions arm_options = read_arm_filter_options(reader, augmented, *process);
  reader.finish();
  return std::make_unique<DisturbanceFilter>(augmented, process, arm_options, levels,
                                             std::make_unique<SquareRootUkf>(weights));
}

std::unique_ptr<Estimator> make_smoother(const ArmModel& model, const EstimatorOptions& options) {
  const auto process = std::make_shared<const ProcessModel>(model);
  OptionReader reader("smoother", options);
  const double lag_s = reader.number("lag", 0.2, 1e-3, 10);
  const UkfWeights weights = read_weights(reader, process->n_states());
  const ArmFilterOptions arm_options = read_arm_filter_options(reader, model, *process);
  reader.finish();
  if (weights.beta < weights.alpha * weights.alpha)
    throw InputError(
        "estimator smoother: option beta is smaller than alpha squared: a down-date cannot be smoothed; "
        "give a larger beta or a smaller alpha");
  return std::make_unique<FixedLagSmoother>(model, process, arm_options, weights, lag_s);
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
