#include "estimators/matrix/matrix_kernels.h"

#include "estimators/lanes/instruction_set.h"

namespace halyard {

extern const MatrixKernels kMatrix_generic;
#if defined(__x86_64__)
extern const MatrixKernels kMatrix_avx512, kMatrix_avx2;
#endif

namespace {

const MatrixKernels& matrix_kernels_for(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return kMatrix_avx512;
  if (set == InstructionSet::avx2) return kMatrix_avx2;
#endif
  (void)set;
  return kMatrix_generic;
}

}  // namespace

const std::vector<MatrixKernels>& matrix_kernels() {
  static const std::vector<MatrixKernels> usable = [] {
    std::vector<MatrixKernels> all;
    for (const InstructionSet set : instruction_sets()) all.push_back(matrix_kernels_for(set));
    return all;
  }();
  return usable;
}

}  // namespace halyard
