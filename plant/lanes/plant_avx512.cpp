#include "plant/lanes/plant_kernel_body.h"

namespace halyard {

extern const PlantKernels kPlant_avx512;
const PlantKernels kPlant_avx512 = own_kernels();

}  // namespace halyard
