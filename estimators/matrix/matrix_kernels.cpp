#include "estimators/matrix/matrix_kernels.h"

#include "transmission/lanes/instruction_set.h"

namespace halyard {

extern const MatrixKernels kMatrix_generic;
#if defined(HALYARD_WIDE_LANES)
extern const MatrixKernels kMatrix_avx2, kMatrix_avx512;
#endif

const std::vector<MatrixKernels>& matrix_kernels() {
#if defined(HALYARD_WIDE_LANES)
  static const std::vector<MatrixKernels> usable =
      usable_copies<MatrixKernels>({&kMatrix_generic, &kMatrix_avx2, &kMatrix_avx512});
#else
  static const std::vector<MatrixKernels> usable = usable_copies<MatrixKernels>({&kMatrix_generic});
#endif
  return usable;
}

}  // namespace halyard
