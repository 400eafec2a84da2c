#pragma once
/// The last fit of a diagnosis: on all training data, with the parameters that these data determine.

#include "diagnosis/fit/fit.h"

namespace halyard {

/// Fits the parameters of `chosen` again on `whole`, an Evidence without deciding blocks. The channels have the weights
/// of independent_rows(), by what the fit leaves. Beside added effects, the numbers of the model to which the data were
/// not sensitive without them are fitted, too.
///
/// All numbers of the model stay in the fit, held by their tolerances: a number that was set back to the model's value
/// would be taken for exact, and what it is off would go into the effects' parameters. Sizes of effects that did not
/// change significantly are reset to neutral, one at a time, the least certain first, and the others are fitted again.
/// An effect all of whose sizes are reset has no parameter in the result. The standard deviations of an effect that
/// keeps some of its sizes count what the others may be, and Fit::reset tells what they may be.
/// given: number of effects that the model came with; they stay.
/// If the refit cannot be integrated, the result is that of `chosen`. If `chosen` is only a start, or cannot be
/// integrated either, the result is not usable.
Fit final_fit(const Evidence& whole, const ArmModel& model, const Fit& chosen, std::size_t given);

/// Makes the standard deviations of effects that have lost a parameter (Fit::reset) as large as if they had kept all of
/// them: what was reset may be wrong. A mean square of the deviation in `before`, the fit that still had it, and the
/// shift since then.
void count_resets(const Fit& before, Fit& f);

/// Effects, as indices in the hypothesis, of which no size is left in the fit, or not the essential parameters.
std::vector<std::size_t> idle_effects(const Fit& fit, std::size_t given);

/// True if the fit has a size of the effect with that index.
bool has_a_size(const Fit& fit, std::size_t effect);

/// Half of the 95 % interval over the standard deviation: Student's quantile for the fit's blocks.
double interval_factor(const Fit& fit);

/// Half of the 95 % interval of parameter i, if numbers of the model lie anywhere within their tolerances. A fit takes
/// half a tolerance as one deviation; that of a uniform distribution is larger by 2/√3 (JCGM 100:2008, Guide to the
/// expression of uncertainty in measurement, 4.3.7). The estimate shifts by -H⁻¹ P times what a number is off. So its
/// variance grows by (4/3 - 1) Σ_j (C_ij / σ_j)² over the numbers j; C = H⁻¹, P_jj = 1 / σ_j².
double half_interval(const Fit& fit, std::size_t i);

/// True if the interval of half_interval(), which is the one that is told, contains the parameter's neutral value.
bool may_be_neutral(const Fit& fit, std::size_t i);

/// The numbers of the model that the data changed significantly, as indices of the fit's parameters, and torque scales
/// that the model does not know. A change that moves no channel by its floor does not count. If the data determine only
/// a combination of two numbers, one of them counts.
std::vector<std::size_t> changed_numbers(const Evidence& whole, const ArmModel& model, const Fit& fit);

/// The fit with the numbers of the model as given; only its other parameters are fitted.
Fit with_given_numbers(const Evidence& whole, const ArmModel& model, const Fit& fit);

/// The fit with its effects as they are, and with some of its numbers, indices of its parameters, as given; the others
/// are fitted again. Not usable if it cannot be integrated.
Fit with_numbers_given(const Evidence& whole, const Fit& fit, const std::vector<std::size_t>& numbers);

/// The fit with its effects as they are, and with the model's motion: the numbers on which the motion of the joints
/// depends are as given, and the others (of the motors, of the torque) are fitted again. Not usable if it cannot be
/// integrated.
Fit with_given_motion(const Evidence& whole, const ArmModel& model, const Fit& fit);

}  // namespace halyard
