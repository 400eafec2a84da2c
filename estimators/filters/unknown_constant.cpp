#include "estimators/filters/unknown_constant.h"

#include <limits>

namespace halyard {

UnknownLevels read_unknown_levels(OptionReader& options, const std::string& name, const UnknownLevels& usual) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  UnknownLevels levels;
  levels.start = options.per_joint(name + "_start", usual.start, 0, kInfinity);
  levels.wander = options.per_joint(name + "_wander", usual.wander, 0, kInfinity);
  return levels;
}

std::vector<std::optional<int>> states_of(const Effect& constant, const ProcessModel& process) {
  std::vector<std::optional<int>> states(process.n_joints());
  int next = process.layout().effect_states;
  for (const auto& e : process.transmission().effects()) {
    if (e.effect == &constant) states[*e.joint] = next;
    next += e.effect->n_states();
  }
  return states;
}

ArmFilterOptions with_wander(ArmFilterOptions options, const Effect& constant, const ProcessModel& process,
                             const Eigen::VectorXd& wander) {
  const std::vector<std::optional<int>> states = states_of(constant, process);
  for (int k = 0; k < process.n_joints(); ++k)
    if (states[k]) options.noise.wander(*states[k] - process.layout().effect_states) = wander(k);
  return options;
}

}  // namespace halyard
