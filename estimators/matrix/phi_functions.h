#pragma once
/// The exponential of a matrix and the functions φ_k of the exponential integrators:
///
///   E = exp(Z),   φ_k(Z) = Σ_{i>=0} Z^i / (i + k)!,   so that φ_0 = E and Z φ_k+1 = φ_k - I / k!
///
/// By scaling and doubling: with Y = Z / 2^s such that ‖Y²‖^(1/2) and ‖Y³‖^(1/3), which bound the growth of all higher
/// powers, are at most 2 in the 1-norm, the Taylor polynomial of degree 11 gives φ_3(Y) with a relative error of 2e-8,
/// which is far below the noise of a filter; then s times
///
///   φ_k(2Y) = 2^-k (E φ_k(Y) + Σ_{j=1..k} φ_j(Y) / (k - j)!),   E(2Y) = E(Y)²
///
/// Mechanical systems have kinematic rows, q' = v. With p of them, then m rows of any kind, and no others but zeros,
///
///   Z = [ 0 y I  0 ; K D B ; 0 0 0 ]
///
/// the φ_k, k > 0, are wanted for vectors only that are zero but for those m rows: φ_k V, with the columns V of the
/// unit matrix. Their kinematic rows are y times rows of φ_k+1 V, and the rest of E is I + φ_1 V [K D B]. So about half
/// of each product is needed.
///
/// The states have units of different size, so that the norm of Z means little. It is that of D⁻¹ Z D, with a diagonal
/// D of powers of two for which rows and columns have like norms.
///
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010 (φ_k); Skaflestad and Wright, "The
/// scaling and modified squaring method for matrix functions related to the exponential", Applied Numerical Mathematics
/// 59 (2009) (doubling); Al-Mohy and Higham, SIAM Journal on Matrix Analysis and Applications 31 (2009) (norms of
/// powers); Parlett and Reinsch, Numerische Mathematik 13 (1969) (balancing).

#include "estimators/matrix/lane_matrix.h"

namespace halyard {

class PhiFunctions {
 public:
  static constexpr int kMostDoublings = 16;

  PhiFunctions() = default;
  PhiFunctions(const PhiFunctions&) = delete;
  PhiFunctions& operator=(const PhiFunctions&) = delete;

  /// Chooses D for matrices like this one. Without this call, and if Z is not finite, D is the unit matrix.
  void balance(Eigen::MatrixXd Z);
  /// The largest entry of D⁻¹ (A - B) D, or NaN; after balance().
  double distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) const;
  /// Of Z = h A [n x n] of this shape: p and p + m. False, and the functions are not computed, if Z is not finite or s
  /// would exceed kMostDoublings.
  bool compute(double h, const Eigen::MatrixXd& A, const PhiShape& shape);

  /// The functions of Z / 2^k: E [n x n], φ_1 V to φ_3 V [n x m].
  struct Level {
    LaneMatrix E, phi_1, phi_2, phi_3;
  };
  const Level& level(int k) const { return levels_[static_cast<std::size_t>(k)]; }
  int doublings() const { return doublings_; }  ///< s, at least 1: the last level

 private:
  void take_memory(const PhiShape& shape);
  void set_weights(const Eigen::ArrayXd& scale);

  PhiShape shape_{0, 0, 0};
  int doublings_ = 0;
  LaneMatrix weight_;  // D_j / D_i
  std::vector<Level> levels_;
  std::vector<PhiLevelMemory> memory_;  // of levels_
  LaneMatrix Y_, Y2_, Y3_, next_;
};

}  // namespace halyard
