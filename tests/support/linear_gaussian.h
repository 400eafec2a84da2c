#pragma once
/// A linear problem with Gaussian noise of full rank, and the textbook's Kalman filter for it: what every Kalman filter
/// must agree with.

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "estimators/filters/gaussian_filter.h"

namespace halyard {

inline constexpr double kNoGate = std::numeric_limits<double>::infinity();

class LinearProcess final : public DiscreteProcess {
 public:
  explicit LinearProcess(const Eigen::MatrixXd& F) : F_(F) {}
  void advance(Eigen::MatrixXd& X) const override { X = F_ * X; }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    x = F_ * x;
    F = F_;
  }
  std::string name_of(int state) const override { return "state " + std::to_string(state); }

 private:
  Eigen::MatrixXd F_;
};

class LinearReadings final : public MeasurementModel {
 public:
  /// `admits_it`: says that it is affine, so that a filter may take it exactly.
  LinearReadings(const Eigen::MatrixXd& H, bool admits_it) : H_(H), affine_(admits_it) {}
  bool is_affine() const override { return affine_; }
  void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override { z = H_ * x; }
  void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                 Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = H_;
    z = H_ * x;
  }

 private:
  Eigen::MatrixXd H_;
  bool affine_;
};

inline Eigen::MatrixXd initial_root() { return Eigen::MatrixXd::Identity(4, 4); }

struct LinearGaussian {
  Eigen::MatrixXd F, H, Q_root, R_root;
  Eigen::VectorXd x_0;
  std::vector<Eigen::VectorXd> truth, z;  ///< after each step

  /// Four states of up to 10, two measurements, correlated noise; drawn with a fixed seed.
  explicit LinearGaussian(int steps) {
    F.resize(4, 4);
    F << 0.9, 0.2, 0, 0.1, -0.2, 0.9, 0.1, 0, 0, -0.1, 0.95, 0.2, 0.1, 0, -0.2, 0.95;
    H.resize(2, 4);
    H << 1, 0, 0.5, 0, 0, 1, 0, -0.5;
    Q_root.resize(4, 4);
    Q_root << 0.3, 0, 0, 0, 0.1, 0.2, 0, 0, 0, 0.1, 0.3, 0, -0.1, 0, 0.1, 0.2;
    R_root.resize(2, 2);
    R_root << 0.5, 0, 0.2, 0.4;
    x_0 = Eigen::Vector4d(1, -2, 3, 0.5);
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const auto draw = [&](const Eigen::MatrixXd& root) {
      Eigen::VectorXd w(root.cols());
      for (double& each : w) each = normal(random);
      return Eigen::VectorXd(root * w);
    };
    Eigen::VectorXd x = x_0 + draw(initial_root());
    for (int i = 0; i < steps; ++i) {
      x = F * x + draw(Q_root);
      truth.push_back(x);
      z.push_back(H * x + draw(R_root));
    }
  }
};

/// Prediction and update by covariances, in long double: its own rounding, 2000 times finer, does not count.
struct KalmanFilter {
  using Real = long double;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Vector x;
  Matrix P;

  explicit KalmanFilter(const LinearGaussian& p) : x(p.x_0.cast<Real>()), P(squared(initial_root())) {}

  void step(const LinearGaussian& p, const Eigen::VectorXd& z) {
    const Matrix F = p.F.cast<Real>(), H = p.H.cast<Real>();
    x = F * x;
    P = F * P * F.transpose() + squared(p.Q_root);
    const Matrix S = H * P * H.transpose() + squared(p.R_root);
    const Matrix K = S.llt().solve(H * P).transpose();
    x += K * (z.cast<Real>() - H * x);
    P = (P - K * S * K.transpose()).eval();
    P = (0.5L * (P + P.transpose())).eval();
  }

  /// A Aᵀ
  static Matrix squared(const Eigen::MatrixXd& A) { return A.cast<Real>() * A.cast<Real>().transpose(); }

  /// Largest difference of mean and covariance from N(x, S Sᵀ).
  double difference(const Eigen::VectorXd& mean, const Eigen::MatrixXd& root) const {
    return static_cast<double>(std::max((mean.cast<Real>() - x).cwiseAbs().maxCoeff(),  //
                                        (squared(root) - P).cwiseAbs().maxCoeff()));
  }
};

/// Largest differences of mean and covariance between a filter and the Kalman filter, over all steps.
inline double largest_difference(GaussianFilter& filter, const LinearGaussian& p, bool admits_it) {
  KalmanFilter kalman(p);
  filter.reset(p.x_0, initial_root());
  const LinearProcess process(p.F);
  const LinearReadings readings(p.H, admits_it);
  double largest = 0;
  for (const Eigen::VectorXd& z : p.z) {
    kalman.step(p, z);
    filter.predict(process, p.Q_root);
    filter.update(readings, z, p.R_root, std::numeric_limits<double>::infinity());
    largest = std::max(largest, kalman.difference(filter.x(), filter.S()));
  }
  return largest;
}

/// Mean of νᵀ S⁻¹ ν per measured number over a run with process noise scaled by `q`: 1 if the noise is right.
inline double normalised_nis(GaussianFilter& filter, const LinearGaussian& p, double q) {
  filter.reset(p.x_0, initial_root());
  double sum = 0;
  for (const Eigen::VectorXd& z : p.z) {
    filter.predict(LinearProcess(p.F), q * p.Q_root);
    sum += filter.update(LinearReadings(p.H, true), z, p.R_root, std::numeric_limits<double>::infinity()).nis();
  }
  return sum / (2.0 * static_cast<double>(p.z.size()));
}

}  // namespace halyard
