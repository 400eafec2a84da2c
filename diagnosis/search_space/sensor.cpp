#include "diagnosis/search_space/built_in.h"

namespace halyard {
namespace {

void encoder_offset(SearchSpace& space, const ArmParameters<double>&, int) {
  if (space.parameters.size() == 1) return;
  space["at_joint"].starts = {0, 1};
  space["at_joint"].is_whole = true;
}

void encoder_eccentricity(SearchSpace& space, const ArmParameters<double>& arm, int joint) {
  if (arm.joint[joint].type == JointType::revolute) {
    space["order"].starts = whole_orders(32, {36, 40, 48, 64});
    space["order"].is_whole = true;
  } else {
    // Decades of scales. Where a motion is known, they are as close as it can tell them apart (fit_parameter.h).
    space["wave_number"].starts = {20, 43, 93, 200, 430, 930, 2000};
  }
  space.order_of_joint_position = 2;
}

}  // namespace

std::span<const BuiltInSpace> sensor_spaces() {
  static constexpr BuiltInSpace kSpaces[] = {{"encoder_eccentricity", encoder_eccentricity},
                                             {"encoder_offset", encoder_offset}};
  return kSpaces;
}

}  // namespace halyard
