#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_sr_ukf>(
      "sr_ukf", "square-root unscented Kalman filter on the arm's full dynamics");
  return &table;
}
