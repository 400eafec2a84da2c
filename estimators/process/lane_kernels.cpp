#include "estimators/process/lane_kernels.h"

namespace halyard {

extern const LaneKernels kLanes_generic;
#if defined(HALYARD_LANES_X86)
extern const LaneKernels kLanes_avx512, kLanes_avx2;
#endif

const std::vector<LaneKernels>& lane_kernels() {
  static const std::vector<LaneKernels> usable = [] {
    std::vector<LaneKernels> all;
#if defined(HALYARD_LANES_X86)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma"))
      all.push_back(kLanes_avx512);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(kLanes_avx2);
#endif
    all.push_back(kLanes_generic);
    return all;
  }();
  return usable;
}

}  // namespace halyard
