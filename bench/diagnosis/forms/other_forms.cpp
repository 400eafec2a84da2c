#include <algorithm>

#include "bench/diagnosis/forms/unregistered.h"

namespace halyard::blind {

std::vector<OtherForm> other_forms() {
  static const OwnedEffects owned = [] {
    OwnedEffects all;
    add_friction_forms(all);
    add_cable_forms(all);
    add_motor_forms(all);
    return all;
  }();
  std::vector<OtherForm> forms;
  for (const auto& [effect, like, beside] : owned)
    if (find_effect(like)) forms.push_back({effect.get(), like, beside});
  return forms;
}

}  // namespace halyard::blind
