#include "estimators/built_in.h"
#include "plugins/estimator_plugin.hpp"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<halyard::make_kinematics>(
      "kinematics", "joint positions from motor angles alone, with rigid cables");
  return &table;
}
