#pragma once
/// The numbers of a final fit with their 95 % intervals, as a diagnosis tells them.

#include <vector>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/fit.h"

namespace halyard {

/// Parameter i of the fit. Its interval counts that a number of the model lies anywhere within its tolerance, with the
/// variance of a uniform distribution (JCGM 100:2008, Guide to the expression of uncertainty in measurement, 4.3.7). It
/// does not reach beyond what the number can be. That of a size of an effect that was found ends at the neutral value.
/// given: number of effects that the model came with.
Estimated estimate_of(const Fit& fit, std::size_t i, std::size_t given);

/// The fitted parameters of the effect with that index, and its whole numbers, which have no interval.
/// told: the same effect with its instants on the clock on which they are told.
std::vector<Estimated> estimated_parameters(const Evidence& evidence, const ArmParameters<double>& nominal,
                                            const Fit& fit, std::size_t effect, std::size_t given,
                                            const PlacedEffect& told);

}  // namespace halyard
