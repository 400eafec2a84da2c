#pragma once
/// How many internal states the effects of a predicted arm may have.

#include <string>
#include <vector>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// False if the effects have more states than a driven arm has room for: it cannot be predicted.
bool has_room(const std::vector<PlacedEffect>& effects, int n_joints);

/// Throws InputError: the model cannot be predicted along this motion, and why.
[[noreturn]] void refuse_to_predict(const ArmModel& model, const std::string& motion);

}  // namespace halyard
