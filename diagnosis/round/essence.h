#pragma once
/// Some effects have parameters that make them this effect, as the rate makes a drift of friction (another_at,
/// ../search_space.h). Without them they are another one: friction that is off, and stays so.

#include <optional>

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/refit.h"

namespace halyard {

/// True if `effect` is `other` at an end of an essential shape (ParameterSearch::another): a loop that yields at once
/// is a softer cable. Friction that drifts at no rate, in contrast, is friction whatever it is called: a rate is no
/// shape.
bool becomes(const PlacedEffect& effect, const PlacedEffect& other, const ArmParameters<double>& arm);

/// Nothing if the effect at `place` needs its essential parameters or has none. Otherwise it explains as much without
/// them, and this is how. with: its hypothesis is Refit::at; what is held there stays held.
std::optional<WithoutEssence> as_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge,
                                                const Refit& with, std::size_t place);

}  // namespace halyard
