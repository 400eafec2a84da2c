#include "diagnosis/explanation/curve_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace halyard {
namespace {

struct Samples {
  std::vector<double> x, y;
};

std::vector<double> knots_of(std::vector<double> x, int count, double period) {
  std::vector<double> knots;
  if (period > 0) {
    for (int b = 0; b < count; ++b) knots.push_back(period * b / count);
    return knots;
  }
  std::sort(x.begin(), x.end());
  for (int b = 0; b < count; ++b) knots.push_back(x[(x.size() - 1) * static_cast<std::size_t>(b) / (count - 1)]);
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

/// Fits one curve; adds what it leaves to `rest`, the sum of squares.
Curve fit_one(const Samples& s, const std::vector<double>& knots, double period, double& rest) {
  const auto size = static_cast<Eigen::Index>(knots.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  // The knot before a sample, the one after it, and how far it is between them.
  const auto place = [&](double x, Eigen::Index& before, Eigen::Index& after) {
    before = std::clamp<Eigen::Index>(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin() - 1, 0,
                                      period > 0 ? size - 1 : size - 2);
    after = (before + 1) % size;
    const double width = (after > before ? knots[after] : period) - knots[before];
    return std::clamp((x - knots[before]) / width, 0.0, 1.0);
  };
  Eigen::Index a, b;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double u = place(s.x[i], a, b);
    normal(a, a) += (1 - u) * (1 - u), normal(b, b) += u * u;
    normal(a, b) += u * (1 - u), normal(b, a) += u * (1 - u);
    right(a) += (1 - u) * s.y[i], right(b) += u * s.y[i];
  }
  // A knot without samples has no value; this keeps the others'.
  const Eigen::VectorXd weight = normal.diagonal();
  normal.diagonal().array() += 1e-12 * static_cast<double>(s.x.size()) + std::numeric_limits<double>::min();
  const Eigen::VectorXd value = normal.ldlt().solve(right);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double u = place(s.x[i], a, b), e = s.y[i] - (1 - u) * value(a) - u * value(b);
    rest += e * e;
  }
  Curve curve;
  for (Eigen::Index k = 0; k < size; ++k)
    if (weight(k) > 0) {
      curve.x.push_back(knots[k]);
      curve.y.push_back(value(k));
    }
  return curve;
}

}  // namespace

double CurveFit::swing() const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& c : curves)
    for (const double y : c.y) low = std::min(low, y), high = std::max(high, y);
  return std::max(0.0, high - low);
}

CurveFit fit_curve(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& direction,
                   int knots, double period) {
  const bool split = !direction.empty();
  std::vector<Samples> sides(split ? 2 : 1);
  std::vector<double> all;
  double mean = 0, square = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    Samples& side = sides[split && direction[i] > 0];
    side.x.push_back(x[i]);
    side.y.push_back(y[i]);
    all.push_back(x[i]);
    mean += y[i];
  }
  CurveFit fit;
  if (all.empty()) return fit;
  mean /= static_cast<double>(all.size());
  for (const Samples& side : sides)
    for (const double v : side.y) square += (v - mean) * (v - mean);
  const std::vector<double> at = knots_of(all, knots, period);
  if (at.size() < 2 || !(square > 0)) return fit;
  double rest = 0;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (sides[k].x.empty()) continue;
    fit.curves.push_back(fit_one(sides[k], at, period, rest));
    if (split) fit.curves.back().direction = k == 1 ? 1 : -1;
    fit.numbers += static_cast<int>(fit.curves.back().x.size());
  }
  fit.explained = 1 - rest / square;
  return fit;
}

}  // namespace halyard
