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
#include <optional>
#include <string>

#include "diagnosis/fit/evidence.h"
#include "diagnosis/search_space.h"

namespace halyard {

/// One parameter of a fit.
struct FitParameter {
  std::string name;
  std::string unit;
  int effect = -1;  ///< index in Hypothesis::effects; -1: a baseline parameter
  /// Baseline: index in named_parameters(). Effect: index of its parameter; indices from kMaxEffectParameters on are
  /// the states of its past.
  int index = 0;
  double nominal = 0;  ///< baseline: the model's value
  double lower = 0, upper = 0;
  double scale = 1;                 ///< one unit of the optimiser
  bool natural_bounds = false;      ///< see ParameterSearch
  bool shape = false;               ///< a shape of an effect, see EffectParameter
  std::vector<double> starts = {};  ///< start values; for a past in units of its scale
  SearchRange range = SearchRange::own;
  bool is_whole = false;  ///< a whole number: tried at its starts and not fitted
};

/// True for an effect's state at the start of a record (its past), which belongs to the data and not to the arm.
inline bool is_past(const FitParameter& p) { return p.effect >= 0 && p.index >= kMaxEffectParameters; }
/// Index of the parameter with the same effect and index, if there is one.
inline std::optional<std::size_t> find_parameter(const std::vector<FitParameter>& parameters, const FitParameter& p) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].effect == p.effect && parameters[i].index == p.index) return i;
  return {};
}
double parameter_value(const Hypothesis& h, const FitParameter& p);
void set_parameter(Hypothesis& h, const FitParameter& p, double value);

/// The hypothesis with the parameter moved by the step of a sensitivity. At a bound the step goes inward.
Hypothesis stepped(const Hypothesis& h, const FitParameter& p);

/// Baseline parameters for which the model states a tolerance. The ratio of a drive is a single parameter: the
/// capstan's radius represents it.
std::vector<FitParameter> baseline_parameters(const ArmModel& model);
/// The parameters of the effect with index `place`; instants and positions are limited to the range of the records.
/// The period of a periodic effect is limited, so that the motion contains at least kFewestPeriods periods.
/// The effect's states at the start of each record follow as shapes, unless there are more than a dozen records.
std::vector<FitParameter> effect_parameters(const Evidence& evidence, const Hypothesis& h,
                                            const ArmParameters<double>& nominal, int place);
/// Sizes of an effect and the shapes that follow them, as indices in a list of parameters.
struct ParameterGroup {
  std::vector<std::size_t> sizes, shapes;
};
/// The groups of all effects in the list; baseline parameters are in none.
std::vector<ParameterGroup> groups_of(const std::vector<FitParameter>& parameters);
/// True if an effect's parameter is at its plausible bound. False at its neutral value, even if that is a bound.
bool ends_at_bound(const FitParameter& p, double value);
/// True if a change of the effect's parameters also changes that baseline parameter, so that the baseline parameter
/// need not be fitted beside the effect.
bool effect_covers(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline);

struct FitOptions {
  int iterations = 10;
  double cost_tolerance = 1e-5;  ///< stops after a step that lowers the cost by a smaller share
  /// m_c of each channel; empty: Evidence::correlated_rows(), as if all residuals were errors of the model.
  std::vector<double> correlated_rows = {};
};

struct Fit {
  Hypothesis hypothesis;
  std::vector<FitParameter> parameters;
  std::vector<double> value;  ///< [parameters]
  /// [parameters] The larger of two estimates. One comes from the scatter of blocks (block_variance.h), which accounts
  /// for the correlation of residuals. The other comes from the curvature, which accounts for errors of the model that
  /// all blocks share.
  std::vector<double> std_deviation;
  int blocks = 0;                    ///< number of blocks in that scatter: its degrees of freedom plus one
  Eigen::MatrixXd covariance;        ///< from the curvature at the end, if m_c is right, [parameters]²
  Eigen::MatrixXd block_covariance;  ///< from the scatter of blocks, [parameters]²
  bool usable = false;               ///< false: the start could not be integrated
};

/// Channel scales from residuals: sqrt(max(mean square, floor²)). [2n]
std::vector<double> channel_scale(const Evidence& evidence, const std::vector<double>& mean_square);

/// Rows that equal one independent sample of each channel, if its residual is the sensor's noise and an error of the
/// model: [2n]
///
///   m_c = (ν² m_noise + max(s² - ν², ρ²) m_model) / s²
///
///   s   scale of the channel    ν   its noise in the compared band    ρ   the smallest error that it resolves
///   m_noise, m_model            Evidence::noise_rows(), Evidence::correlated_rows()
std::vector<double> independent_rows(const Evidence& evidence, const std::vector<double>& scale);

/// Sensitivities of the fitting rows to parameters, by one-sided differences; empty if one could not be integrated.
std::vector<std::vector<double>> sensitivities(const Evidence& evidence, const Hypothesis& at,
                                               const std::vector<FitParameter>& parameters);

/// Fits `parameters`, except whole numbers, which keep their value. The first of them are linear: they have the constant
/// sensitivities `linear`. Whole numbers are not among these.
Fit fit(const Evidence& evidence, const Hypothesis& start, const std::vector<FitParameter>& parameters,
        const std::vector<double>& scale, const FitOptions& options = {},
        const std::vector<std::vector<double>>& linear = {});

}  // namespace halyard
