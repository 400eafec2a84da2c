#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_disturbance_sr_ukf>(
      "disturbance_sr_ukf", "sr_ukf that also estimates unknown forces on the joints, and the cables' forces");
  return &table;
}
