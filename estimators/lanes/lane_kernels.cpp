#include "estimators/lanes/lane_kernels.h"

#include "transmission/lanes/instruction_set.h"

namespace halyard {

extern const LaneKernels kLanes_generic;
#if defined(HALYARD_WIDE_LANES)
extern const LaneKernels kLanes_avx2, kLanes_avx512;
#endif

const std::vector<LaneKernels>& lane_kernels() {
#if defined(HALYARD_WIDE_LANES)
  static const std::vector<LaneKernels> usable =
      usable_copies<LaneKernels>({&kLanes_generic, &kLanes_avx2, &kLanes_avx512});
#else
  static const std::vector<LaneKernels> usable = usable_copies<LaneKernels>({&kLanes_generic});
#endif
  return usable;
}

}  // namespace halyard
