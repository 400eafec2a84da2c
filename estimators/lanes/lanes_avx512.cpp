#include "estimators/lanes/lane_kernel_body.h"

namespace halyard {

extern const LaneKernels kLanes_avx512;
const LaneKernels kLanes_avx512 = kernels_named("avx512");

}  // namespace halyard
