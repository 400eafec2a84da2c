#include "estimators/lanes/lane_kernel_body.h"

namespace halyard {

extern const LaneKernels kLanes_generic;
const LaneKernels kLanes_generic = kernels_named("generic");

}  // namespace halyard
