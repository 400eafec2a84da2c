#pragma once
/// Refined search spaces of the library's effects whose bounds and neutral values are not enough; one file for each
/// folder of transmission/effects.

#include <initializer_list>
#include <span>
#include <vector>

#include "diagnosis/search_space.h"

namespace halyard {

struct BuiltInSpace {
  const char* effect;
  /// joint: 0-based; 0 for an effect of the whole arm.
  void (*refine)(SearchSpace& space, const ArmParameters<double>& arm, int joint);
};

/// Starts of a whole order: all from 1 to `all_to`, and some above. A sine of a neighbouring order leaves most of the
/// residual.
inline std::vector<double> whole_orders(int all_to, std::initializer_list<double> above) {
  std::vector<double> orders;
  for (int n = 1; n <= all_to; ++n) orders.push_back(n);
  orders.insert(orders.end(), above);
  return orders;
}

std::span<const BuiltInSpace> cable_spaces();
std::span<const BuiltInSpace> joint_spaces();
std::span<const BuiltInSpace> motor_spaces();
std::span<const BuiltInSpace> sensor_spaces();

}  // namespace halyard
