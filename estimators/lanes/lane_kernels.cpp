#include "estimators/lanes/lane_kernels.h"

#include "estimators/lanes/instruction_set.h"

namespace halyard {

extern const LaneKernels kLanes_generic;
#if defined(__x86_64__)
extern const LaneKernels kLanes_avx512, kLanes_avx2;
#endif

namespace {

const LaneKernels& kernels_for(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return kLanes_avx512;
  if (set == InstructionSet::avx2) return kLanes_avx2;
#endif
  (void)set;
  return kLanes_generic;
}

}  // namespace

const std::vector<LaneKernels>& lane_kernels() {
  static const std::vector<LaneKernels> usable = [] {
    std::vector<LaneKernels> all;
    for (const InstructionSet set : instruction_sets()) all.push_back(kernels_for(set));
    return all;
  }();
  return usable;
}

}  // namespace halyard
