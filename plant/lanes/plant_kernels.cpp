#include "plant/lanes/plant_kernels.h"

#include "transmission/lanes/instruction_set.h"

namespace halyard {

extern const PlantKernels kPlant_generic;
#if defined(HALYARD_WIDE_LANES)
extern const PlantKernels kPlant_avx2, kPlant_avx512;
#endif

const std::vector<PlantKernels>& plant_kernels() {
#if defined(HALYARD_WIDE_LANES)
  static const std::vector<PlantKernels> usable =
      usable_copies<PlantKernels>({&kPlant_generic, &kPlant_avx2, &kPlant_avx512});
#else
  static const std::vector<PlantKernels> usable = usable_copies<PlantKernels>({&kPlant_generic});
#endif
  return usable;
}

}  // namespace halyard
