#include "diagnosis/prediction/room.h"

#include <fmt/format.h>

#include "estimators/process/arm_dynamics.h"
#include "estimators/process/process_model.h"
#include "model/input_error.h"

namespace halyard {
namespace {

int states_of(const std::vector<PlacedEffect>& effects) {
  int states = 0;
  for (const PlacedEffect& e : effects) states += e.effect->n_states();
  return states;
}

int most_states(int n_joints) { return kMaxStates - 2 * n_joints; }

}  // namespace

bool has_room(const std::vector<PlacedEffect>& effects, int n_joints) {
  return states_of(effects) <= most_states(n_joints);
}

std::string fastest_state(const ArmModel& model) {
  try {
    const ProcessModel process(model);
    return fmt::format(": {} settles at {:.2g} 1/s at standstill", process.stiffest_state(), process.stiffest_rate());
  } catch (const std::runtime_error&) {
    return "";
  }
}

void refuse_to_predict(const ArmModel& model, const std::string& motion) {
  if (!has_room(model.effects, model.n()))
    throw InputError(fmt::format("{}: its effects have {} internal states; expected at most {}: place fewer of them",
                                 model.source, states_of(model.effects), most_states(model.n())));
  throw InputError(fmt::format(
      "{}: cannot be integrated along the {}{}; expected frictions and cables that settle more slowly: take larger "
      "smoothing speeds, or less damping",
      model.source, motion, fastest_state(model)));
}

}  // namespace halyard
