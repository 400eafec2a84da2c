#pragma once
/// The square-root unscented Kalman filter. The sigma points are X_0 = x and X_±i = x ± γ S_i, γ² = n + λ = α² (n + κ).
/// All X_±i have the weight W = 1 / (2 (n + λ)); the weights of X_0 are W_0m = 1 - 2nW and W_0c = W_0m + 1 - α² + β.
/// With the paper's α = 1e-3 and 12 states, n + λ is so small that W is 4e4 and W_0m is -1e6. A weighted sum of motor
/// angles near 431 rad then has a rounding error of about |W_0m| 431 rad eps = 1e-7 rad. If all points are taken
/// relative to the central point X_0, the large weight cancels exactly:
///
///   d_i = f(X_i) - f(X_0),   δ = W Σ d_i
///   x = f(X_0) + δ,   P = W Σ d_i d_iᵀ + (β - α²) δ δᵀ + Q
///
/// Where γ is small, as with the paper's α, f is quadratic as far as the points reach: d_±i = ± o_i + e_i. Then
/// √(2W) o_i is column i of ∂f/∂x S, and Σ e_i e_iᵀ is γ² times smaller than what δ adds to P and left out. Only δ = 2W
/// Σ e_i needs the points (DiscreteProcess::advance_pairs()).
///
/// So S is one triangularisation of [√W d_i, √(β - α²) δ, Q_root]; a down-date is needed only if β < α². A δ no larger
/// than the rounding errors of 2n points, 2n W · 4 eps |X|, is set to zero.
///
/// The update with an affine measurement is exact. Otherwise, with e_i = h(X_i) - h(X_0) at sigma points of the
/// prediction and ε = W Σ e_i,
///
///   ẑ = h(X_0) + ε,   S_y = root of [√W e_i, √(β - α²) ε, R_root],   K = (W Σ d_i e_iᵀ) S_y⁻ᵀ S_y⁻¹
///   S = root of [√W (d_i - K e_i), √(β - α²) K ε, K R_root]
///
/// Source: van der Merwe and Wan, "The square-root unscented Kalman filter for state and parameter-estimation",
/// ICASSP 2001; weights of Haghighipanah et al., IROS 2015.

#include <Eigen/Cholesky>
#include <limits>

#include "estimators/filters/gaussian_filter.h"

namespace halyard {

/// alpha: spread of the sigma points; beta: prior knowledge, 2 is best for a Gaussian; kappa: secondary spread.
struct UkfWeights {
  double alpha = 1e-3;
  double beta = 2;
  double kappa = 0;
  /// δ of a state is set to zero if it exceeds this fraction of √(W Σ d_i²). At a kink (a cable that goes slack, a gap
  /// that closes) the sigma points see an apparent curvature: the difference of the two slopes, divided by γ. If
  /// alpha is small, δ then exceeds the limit of Jensen's inequality, δ² <= W Σ d_i². Even below that limit, δ is a
  /// reliable Taylor term only if it is small.
  double curvature_limit = std::numeric_limits<double>::infinity();
};

class SquareRootUkf : public GaussianFilter {
 public:
  /// Throws std::invalid_argument unless alpha > 0. n + kappa must be positive, n the number of states.
  explicit SquareRootUkf(const UkfWeights& weights = {});

  void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) override;
  Innovation update(const MeasurementModel& measurement, const ReadingVector& z, const ReadingMatrix& R_root,
                    double gate) override;

 private:
  /// √W (X_±i - x) of the sigma points before the prediction; of pairs √2W (X_i - x).
  int count_columns_before() const override { return (moved_in_pairs_ ? 1 : 2) * static_cast<int>(x_.size()); }
  void set_columns_before(const LaneMatrix::ConstView& S_0, Eigen::Ref<Eigen::MatrixXd> A) const override;
  double spread_squared() const;  // γ²
  /// δ or ε of one component; 0 if it is rounding of numbers of that `size`, or beyond the limit. spread: √(W Σ d_i²).
  double significant_shift(double shift, double size, double spread) const;
  void place_sigma_points(Eigen::MatrixXd& X) const;
  /// Sets x_ to f(x_), the first of predicted_columns_ to √W d_i, of pairs to √2W o_i, and delta_ to W Σ d_i; returns
  /// their number. `others`: number of the columns that follow.
  int move_sigma_points(const DiscreteProcess& process, int others);
  /// L = root of [A, √c v], c = β - α² of any sign; columns: A and a last column that is set here.
  void root_with_central(LaneMatrix& columns, const Eigen::Ref<const Eigen::VectorXd>& v,
                         Eigen::Ref<Eigen::MatrixXd> L);

  UkfWeights weights_;
  bool moved_in_pairs_ = false;
  Eigen::VectorXd size_, delta_, squares_;
  Eigen::MatrixXd X_, P_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  LaneMatrix columns_, e_, K_, repaired_columns_;
};

}  // namespace halyard
