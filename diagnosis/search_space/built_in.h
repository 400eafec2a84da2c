#pragma once
/// Refined search spaces of the library's effects whose bounds and neutral values are not enough; one file for each
/// folder of transmission/effects.

#include <span>

#include "diagnosis/search_space.h"

namespace halyard {

struct BuiltInSpace {
  const char* effect;
  /// joint: 0-based; 0 for an effect of the whole arm.
  void (*refine)(SearchSpace& space, const ArmParameters<double>& arm, int joint);
};

std::span<const BuiltInSpace> cable_spaces();
std::span<const BuiltInSpace> joint_spaces();
std::span<const BuiltInSpace> motor_spaces();
std::span<const BuiltInSpace> sensor_spaces();

}  // namespace halyard
