#pragma once
/// The built-in estimators of an arm. All options have defaults.
///
///   all but kinematics        the options of noise.h and arm_filter.h
///   unscented filters         also alpha, beta, kappa and curvature_limit (0.03) of sr_ukf.h
///   disturbance_sr_ukf,
///   camera_sr_ukf             also force_start and force_wander of disturbance_filter.h
///   smoother                  also lag (0.2 s) of fixed_lag_smoother.h
///   camera_sr_ukf             also the options of camera_filter.h

#include <memory>

#include "estimators/estimator.h"
#include "model/arm_model.h"

namespace halyard {

/// These throw InputError for an unknown option or a bad value, and std::runtime_error if the model's equations cannot
/// be evaluated.
std::unique_ptr<Estimator> make_sr_ukf(const ArmModel& model, const EstimatorOptions& options);
std::unique_ptr<Estimator> make_camera_sr_ukf(const ArmModel& model, const EstimatorOptions& options);
std::unique_ptr<Estimator> make_disturbance_sr_ukf(const ArmModel& model, const EstimatorOptions& options);
std::unique_ptr<Estimator> make_smoother(const ArmModel& model, const EstimatorOptions& options);
std::unique_ptr<Estimator> make_ekf(const ArmModel& model, const EstimatorOptions& options);
std::unique_ptr<Estimator> make_kinematics(const ArmModel& model, const EstimatorOptions& options);

}  // namespace halyard
