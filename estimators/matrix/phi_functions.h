#pragma once
/// The exponential of a matrix and the functions φ_k of the exponential integrators:
///
///   E = exp(Z),   φ_k(Z) = Σ_{i>=0} Z^i / (i + k)!,   so that φ_0 = E and Z φ_k+1 = φ_k - I / k!
///
/// By scaling and doubling: with Y = Z / 2^s of 1-norm at most 1/2, the Taylor polynomial of degree 8 gives φ_3(Y) with
/// a relative error of 2e-11; then s times
///
///   φ_k(2Y) = 2^-k (E φ_k(Y) + Σ_{j=1..k} φ_j(Y) / (k - j)!),   E(2Y) = E(Y)²
///
/// The states have units of different size, so that the norm of Z means little. It is that of D⁻¹ Z D, with a diagonal
/// D of powers of two for which rows and columns have like norms.
///
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010 (φ_k); Skaflestad and Wright, "The
/// scaling and modified squaring method for matrix functions related to the exponential", Applied Numerical Mathematics
/// 59 (2009) (doubling); Parlett and Reinsch, Numerische Mathematik 13 (1969) (balancing).

#include "estimators/matrix/lane_matrix.h"

namespace halyard {

class PhiFunctions {
 public:
  /// Chooses D for matrices like this one. Without this call, and if Z is not finite, D is the unit matrix.
  void balance(Eigen::MatrixXd Z);
  /// Z [n x n]. False, and the functions are not computed, if Z is not finite or its norm is beyond 2^20.
  bool compute(const Eigen::Ref<const Eigen::MatrixXd>& Z);

  const LaneMatrix& E() const { return E_; }
  const LaneMatrix& E_half() const { return E_half_; }  ///< exp(Z / 2)
  const LaneMatrix& E_part() const { return E_part_; }  ///< exp(Z / parts())
  int parts() const { return parts_; }                  ///< 2^s
  const LaneMatrix& phi_1() const { return phi_[0]; }
  const LaneMatrix& phi_2() const { return phi_[1]; }
  const LaneMatrix& phi_3() const { return phi_[2]; }

 private:
  void polynomials();
  void double_argument();
  void restore_units(LaneMatrix& A) const;

  int parts_ = 1;
  Eigen::ArrayXd scale_;  // D
  LaneMatrix Y_, Y2_, Y3_, E_, E_part_, E_half_, phi_[3], next_[3];
};

}  // namespace halyard
