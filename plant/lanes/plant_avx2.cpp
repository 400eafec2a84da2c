#include "plant/lanes/plant_kernel_body.h"

namespace halyard {

extern const PlantKernels kPlant_avx2;
const PlantKernels kPlant_avx2 = own_kernels();

}  // namespace halyard
