#pragma once
/// Some effects have parameters that make them this effect, as the rate makes a drift of friction (another_at,
/// ../search_space.h). Without them they are another one: friction that is off, and stays so. A hysteresis whose loop
/// yields at once is a softer cable. But the earliest yield that the library allows still takes energy from the motion,
/// and can show: what decides is the fit of the softer cable itself.

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/refit.h"

namespace halyard {

/// True if `effect` is `other` at an end of an essential shape (ParameterSearch::another): a loop that yields at once
/// is a softer cable. Friction that drifts at no rate, in contrast, is friction whatever it is called: a rate is no
/// shape.
bool becomes(const PlacedEffect& effect, const PlacedEffect& other, const ArmParameters<double>& arm);

/// The effect, which becomes() the other one, where it is that, or as near to it as its bounds allow.
PlacedEffect at_the_end_that_is(const PlacedEffect& other, PlacedEffect effect, const ArmParameters<double>& arm);

/// True if the effect at `place` has essential parameters and the other effect (SearchSpace::another), or the effect
/// itself without them, explains as much. False beside that other effect: it has convinced beside it. with: its
/// hypothesis is Refit::at; what is held there stays held.
bool is_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge, const Refit& with,
                       std::size_t place);

}  // namespace halyard
