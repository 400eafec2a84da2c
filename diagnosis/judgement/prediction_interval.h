#pragma once
/// 95 % intervals of the joint positions that the revised model predicts.
///
///   h_i² = (t s_i)² + q_k²,   s_i² = g_iᵀ C g_i
///
///   h_i  half-width at sample i of joint k                                                 rad | m
///   g_i  sensitivities of the predicted reading to the parameters of the final fit         [p]
///   C    covariance of these parameters: Fit::covariance, scaled to Fit::std_deviation     [p x p]
///   t    interval_factor()
///   q_k  95 % quantile of |measured - predicted| on the deciding blocks of the training data: the noise of the sensor
///        and the errors of the model's form
///
/// The sensitivities are differences over one step, that is, of first order. Parameters that the final fit has reset do
/// not count. The intervals hold for motions and loads like those of the training data; their coverage of the hold-out
/// measures how well.

#include <Eigen/Core>

#include "diagnosis/fit/fit.h"
#include "diagnosis/judgement/holdout.h"

namespace halyard {

/// C. 0 x 0 for a fit without parameters.
Eigen::MatrixXd parameter_covariance(const Fit& fit);

/// q_k, [n]; NaN for a joint that no deciding block measures.
std::vector<double> residual_quantiles(const Evidence& evidence, const Hypothesis& hypothesis);

/// h_i of the fit's hypothesis: [record], each [n][size]. Empty for a joint without sensor; NaN if a sensitivity cannot be
/// integrated or the fit is not usable.
///   quantile  q_k, [n]
std::vector<Signals> half_widths(const std::vector<Record>& records, const Fit& fit,
                                 const std::vector<double>& quantile);

/// Median of h_i and share of |measured - predicted| <= h_i over the samples that are compared; prediction
/// HoldOut::after, n joints.
PredictionInterval prediction_interval(const HoldOut& joints, int n);

}  // namespace halyard
