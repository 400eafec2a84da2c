#include "diagnosis/motion/lane_drive_body.h"

namespace halyard {

LaneDrive avx512_lane_drive() { return {drive_lanes, replay_lanes}; }

}  // namespace halyard
