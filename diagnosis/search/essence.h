#pragma once
/// An effect has sizes that make it this effect, as the rate makes a drift of friction (is_essential,
/// ../search_space.h). Without them it is another one: friction that is off, and stays so.

#include "diagnosis/judgement/judge.h"
#include "diagnosis/search/refit.h"

namespace halyard {

/// True if the effect at `place` has essential sizes but explains as much without them. with: its hypothesis is
/// Refit::at; what is held there stays held.
bool is_another_effect(const Evidence& evidence, const Refitter& refitter, const Judge& judge, const Refit& with,
                       std::size_t place);

}  // namespace halyard
