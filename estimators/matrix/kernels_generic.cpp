#include "estimators/matrix/matrix_kernel_body.h"

namespace halyard {

extern const MatrixKernels kMatrix_generic;
const MatrixKernels kMatrix_generic = matrix_kernels_named("generic");

}  // namespace halyard
