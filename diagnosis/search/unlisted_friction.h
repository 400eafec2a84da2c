#pragma once
/// Is a named friction really Coulomb and viscous friction? The library describes friction by these two laws. A drag
/// that grows faster than the speed (churned grease, a fluid around the arm) is fitted by more viscous and less Coulomb
/// friction, and leaves little. It is therefore compared with the name itself:
///
///   F' = F - (c_2 |v| + c_3 v²) v
///
///   c_2, c_3   at least 0, N m s²/rad² and N m s³/rad³ | N s²/m² and N s³/m³      v   rate of the joint
///
/// The name is replaced by this effect, everything is fitted again, and both compete by their gain on the deciding
/// blocks and by their prior costs. The library does not contain this effect, so it can take a name away but not get
/// one: P(none) of the name is at least its weight.

#include "diagnosis/search/attribution.h"

namespace halyard {

/// Sets Naming::unlisted of the added effects that are friction of a joint or of a motor. model: with the tolerances
/// of the search.
void weigh_unlisted_friction(const Evidence& evidence, const ArmModel& model, Attribution& found);

}  // namespace halyard
