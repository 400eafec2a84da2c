#include "diagnosis/motion/lane_drive_body.h"

namespace halyard {

extern const LaneDrive kDrive_avx512;
const LaneDrive kDrive_avx512 = {drive_lanes, replay_lanes};

}  // namespace halyard
