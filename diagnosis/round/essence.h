#pragma once
/// Some effects have parameters that make them this effect, as the rate makes a drift of friction (another_at,
/// ../search_space.h). Without them they are another one: friction that is off, and stays so. A hysteresis whose loop
/// yields at once is a softer cable. But the earliest yield that the library allows still takes energy from the motion,
/// and can show: what decides is the fit of the softer cable itself.

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/refit.h"

namespace halyard {

/// True if `effect` is `other` at an end of its essential shapes (SearchSpace::another): a loop that yields at once is
/// a softer cable. Friction that drifts at no rate, in contrast, is friction whatever it is called: a rate is no shape.
bool becomes(const PlacedEffect& effect, const PlacedEffect& other, const ArmParameters<double>& arm);

/// `effect`, which becomes() `other`, with the parameters within its bounds that come closest to it; nothing if all its
/// sizes are neutral then.
std::optional<PlacedEffect> at_the_end_that_is(const PlacedEffect& other, PlacedEffect effect,
                                               const ArmParameters<double>& arm);
/// The hypothesis with the other effect (SearchSpace::another) in place of the one at `place`. It is the last effect.
Hypothesis with_the_other_effect(const Refitter& refitter, const Hypothesis& h, std::size_t place);

/// True if the effect at `place` has essential parameters, and explains as much without them: as the other effect
/// (SearchSpace::another), or where it has none, or the model came with it, without the parameters. False if that
/// other effect was found before. with: its hypothesis is Refit::at; what is held there stays held.
bool is_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge, const Refit& with,
                       std::size_t place);

}  // namespace halyard
