#pragma once
/// Products and triangular roots of small dense matrices, compiled once for each instruction set as lane_kernels.h is.
/// Eigen would be compiled for the generic set only: at 12 states a root took it 7 times as long.
///
/// Matrices are column-major. The columns of a LaneMatrix (lane_matrix.h) start at multiples of kLaneWidth; what is
/// between its rows and that is zero.

#include <vector>

#include "transmission/scalar.h"

namespace halyard {

struct MatrixKernels {
  const char* name;
  /// C += A B, with A [blocks kLaneWidth x k] and C [blocks kLaneWidth x m] in lanes, B [k x m].
  void (*add_product)(int blocks, int k, int m, const Lanes* A, const double* B, int b_stride, Lanes* C);
  /// The lower triangular L [n x n] with L Lᵀ = Aᵀ A and diagonal >= 0, by Householder reflections of A [m x n],
  /// m >= n, whose columns take `blocks` lanes each. A is overwritten; L above the diagonal is not touched.
  void (*lower_root)(int n, int blocks, Lanes* A, double* L, int l_stride);
};

/// The widest that this processor has first, the generic one last.
const std::vector<MatrixKernels>& matrix_kernels();

}  // namespace halyard
