#pragma once
/// The plant's state y = [q, q', z], and the terms into which its equations can be split.
///
///   z   [q_m, ω of each cable drive; internal states of the effects; E_in, E_lost]    [n_z]

#include <optional>

#include "transmission/arm_parameters.h"

namespace halyard {

/// Maximum number of states z of one plant.
inline constexpr int kMaxAuxiliaryStates = 80;

/// Layout of the plant's state; indices count from the start of z.
struct PlantLayout {
  int n = 0;                                                           ///< joints
  std::optional<int> motor_angle[kMaxJoints], motor_rate[kMaxJoints];  ///< only of motors that drive cables
  int effect_states = 0;                                               ///< index of the first effect state
  int n_effect_states = 0;
  int input_energy = 0, lost_energy = 0;
  int n_z = 0;
  int size() const { return 2 * n + n_z; }
};

/// Selects terms of the drive's forces and rates.
enum class DriveTerms {
  all,
  cables_and_friction,  ///< of all axes: the stiff terms
  first_cable,          ///< the pull of the first joint's cable alone
};

}  // namespace halyard
