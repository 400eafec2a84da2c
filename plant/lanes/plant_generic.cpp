#include "plant/lanes/plant_kernel_body.h"

namespace halyard {

extern const PlantKernels kPlant_generic;
const PlantKernels kPlant_generic = own_kernels();

}  // namespace halyard
