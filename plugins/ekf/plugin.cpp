#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_ekf>(
      "ekf", "extended Kalman filter on the arm's full dynamics, exact Jacobian");
  return &table;
}
