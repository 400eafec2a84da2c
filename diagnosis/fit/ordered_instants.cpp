#include "diagnosis/fit/ordered_instants.h"

#include <algorithm>

namespace halyard {

Hypothesis with_ordered_instants(Hypothesis h, const std::vector<FitParameter>& parameters) {
  for (const ParameterGroup& group : groups_of(parameters)) {
    const std::vector<FitParameter> instants = instants_of(parameters, group);
    if (instants.size() != 2) continue;
    const double start = parameter_value(h, instants[0]), stop = parameter_value(h, instants[1]);
    if (start <= stop) continue;
    set_parameter(h, instants[0], stop);
    set_parameter(h, instants[1], start);
    for (const std::size_t i : group.sizes) set_parameter(h, parameters[i], -parameter_value(h, parameters[i]));
  }
  return h;
}

}  // namespace halyard
