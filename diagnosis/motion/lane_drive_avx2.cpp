#include "diagnosis/motion/lane_drive_body.h"

namespace halyard {

extern const LaneDrive kDrive_avx2;
const LaneDrive kDrive_avx2 = {drive_lanes, replay_lanes};

}  // namespace halyard
