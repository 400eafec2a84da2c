#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// Units of a joint's position: `si` in files, `shown` in reports.
struct JointUnit {
  std::string si;     ///< rad | m
  std::string shown;  ///< deg | mm
  double shown_per_si = 1;
};

/// What stands behind a number of this unit: " N m"; nothing for "1".
inline std::string unit_suffix(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

/// Units of every joint of the arm.
inline std::vector<JointUnit> joint_units(const ArmModel& model) {
  std::vector<JointUnit> units;
  for (int k = 0; k < model.n(); ++k) {
    const bool revolute = model.nominal.joint[k].type == JointType::revolute;
    units.push_back(revolute ? JointUnit{"rad", "deg", 180 / std::numbers::pi} : JointUnit{"m", "mm", 1e3});
  }
  return units;
}

}  // namespace halyard
