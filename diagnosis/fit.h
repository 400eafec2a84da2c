#pragma once
/// Fits numbers of a hypothesis to the fitting blocks: bounded least squares by Ceres, with sensitivities from
/// hypotheses that run side by side.
///
///   minimise  Σ_c Σ_i (e_ci / s_c)² / m  +  Σ_b ((θ_b - nominal) / (tolerance / 2))²
///
///   e_ci   residual i of channel c            s_c   its scale: the channel's residual before the fit, or its floor
///   m      rows that are worth one independent sample
///   θ_b    baseline numbers, each kept within its tolerance; effects' parameters have bounds and no prior

#include <Eigen/Core>
#include <string>

#include "diagnosis/evidence.h"
#include "diagnosis/search_space.h"

namespace halyard {

/// One number that a fit may move.
struct FitParameter {
  std::string name;
  std::string unit;
  int effect = -1;  ///< place in Hypothesis::effects, or -1: a baseline number
  /// Place in named_parameters(); of an effect its parameter, or kMaxEffectParameters and more: its past.
  int index = 0;
  double nominal = 0;  ///< baseline: the model's value
  double lower = 0, upper = 0;
  double scale = 1;                 ///< one unit of the optimiser
  bool natural_bounds = false;      ///< see ParameterSearch
  bool shape = false;               ///< of an effect, see EffectParameter
  std::vector<double> starts = {};  ///< of a past: in units of its scale
  SearchRange range = SearchRange::own;
};

/// True of what an effect went through before a record: a number of the data and not of the arm.
inline bool is_past(const FitParameter& p) { return p.effect >= 0 && p.index >= kMaxEffectParameters; }
double parameter_value(const Hypothesis& h, const FitParameter& p);
void set_parameter(Hypothesis& h, const FitParameter& p, double value);

/// Baseline numbers that the model knows within a tolerance. The ratio of a drive is one number, the capstan's radius.
std::vector<FitParameter> baseline_parameters(const ArmModel& model);
/// The numbers of the effect at `place` of the hypothesis; instants and positions are bound to what the records span.
/// What the effect went through before each record follows as shapes, unless there are more than a dozen records.
std::vector<FitParameter> effect_parameters(const Evidence& evidence, const Hypothesis& h,
                                            const ArmParameters<double>& nominal, int place);
/// Sizes of an effect and the shapes that follow them, as places in a list of parameters.
struct ParameterGroup {
  std::vector<std::size_t> sizes, shapes;
};
/// The groups of all effects in the list; baseline numbers are in none.
std::vector<ParameterGroup> groups_of(const std::vector<FitParameter>& parameters);
/// True of a number of an effect that went to the end of what is plausible. Its neutral value may be a bound as well:
/// there it is idle, not exhausted.
bool ends_at_bound(const FitParameter& p, double value);
/// True if a change of the effect's parameters is a change of that baseline number: it then speaks for both.
bool effect_covers(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline);

struct FitOptions {
  int iterations = 10;
  double cost_tolerance = 1e-5;  ///< a step that lowers the cost by a smaller share is the last
  /// Sensitivities of baseline numbers are taken once, at the start, and not in every iteration.
  bool frozen_baseline = false;
};

struct Fit {
  Hypothesis hypothesis;
  std::vector<FitParameter> parameters;
  std::vector<double> value, std_deviation;  ///< [parameters]; deviation from the curvature at the end
  Eigen::MatrixXd covariance;                ///< of the values, [parameters x parameters]
  bool usable = false;                       ///< false: the start could not be integrated
};

/// Channel scales from residuals: sqrt(max(mean square, floor²)). [2n]
std::vector<double> channel_scale(const Evidence& evidence, const std::vector<double>& mean_square);

/// Sensitivities of the fitting rows to parameters, by one-sided differences; empty if one could not be integrated.
std::vector<std::vector<double>> sensitivities(const Evidence& evidence, const Hypothesis& at,
                                               const std::vector<FitParameter>& parameters);

/// baseline_sensitivities: of the baseline parameters in `parameters`, in their order, for frozen_baseline.
Fit fit(const Evidence& evidence, const Hypothesis& start, const std::vector<FitParameter>& parameters,
        const std::vector<double>& scale, const FitOptions& options = {},
        const std::vector<std::vector<double>>& baseline_sensitivities = {});

}  // namespace halyard
