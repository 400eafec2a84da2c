#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_smoother>(
      "smoother", "fixed-lag smoother: sr_ukf forwards, and back over a window of later samples");
  return &table;
}
