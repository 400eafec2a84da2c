#pragma once
/// Bounded nonlinear least squares by Ceres: Levenberg-Marquardt on the normal equations.
///
///   minimise  |r(u)|²  for  lower <= u <= upper
///
/// Parameters that are pressed against a bound are held there, and the others are fitted, until the same ones are
/// pressed.

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

namespace halyard {

/// When a fit ends. The defaults of the tolerances are those of the diagnosis.
struct LeastSquaresOptions {
  int iterations = 10;
  double cost_tolerance = 1e-5;       ///< after a step that lowers the cost by a smaller share
  double parameter_tolerance = 1e-6;  ///< after a step that is a smaller share of |u|
  double gradient_tolerance = 1e-10;  ///< where no entry of Jᵀ r is larger
};

/// Residuals and Jacobian at a point.
struct LinearisedResidual {
  /// `residual` has one block of parameters, of the size of `u`.
  LinearisedResidual(const ceres::CostFunction& residual, const std::vector<double>& u);

  std::vector<double> r;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
  bool finite = false;  ///< false: the residual could not be evaluated
};

/// Moves `u` to the minimum; a start outside the bounds is first moved to the nearest bound. False if the residual
/// cannot be evaluated at the start. Writes nothing to a log: a trial step that cannot be evaluated is foreseen.
bool minimise(const ceres::CostFunction& residual, const std::vector<double>& lower, const std::vector<double>& upper,
              const LeastSquaresOptions& options, std::vector<double>& u);

}  // namespace halyard
