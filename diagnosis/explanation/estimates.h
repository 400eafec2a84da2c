#pragma once
/// The numbers of a final fit with their 95 % intervals, as a diagnosis tells them.

#include <string>
#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/fit.h"

namespace halyard {

/// Parameter i of the fit, with its half_interval() (final_fit.h). The interval does not reach beyond what the number
/// can be. That of a size of an effect that was found ends at the neutral value.
/// given: number of effects that the model came with.
Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given);

/// The fitted parameters of the effect with that index, those that were reset to neutral (Fit::reset), and its whole
/// numbers, which have no interval.
/// told: the same effect with its instants on the clock on which they are told.
std::vector<Estimated> estimated_parameters(const Evidence& evidence, const ArmParameters<double>& nominal,
                                            const Fit& fit, std::size_t effect, std::size_t given,
                                            const PlacedEffect& told);

/// A sentence about each parameter of a named effect and each refitted number that has ended at a bound of its range:
/// "joint 2 link mass: at the end of its tolerance (0.57 to 0.63 kg): the true value may lie beyond; check ...".
std::vector<std::string> bound_lines(const Diagnosis& diagnosis);

}  // namespace halyard
