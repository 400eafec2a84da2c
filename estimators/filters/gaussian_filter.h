#pragma once
/// Base class of the nonlinear Kalman filters: a Gaussian belief in square-root form, and interfaces of the process and
/// measurement models.
///
///   x_k = f(x_k-1) + w,  w ~ N(0, Q)       z_k = h(x_k) + v,  v ~ N(0, R)
///
///   x, S    mean, and a square root of its covariance, P = S Sᵀ, lower triangular after predict()   [n], [n x n]
///   Q, R    noise covariances, given by roots Q_root [n x any], R_root [m x m]
///
/// The filters do not depend on the robot. All covariances come from orthogonal triangularisation of their roots, which
/// cannot lose definiteness.

#include <Eigen/Core>
#include <string>
#include <utility>

#include "estimators/estimator.h"
#include "estimators/matrix/lane_matrix.h"

namespace halyard {

/// x_k = f(x_k-1), for one step.
class DiscreteProcess {
 public:
  virtual ~DiscreteProcess() = default;
  /// Every column of X [n x count] becomes f(column).
  virtual void advance(Eigen::MatrixXd& X) const = 0;
  /// F [n x n] becomes ∂f/∂x at the old x; then x becomes f(x).
  virtual void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const = 0;
  /// x becomes f(x), and the first n columns of FS [n x any] ∂f/∂x S, where S is the root of the belief with which the
  /// step began. False: the process has no special way to do so, and x has not changed.
  virtual bool advance_root(Eigen::VectorXd& /*x*/, LaneMatrix& /*FS*/) const { return false; }
  /// The same, and `shift` becomes the mean of f(x ± gamma S_i) - f(x), for a gamma so small that f is quadratic there.
  virtual bool advance_pairs(Eigen::VectorXd& /*x*/, const LaneMatrix& /*S*/, double /*gamma*/, LaneMatrix& /*FS*/,
                             Eigen::VectorXd& /*shift*/) const {
    return false;
  }
  /// F [n x n] becomes ∂f/∂x at x_0, where the last of these calls has started.
  virtual void transition(const Eigen::VectorXd& x_0, LaneMatrix& F) const {
    const int n = static_cast<int>(x_0.size());
    Eigen::VectorXd x = x_0;
    Eigen::MatrixXd jacobian(n, n);
    advance_with_jacobian(x, jacobian);
    F.reshape(n, n);
    F.view() = jacobian;
  }
  /// Name of a state for messages: "joint_rate_2 at 3.1 s".
  virtual std::string name_of(int state) const = 0;
};

/// z = h(x).
class MeasurementModel {
 public:
  virtual ~MeasurementModel() = default;
  /// True if h is affine, so that its linearisation is exact.
  virtual bool is_affine() const = 0;
  /// z [m] becomes h(x).
  virtual void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const = 0;
  /// z [m] becomes h(x), H [m x n] becomes ∂h/∂x.
  virtual void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                         Eigen::Ref<Eigen::MatrixXd> H) const = 0;
};

/// Lower triangular L [n x n] with L Lᵀ = A Aᵀ and diagonal >= 0, by Householder reflections of the rows of A. A: [n x
/// m], m >= n. Keeps its memory.
class LowerRoot {
 public:
  /// A [n x m], for the caller to fill: it holds anything.
  LaneMatrix::View start(int n, int m) {
    columns_.reshape(n, m);
    return columns_.view();
  }
  /// The first columns of L of the matrix that was filled in, as many as `L` has; destroys it.
  void finish(Eigen::Ref<Eigen::MatrixXd> L);
  /// After finish() with k columns: B [n x m], whose rows and columns from k on have B Bᵀ = A Aᵀ - L Lᵀ.
  LaneMatrix::ConstView rest() const { return std::as_const(columns_).view(); }
  void compute(const LaneMatrix& A, Eigen::Ref<Eigen::MatrixXd> L) {
    columns_ = A;
    finish(L);
  }
  void compute(const Eigen::Ref<const Eigen::MatrixXd>& A, Eigen::Ref<Eigen::MatrixXd> L) {
    start(static_cast<int>(A.rows()), static_cast<int>(A.cols())) = A;
    finish(L);
  }

 private:
  LaneMatrix columns_;
};

/// The state x before a prediction, given the state x' after it (a Rauch-Tung-Striebel step):
///
///   x = x_0 + G (x' - x⁻) + v,  v ~ N(0, V Vᵀ)        G = cov(x, x') (P⁻)⁻¹
///
///   x_0, x⁻   mean before and after the prediction            [n]
///   G, V      gain, root of cov(x | x')                       [n x n], [n x any]
struct BackwardStep {
  Eigen::VectorXd x_0, x_predicted;
  LaneMatrix G, V_root;
};

/// A prediction as the linear map that it was: x_1 + F (x - x_0), with the noise N Nᵀ.
///
///   x_0, x_1   mean before and after the prediction                  [n]
///   F          ∂f/∂x at x_0                                          [n x n]
///   N          Q_root, and what else the filter had beside F S_0     [n x any]
struct LinearPrediction {
  Eigen::VectorXd x_0, x_1;
  LaneMatrix F, N;
};

class GaussianFilter {
 public:
  virtual ~GaussianFilter() = default;

  void reset(const Eigen::VectorXd& x, const Eigen::MatrixXd& S);
  /// Throws std::runtime_error naming the state if the belief is no longer finite.
  virtual void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) = 0;
  /// The backward step of the last predict(), which started at x_0, S_0. The reflections that make the first rows of
  /// the left array triangular turn it into the right one:
  ///
  ///   [ D  Q_root ]      →    [ S⁻       0    ]     D: predicted points minus their mean, or F S_0
  ///   [ A    0    ]           [ G S⁻   V_root ]     A: the same columns before the prediction
  ///
  void backward_step(const Eigen::VectorXd& x_0, const LaneMatrix& S_0, BackwardStep& step);
  /// The last predict(), which started at x_0, as a linear map.
  void record(const DiscreteProcess& process, const Eigen::VectorXd& x_0, LinearPrediction& prediction) const;
  /// Predicts by the linear map, from any belief. A down-date of the recorded prediction is left out.
  void predict_again(const LinearPrediction& prediction);
  /// A measurement with νᵀ S⁻¹ ν > `gate` is not accepted: the belief does not change. Throws std::runtime_error if z
  /// is not finite. The caller sets the innovation's time.
  virtual Innovation update(const MeasurementModel& measurement, const ReadingVector& z, const ReadingMatrix& R_root,
                            double gate) = 0;

  const Eigen::VectorXd& x() const { return x_; }
  const LaneMatrix& root() const { return S_; }
  LaneMatrix::ConstView S() const { return S_.view(); }
  /// Number of roots that were lost and rebuilt.
  long repaired() const { return repaired_; }

 protected:
  /// The exact update with a measurement that is affine, or linearised at x: with ν = z - h(x) and H = ∂h/∂x, whitened
  /// by R_root, one measurement after the other (MatrixKernels::correct()):
  ///
  ///   L Lᵀ = I + H' P H'ᵀ,  H' = R_root⁻¹ H         S_y = R_root L
  ///   x' = x + G S_y⁻¹ ν,   G = P H'ᵀ L⁻ᵀ           S' S'ᵀ = P - G Gᵀ
  ///
  /// R_root: lower triangular, and not singular. Source: Bierman, "Factorization Methods for Discrete Sequential
  /// Estimation", 1977, chapter V (Potter).
  Innovation update_linear(const MeasurementModel& measurement, const ReadingVector& z, const ReadingMatrix& R_root,
                           double gate);
  void check_finite(const DiscreteProcess& process) const;
  static void check_measurement(const ReadingVector& nu);

  /// Block A of backward_step() [n x any]: the columns that the prediction turned into the first columns of
  /// `predicted_columns_`.
  virtual void set_columns_before(const LaneMatrix::ConstView& S_0, Eigen::Ref<Eigen::MatrixXd> A) const = 0;
  virtual int count_columns_before() const = 0;

  Eigen::VectorXd x_;
  LaneMatrix S_;
  Eigen::VectorXd x_predicted_;
  LaneMatrix predicted_columns_;  // their triangular root is S⁻; kept from the last predict()
  long repaired_ = 0;
  LowerRoot root_;

 private:
  LaneMatrix H_, gain_, corrected_;  // H', G, S' of update_linear()
  LaneMatrix triangle_;
  LowerRoot array_root_;
  LaneMatrix again_;  // of predict_again()
  Eigen::VectorXd deviation_;
};

}  // namespace halyard
