#pragma once
/// Products, triangular roots and φ functions of small dense matrices, compiled once for each instruction set as
/// lane_kernels.h is. Eigen would be compiled for the generic set only: at 12 states a root took it 7 times as long.
///
/// Matrices are column-major. The columns of a LaneMatrix (lane_matrix.h) start at multiples of kLaneWidth; what is
/// between its rows and that is zero.

#include <vector>

#include "transmission/scalar.h"

namespace halyard {

/// A right factor [k x m]: entry (l, c) is at data[l row + c column], so that a transposed matrix can be one, too.
struct RightFactor {
  const double* data;
  int row, column;
};

/// The shape of Z [n x n] in phi_functions.h: `first` kinematic rows, then rows of any kind up to `end`, then zeros.
struct PhiShape {
  int n, first, end;
};
/// Matrices in lanes, whose rows from PhiShape::end on are zero but for those of E: [n x n]; the φ_k [n x end - first].
struct PhiLevelMemory {
  Lanes *E, *phi_1, *phi_2, *phi_3;
};
struct PhiMemory {
  const PhiLevelMemory* level;  ///< [most + 1]
  const Lanes* weight;          ///< D_j / D_i
  Lanes *Y, *Y2, *Y3, *next;
};

inline constexpr int kMostRootRows = 256;

struct MatrixKernels {
  const char* name;
  /// C = A B, or C += A B if `add`, with A [rows x k] and C [rows x m] in lanes, `a_blocks` and `c_blocks` a column.
  void (*product)(int rows, int k, int m, const Lanes* A, int a_blocks, const RightFactor& B, Lanes* C, int c_blocks,
                  bool add);
  /// Of A [n x m], m >= n, n <= kMostRootRows, whose columns take `blocks` lanes each: the first `steps` columns of the
  /// lower triangular L [n x n] with L Lᵀ = A Aᵀ and diagonal >= 0, by as many Householder reflections of A's rows. A
  /// is overwritten; its rows and columns from `steps` on hold the rest B, with L Lᵀ + B Bᵀ = A Aᵀ. L above the
  /// diagonal becomes zero.
  void (*lower_root)(int n, int m, int steps, int blocks, Lanes* A, double* L, int l_stride);
  /// The exact correction of a root S [n x n] with m measurements H x [m x n], whose noises are independent and have a
  /// variance of one: L [m x m] and G [n x m] with L Lᵀ = I + H S Sᵀ Hᵀ, L lower triangular, G Lᵀ = S Sᵀ Hᵀ; S becomes
  /// S' with S' S'ᵀ = S Sᵀ - G Gᵀ. S and G: in lanes, `blocks` a column. One measurement after the other (Potter): with
  /// w = Sᵀ h and l² = 1 + wᵀ w, the column of G is S w / l, and S' = S - S w wᵀ / (l (l + 1)).
  void (*correct)(int n, int m, int blocks, const double* H, int h_stride, Lanes* S, Lanes* G, double* L, int l_stride);
  /// Σ_r A_rc² of each column of A [rows x columns].
  void (*column_squares)(int rows, int columns, const Lanes* A, int blocks, double* squares);
  /// Σ_c A_rc² of each row.
  void (*row_squares)(int rows, int columns, const Lanes* A, int blocks, double* squares);
  /// B [rows x columns] = A; strides: of columns.
  void (*copy)(int rows, int columns, const double* A, int a_stride, double* B, int b_stride);
  /// B [columns x rows] = Aᵀ, A [rows x columns]; strides: of columns.
  void (*transpose)(int rows, int columns, const double* A, int a_stride, double* B, int b_stride);
  /// The functions of phi_functions.h, of all levels, from Y = Z. Returns the number of doublings; if this would exceed
  /// `most`, or Y is not finite, -1, and nothing is computed.
  int (*phi_functions)(const PhiShape& shape, int most, const PhiMemory& memory);
};

/// The widest that this processor has first, the generic one last.
const std::vector<MatrixKernels>& matrix_kernels();
inline const MatrixKernels& widest_matrix_kernels() {
  static const MatrixKernels& widest = matrix_kernels()[0];
  return widest;
}

}  // namespace halyard
