#pragma once
/// How many internal states the effects of a predicted arm may have.

#include <string>
#include <vector>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// False if the effects have more states than a driven arm has room for: it cannot be predicted.
bool has_room(const std::vector<PlacedEffect>& effects, int n_joints);

/// ": joint_rate_4 settles at 1e+06 1/s at standstill", the fastest state of an arm that cannot be integrated; nothing
/// if it is not known.
std::string fastest_state(const ArmModel& model);

/// Throws InputError: the model cannot be predicted along this motion, and why.
[[noreturn]] void refuse_to_predict(const ArmModel& model, const std::string& motion);

}  // namespace halyard
