#include "estimators/matrix/matrix_kernel_body.h"

namespace halyard {

extern const MatrixKernels kMatrix_avx512;
const MatrixKernels kMatrix_avx512 = matrix_kernels_named("avx512");

}  // namespace halyard
