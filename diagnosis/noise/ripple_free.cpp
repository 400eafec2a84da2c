#include "diagnosis/noise/ripple_free.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/search_space.h"

namespace halyard {
namespace {

/// Orders from `first` to kHighestOrder, a cosine and a sine of each.
class AngleHarmonics {
 public:
  explicit AngleHarmonics(int first) : first_(first), at_(2 * (kHighestOrder - first + 1)) {}
  const Eigen::VectorXd& at(double angle) {
    for (int m = first_; m <= kHighestOrder; ++m) {
      at_(2 * (m - first_)) = std::cos(m * angle);
      at_(2 * (m - first_) + 1) = std::sin(m * angle);
    }
    return at_;
  }
  Eigen::Index size() const { return at_.size(); }

 private:
  int first_;
  Eigen::VectorXd at_;
};

int lowest_order(const std::vector<std::vector<double>>& motor_angle) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const std::vector<double>& run : motor_angle)
    for (const double angle : run) least = std::min(least, angle), most = std::max(most, angle);
  const double order = kFewestPeriods * 2 * std::numbers::pi / (most - least);
  return order < kHighestOrder ? std::max(1, static_cast<int>(std::ceil(order))) : kHighestOrder + 1;
}

}  // namespace

std::vector<std::vector<double>> ripple_free(std::vector<std::vector<double>> residual,
                                             const std::vector<std::vector<double>>& motor_angle) {
  const int first = lowest_order(motor_angle);
  if (first > kHighestOrder) return residual;
  AngleHarmonics harmonics(first);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(harmonics.size(), harmonics.size());
  Eigen::VectorXd product = Eigen::VectorXd::Zero(harmonics.size());
  const auto each = [&](const auto& work) {
    for (std::size_t r = 0; r < residual.size(); ++r)
      for (std::size_t i = 0; i < residual[r].size(); ++i)
        if (std::isfinite(residual[r][i])) work(residual[r][i], harmonics.at(motor_angle[r][i]));
  };
  double count = 0;
  each([&](double e, const Eigen::VectorXd& h) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(h);
    product += e * h;
    ++count;
  });
  constexpr double kRidge = 1e-6;  // of a sample: orders that this motion does not tell apart share what they explain
  gram.diagonal().array() += kRidge * count;
  const Eigen::VectorXd amount = gram.selfadjointView<Eigen::Lower>().ldlt().solve(product);
  each([&](double& e, const Eigen::VectorXd& h) { e -= amount.dot(h); });
  return residual;
}

}  // namespace halyard
