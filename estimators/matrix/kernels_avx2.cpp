#include "estimators/matrix/matrix_kernel_body.h"

namespace halyard {

extern const MatrixKernels kMatrix_avx2;
const MatrixKernels kMatrix_avx2 = matrix_kernels_named("avx2");

}  // namespace halyard
