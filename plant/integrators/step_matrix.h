#pragma once
/// The linear systems of a linearly implicit step:
///
///   (1 / (γ h) - J) g = r
///
///   J   ∂y'/∂y      [size x size]
///   γ   coefficient of the method;  h   step, s
///
/// Positions follow from rates, because x' = v, and meters from all others, because nothing depends on them. So only
/// the rates and the states of effects, the core, need a decomposition:
///
///   (1 / (γ h) - J_cc - γ h J_cx E) g_c = r_c + γ h J_cx r_x,     g_x = γ h (r_x + E g_c)
///
///   c, x   core; positions of joints and of motors that drive cables
///   E      selects the rate of each position

#include <Eigen/Core>
#include <vector>

#include "plant/lanes/plant_layout.h"

namespace halyard {

class StepMatrix {
 public:
  explicit StepMatrix(const PlantLayout& layout);

  /// Decomposes the matrix for this J and γ h.
  void factor(const Eigen::MatrixXd& J, double gamma_h);
  /// r [size] becomes g.
  void solve(double* r) const;

 private:
  static constexpr int kMeters = 2;
  int size_;
  int meters_[kMeters];
  std::vector<int> position_;  ///< [n_x]
  std::vector<int> core_;      ///< the rates of the positions, in the same order, then the states of effects [n_c]
  double gamma_h_ = 0;
  // Row after row. Library routines take longer to begin than these few rows take.
  std::vector<double> lu_;             ///< [n_c x n_c], unit lower and upper triangle; 1 / pivot on the diagonal
  std::vector<double> position_part_;  ///< γ h J_cx [n_c x n_x]
  std::vector<double> meter_part_;     ///< rows of J of the meters [2 x size]
  std::vector<int> row_;               ///< row of the system that is row i of the factors
  mutable std::vector<double> right_;  ///< [n_c]
};

}  // namespace halyard
