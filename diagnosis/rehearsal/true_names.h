#pragma once
/// Which names of a diagnosis are right about an arm that is known.

#include <string>
#include <vector>

#include "diagnosis/rehearse.h"

namespace halyard {

/// Names that are right of a part of an effect: of friction that drifts, other friction than the model's.
std::vector<std::string> names_of_parts(const std::string& effect);

/// Effects of the library that change a number of the arm which is off the model's by more than its tolerance.
std::vector<PlacedEffect> effects_beyond_tolerance(const ArmModel& model, const ArmParameters<double>& arm);

/// Compares each name with the truth once, so that a second name for the same effect is false: sets
/// HiddenEffect::is_named and adds Rehearsal::names. In an arm of one joint, an effect of the arm and of the joint are
/// the same. neither: names that are neither right nor false.
void score_names(const std::vector<NamedEffect>& names, const std::vector<PlacedEffect>& neither, int joints,
                 Rehearsal& rehearsal);

}  // namespace halyard
