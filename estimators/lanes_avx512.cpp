#include "estimators/lane_kernel_body.h"

namespace halyard {

extern const LaneKernels kLanes_avx512;
const LaneKernels kLanes_avx512 = {"avx512", advance_lanes};

}  // namespace halyard
