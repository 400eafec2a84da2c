#pragma once
/// Draws an effect as the library means it, within what the diagnosis takes for it.
///
///   a size       typical times log-uniform(0.5, 3), in either direction if its bounds allow; each is there with
///                probability one half, but at least one is
///   a shape      one of its starts times log-uniform(0.5, 2); a whole number is one of its starts
///   an instant   in the first 10 to 70 % of the record, and at least a tenth of it before the next one
///   a position   in the middle 60 % of the joint's motion
///
/// Stribeck's speed lies near standstill. The motion has at least kFewestPeriods periods of an order, if it has them of
/// any.

#include <optional>
#include <vector>

#include "diagnosis/rehearsal/motion_range.h"
#include "diagnosis/rehearsal/random.h"
#include "diagnosis/search_space.h"
#include "model/arm_model.h"

namespace halyard {

/// A parameter with how the diagnosis looks for it.
struct SearchedParameter {
  EffectParameter p;
  ParameterSearch search;
  bool is_size() const { return search.range == SearchRange::own && !p.is_shape(); }
};
std::vector<SearchedParameter> searched_parameters(const PlacedEffect& effect, const ArmModel& model);

/// One of these effects at one of its places, without sizes: none of `others`, and at `joint` if that is not null.
/// Nothing if there is none.
std::optional<PlacedEffect> draw_effect(const std::vector<const Effect*>& from, const ArmModel& model,
                                        const std::vector<PlacedEffect>& others, const EffectPlace* joint,
                                        Random& random);

/// Draws the parameters of a placed effect.
void draw_parameters(PlacedEffect& effect, const ArmModel& model, const MotionRange& motion, Random& random);

}  // namespace halyard
