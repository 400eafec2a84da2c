#pragma once
/// 95 % intervals of the joint positions that the revised model predicts.
///
///   h_i² = (t s_i)² + q_k²,   s_i² = max(g_iᵀ C g_i, g_iᵀ B g_i)
///
///   h_i  half-width at sample i of joint k                                                 rad | m
///   g_i  sensitivities of the predicted reading to the parameters, see with_all_numbers()  [p]
///   C, B Fit::covariance and Fit::block_covariance of these parameters                     [p x p]
///   t    interval_factor()
///   q_k  95 % quantile of |measured - predicted| on the deciding blocks of the training data: the noise of the sensor
///        and the errors of the model's form
///
/// The sensitivities are differences over one step, that is, of first order. Both terms count the effect of wrong
/// parameters on the training data, so the intervals are rather too wide. They hold for motions and loads like those of
/// the training data; their coverage of the hold-out measures how well.

#include "diagnosis/fit/fit.h"
#include "diagnosis/holdout/holdout.h"

namespace halyard {

/// q_k, [n]; NaN for a joint that no deciding block of the evidence measures.
///   training  the records of the evidence in the band of the hold-out, see DiagnosisData::training_joints
std::vector<double> residual_quantiles(const Evidence& evidence, const std::vector<Record>& training,
                                       const Hypothesis& hypothesis);

/// Covariances at the fit's hypothesis of its effects' parameters together with baseline parameters, also those that
/// the final fit has reset: the data did not show that they differ from the model's values, but they may.
///   whole    all training data
///   numbers  the baseline parameters that may be off: those that were fitted; other entries are ignored
Fit with_all_numbers(const Evidence& whole, const Fit& fit, const std::vector<FitParameter>& numbers);

/// The fit of a log in which this effect did not happen: without its parameters, the others as uncertain as they are.
Fit without_event(Fit fit, std::size_t effect);

/// h_i of the fit's hypothesis: [record], each [n][size]. Empty for a joint without sensor; NaN if a
/// sensitivity cannot be integrated or the fit is not usable.
///   quantile  q_k, [n]
std::vector<Signals> half_widths(const std::vector<Record>& records, const Fit& fit,
                                 const std::vector<double>& quantile);

/// Median of h_i and share of |measured - predicted| <= h_i over the samples that are compared; prediction
/// HoldOut::after, n joints.
PredictionInterval prediction_interval(const HoldOut& joints, int n);

}  // namespace halyard
