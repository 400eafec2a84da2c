#pragma once
/// What a fit may change: numbers of the model within their tolerances, parameters of effects within their bounds, and
/// the states of effects at the start of each record.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fit/evidence.h"
#include "diagnosis/search_space.h"

namespace halyard {

/// One parameter of a fit.
struct FitParameter {
  std::string name;
  std::string unit;
  std::optional<std::size_t> effect = {};  ///< index in Hypothesis::effects; nothing: a baseline parameter
  /// Baseline: index in named_parameters(). Effect: index of its parameter, or of a state of its past.
  std::size_t index = 0;
  double nominal = 0;  ///< baseline: the model's value
  double lower = 0, upper = 0;
  double scale = 1;                 ///< one unit of the optimiser
  bool natural_bounds = false;      ///< see ParameterSearch
  bool shape = false;               ///< a shape of an effect, see EffectParameter
  std::vector<double> starts = {};  ///< start values; for a past in units of its scale
  SearchRange range = SearchRange::own;
  bool is_whole = false;  ///< a whole number: tried at its starts and not fitted
  bool is_wall = false;   ///< see ParameterSearch
  /// An effect's state at the start of a record, which belongs to the data and not to the arm.
  bool is_past = false;
  std::optional<double> another_at = {};  ///< see ParameterSearch
};

/// True if both are the same number.
inline bool is_same_number(const FitParameter& a, const FitParameter& b) {
  return a.effect == b.effect && a.is_past == b.is_past && a.index == b.index;
}

/// Index of the parameter that is the same number, if there is one.
inline std::optional<std::size_t> find_parameter(const std::vector<FitParameter>& parameters, const FitParameter& p) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (is_same_number(parameters[i], p)) return i;
  return {};
}

/// The list without the parameters of the effect with index `gone`, as without_effect() leaves the hypothesis.
std::vector<FitParameter> without_parameters_of(std::vector<FitParameter> parameters, std::size_t gone);
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
                                            const ArmParameters<double>& nominal, std::size_t place);
/// False for an effect that is periodic in a position if the motion contains fewer than kFewestPeriods of its periods
/// even at the highest order.
bool has_enough_periods(const Evidence& evidence, const PlacedEffect& effect, const ArmParameters<double>& nominal);
/// Sizes of an effect and the shapes that follow them, as indices in a list of parameters.
struct ParameterGroup {
  std::vector<std::size_t> sizes, shapes;
};
/// The groups of all effects in the list; baseline parameters are in none.
std::vector<ParameterGroup> groups_of(const std::vector<FitParameter>& parameters);
/// The shapes of a group that are times in a record: for an effect between two instants, its start and its end.
std::vector<FitParameter> instants_of(const std::vector<FitParameter>& parameters, const ParameterGroup& group);
/// True if a fit has taken the parameter to a bound of its range. A number of the model: 95 % of the way to the end of
/// its tolerance, because its prior holds it back. A parameter of an effect: at the bound itself. False at its neutral
/// value, even if that is a bound, and for whole numbers: the lowest order that the motion shows is as plausible as the
/// next.
bool is_at_bound(const FitParameter& p, double value);
/// True if that bound is a physical limit: the true value cannot lie beyond it. A number of the model that cannot be
/// negative has one at 0, if its tolerance reaches so far.
bool is_at_limit(const FitParameter& p, double value);
/// True if an effect's parameter is at a bound that is the end of what is plausible, and no physical limit.
bool ends_at_bound(const FitParameter& p, double value);
/// True if a change of the effect's parameters also changes that baseline parameter.
bool effect_changes(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline);
/// True if it can take the place of that baseline parameter, which is then not fitted beside it; see
/// SearchSpace::numbers_stay.
bool effect_covers(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline);

}  // namespace halyard
