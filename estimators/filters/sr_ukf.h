#pragma once
/// The square-root unscented Kalman filter. Sigma points X_0 = x and X_±i = x ± γ S_i, γ² = n + λ = α² (n + κ), share
/// one weight W = 1 / (2 (n + λ)); the central point's are W_0m = 1 - 2nW and W_0c = W_0m + 1 - α² + β. With the
/// paper's α = 1e-3 and 12 states these are 4e4 and -1e6, and sums with them lose a motor angle of 431 rad. Written
/// relative to the central point the large weight cancels exactly:
///
///   d_i = f(X_i) - f(X_0),   δ = W Σ d_i
///   x = f(X_0) + δ,   P = W Σ d_i d_iᵀ + (β - α²) δ δᵀ + Q
///
/// so that S is one triangularisation of [√W d_i, √(β - α²) δ, Q_root]: a down-date is left only where β < α². A δ no
/// larger than what the rounding of 2n points can add up to, 2n W · 4 eps |X|, is taken as none.
///
/// A measurement that is affine is taken exactly. Otherwise, with e_i = h(X_i) - h(X_0) at sigma points of the
/// prediction and ε = W Σ e_i,
///
///   ẑ = h(X_0) + ε,   S_y = root of [√W e_i, √(β - α²) ε, R_root],   K = (W Σ d_i e_iᵀ) S_y⁻ᵀ S_y⁻¹
///   S = root of [√W (d_i - K e_i), √(β - α²) K ε, K R_root]
///
/// Source: van der Merwe and Wan, "The square-root unscented Kalman filter for state and parameter-estimation",
/// ICASSP 2001; weights of Haghighipanah et al., IROS 2015.

#include <limits>

#include "estimators/filters/gaussian_filter.h"

namespace halyard {

/// Spread of the sigma points, prior knowledge (2 is best for a Gaussian), secondary spread.
struct UkfWeights {
  double alpha = 1e-3;
  double beta = 2;
  double kappa = 0;
  /// δ of a state that is more than this share of √(W Σ d_i²) is left out. Spread over a kink (a cable that goes slack,
  /// a gap that closes), sigma points with a small alpha see a curvature of slope difference / γ: δ grows without bound
  /// although Jensen's inequality, δ² <= W Σ d_i², limits it, and even below that limit it is no Taylor term that
  /// could be trusted unless it is small.
  double curvature_limit = std::numeric_limits<double>::infinity();
};

class SquareRootUkf : public GaussianFilter {
 public:
  /// Throws std::invalid_argument unless alpha > 0. n + kappa must be positive for the states' number n.
  explicit SquareRootUkf(const UkfWeights& weights = {});

  void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) override;
  Innovation update(const MeasurementModel& measurement, const Eigen::VectorXd& z, const Eigen::MatrixXd& R_root,
                    double gate) override;

 private:
  /// √W (X_±i - x) of the old sigma points.
  Eigen::MatrixXd columns_before(const Eigen::MatrixXd& S_0) const override;
  double spread_squared() const;  // γ²
  void place_sigma_points(Eigen::MatrixXd& X) const;
  /// L = root of [A, √c v], c = β - α² of any sign; A: [n x m].
  void root_with_central(Eigen::MatrixXd& columns, const Eigen::VectorXd& v, Eigen::MatrixXd& L);

  UkfWeights weights_;
  Eigen::MatrixXd X_, columns_;
};

}  // namespace halyard
