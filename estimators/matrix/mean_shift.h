#pragma once
/// The shift of the mean of narrow sigma points x ± d_i by a curvature m that acts within a step:
///
///   ∫ exp(A (h - s)) m(s) ds   from 0 to h
///
/// m is half the second derivative times the variance of what is curved. At rest m falls within the step, because the
/// stiff components of d decay: a straight line from m(0) to m(h) would overstate the integral, 17 times for h λ = 4.4.
/// The integral takes
///
///   m_i(s) = m_i(h) + (m_i(0) - m_i(h)) (V_i(s) - V_i(h)) / (V_i(0) - V_i(h)),   V_i(s) = Σ (exp(A s) d)_i²
///
/// where V_i falls, else the straight line. It goes over [0, h / 2^s], [h / 2^s, 2 h / 2^s], ..., [h / 2, h] by the
/// functions of phi_functions.h, with Simpson's mean of V in each, its middle being the geometric mean of the ends.

#include "estimators/matrix/phi_functions.h"

namespace halyard {

class MeanShift {
 public:
  explicit MeanShift(const PhiShape& shape);

  /// shift [n x 1] becomes the integral, with h A = Z / 2^level of phi. S: Sᵀ [n x n], of which d is a multiple;
  /// end_squares [n]: of the rows of E S; first, last [n]: h m(0), h m(h).
  void compute(const PhiFunctions& phi, int level, const LaneMatrix& S, const Eigen::VectorXd& end_squares,
               const Eigen::VectorXd& first, const Eigen::VectorXd& last, LaneMatrix& shift);

 private:
  /// V(0) to V(h) at the nodes 0, h / 2^s, ..., h / 2, h, in variance_.
  void set_variances(const PhiFunctions& phi, int level, const LaneMatrix& S, const Eigen::VectorXd& end_squares);

  const PhiShape shape_;
  const int moving_;            // number of rows that are neither kinematic nor zero
  Eigen::MatrixXd variance_;    // V at the nodes
  LaneMatrix moved_;            // the moving rows of exp(A s) S, transposed
  Eigen::VectorXd at_left_;     // the integral up to a node
  Eigen::VectorXd m_, change_;  // of m between two nodes: at the left one, and to the right one; of the moving rows
};

}  // namespace halyard
