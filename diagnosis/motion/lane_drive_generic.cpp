#include "diagnosis/motion/lane_drive_body.h"

namespace halyard {

LaneDrive generic_lane_drive() { return {drive_lanes, replay_lanes}; }

}  // namespace halyard
