#include "estimators/lanes/lane_kernel_body.h"

namespace halyard {

extern const LaneKernels kLanes_avx2;
const LaneKernels kLanes_avx2 = kernels_named("avx2");

}  // namespace halyard
