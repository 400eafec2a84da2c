#pragma once
/// Fits parameters of a hypothesis to the fitting blocks: bounded least squares by Ceres. Sensitivities come from
/// hypotheses that are predicted in parallel.
///
///   minimise  Σ_c Σ_i (e_ci / s_c)² / m_c  +  Σ_b ((θ_b - nominal) / (tolerance / 2))²
///
///   e_ci   residual i of channel c            s_c   its scale: the channel's residual before the fit, or its floor
///   m_c    rows that equal one independent sample
///   θ_b    baseline parameters, each kept within its tolerance; effects' parameters have bounds and no prior

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/fit_parameter.h"

namespace halyard {

struct FitOptions {
  int iterations = 10;
  double cost_tolerance = 1e-5;  ///< stops after a step that lowers the cost by a smaller share
  /// m_c of each channel; empty: Evidence::correlated_rows(c), as if all residuals were errors of the model.
  std::vector<double> correlated_rows = {};
};

/// A parameter of an effect that a final fit has reset to neutral, as it was with all parameters (final_fit.h).
struct ResetParameter {
  FitParameter parameter;
  double value, half_width;  ///< half of its 95 % interval
};

struct Fit {
  Hypothesis hypothesis;
  std::vector<FitParameter> parameters;
  std::vector<double> value;  ///< [parameters]
  /// [parameters] The larger of two estimates. One comes from the scatter of blocks (block_variance.h), which accounts
  /// for the correlation of residuals. The other comes from the curvature, which accounts for errors of the model that
  /// all blocks share.
  std::vector<double> std_deviation;
  int blocks = 0;                          ///< number of blocks in that scatter: its degrees of freedom plus one
  Eigen::MatrixXd covariance;              ///< from the curvature at the end, if m_c is right, [parameters]²
  Eigen::MatrixXd block_covariance;        ///< from the scatter of blocks, [parameters]²
  bool usable = false;                     ///< false: the start could not be integrated
  std::vector<ResetParameter> reset = {};  ///< of effects that keep a size
};

/// Channel scales from residuals: sqrt(max(mean square, floor²)). [2n]
std::vector<double> channel_scale(const Evidence& evidence, const std::vector<double>& mean_square);

/// By what a fitting row is divided so that its square is a part of the cost: its channel's scale times √m, m the
/// number of correlated rows. [rows]
Eigen::VectorXd row_scale(const Evidence& evidence, const std::vector<double>& scale);

/// Rows that equal one independent sample of each channel, if its residual is the sensor's noise and an error of the
/// model: [2n]
///
///   m_c = (ν² m_noise + max(s² - ν², ρ²) m_model) / s²
///
///   s   scale of the channel    ν   its noise in the compared band    ρ   the smallest error that it resolves
///   m_noise, m_model            Evidence::noise_rows(), Evidence::correlated_rows(c)
std::vector<double> independent_rows(const Evidence& evidence, const std::vector<double>& scale);

/// Sensitivities of the fitting rows to parameters, by one-sided differences; empty if one could not be integrated.
std::vector<std::vector<double>> sensitivities(const Evidence& evidence, const Hypothesis& at,
                                               const std::vector<FitParameter>& parameters);

/// Fits `parameters`, except whole numbers, which keep their value. The first of them are linear: they have the
/// constant sensitivities `linear`. Whole numbers are not among these.
Fit fit(const Evidence& evidence, const Hypothesis& start, const std::vector<FitParameter>& parameters,
        const std::vector<double>& scale, const FitOptions& options = {},
        const std::vector<std::vector<double>>& linear = {});

}  // namespace halyard
