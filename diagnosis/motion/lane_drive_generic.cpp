#include "diagnosis/motion/lane_drive_body.h"

namespace halyard {

extern const LaneDrive kDrive_generic;
const LaneDrive kDrive_generic = {drive_lanes, replay_lanes};

}  // namespace halyard
