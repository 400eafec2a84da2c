#pragma once
/// Causes that the library does not have, but that leave little beside a name of the library. Each is compared with
/// the names that it is taken for. It can take a name away but not get one.
///
/// The library describes friction by Coulomb's law and a viscous part. A drag that grows faster than the speed (churned
/// grease, a fluid around the arm) is fitted by more viscous and less Coulomb friction:
///
///   F' = F - (c_2 |v| + c_3 v²) v
///
///   c_2, c_3   at least 0, N m s²/rad² and N m s³/rad³ | N s²/m² and N s³/m³      v   rate of the joint, rad/s | m/s
///
/// A joint's sensor whose zero wanders (with its temperature, or on a loose mount) is fitted by slips of the cable:
///
///   e' = e + Σ_i a_i cos(i π (t - t_0) / T),   i = 0 ... 6
///
///   a_i   rad | m      t_0, T   start and length of the records, s
///
/// The names are replaced by the cause, everything is fitted again, and both compete by their gain on the deciding
/// blocks and by their prior costs: P(none) of a name is at least the weight of the cause.

#include "diagnosis/search/attribution.h"

namespace halyard {

/// Sets Naming::unlisted of the added effects that are friction of a joint or of a motor, or slips of a cable. Slips of
/// one joint are replaced together. model: with the tolerances of the search.
void weigh_unlisted_causes(const Evidence& evidence, const ArmModel& model, Attribution& found);

}  // namespace halyard
