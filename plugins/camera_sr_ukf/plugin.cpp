#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_camera_sr_ukf>(
      "camera_sr_ukf", "sr_ukf with a camera that sees the tool, with delay and missing frames");
  return &table;
}
