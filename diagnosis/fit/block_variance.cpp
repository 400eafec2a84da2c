#include "diagnosis/fit/block_variance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace halyard {

BlockVariance block_variance(const Eigen::MatrixXd& J, const Eigen::VectorXd& r, const Eigen::VectorXd& prior,
                             std::span<const int> block) {
  const Eigen::Index p = J.cols();
  std::map<int, Eigen::VectorXd> score;
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    const auto [g, is_new] = score.try_emplace(block[i], Eigen::VectorXd::Zero(p));
    g->second += J.row(i).transpose() * r(i);
  }
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(p, p);
  for (const auto& [b, g] : score) middle += g * g.transpose();
  const auto blocks = static_cast<double>(score.size());
  if (blocks > 1) middle *= blocks / (blocks - 1);
  Eigen::MatrixXd information = J.transpose() * J;
  information.diagonal() += prior;
  middle.diagonal() += prior;
  constexpr double kSingular = 1e-9;  // of a unit of the optimiser: a parameter that nothing depends on
  information.diagonal().array() += kSingular;
  const Eigen::MatrixXd inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  return {inverse * middle * inverse, static_cast<int>(score.size())};
}

double correlation_rows(std::span<const double> residual) {
  constexpr double kEnds = 0.1;
  const std::size_t n = residual.size();
  double mean = 0, square = 0;
  for (const double x : residual) mean += x / static_cast<double>(n);
  for (const double x : residual) square += (x - mean) * (x - mean);
  double rows = 1;
  for (std::size_t lag = 1; square > 0 && lag < n / 4; ++lag) {
    double product = 0;
    for (std::size_t i = lag; i < n; ++i) product += (residual[i] - mean) * (residual[i - lag] - mean);
    if (product < kEnds * square) break;
    rows += 2 * product / square;
  }
  return rows;
}

std::vector<int> grouped_blocks(std::span<const int> block, double blocks_long, int fewest) {
  const auto [first, last] = std::ranges::minmax(block);
  const double most_long = std::max(1.0, static_cast<double>(last - first + 1) / fewest);
  const double size = std::clamp(std::ceil(blocks_long), 1.0, most_long);
  std::vector<int> group;
  for (const int b : block) group.push_back(static_cast<int>((b - first) / size));
  return group;
}

}  // namespace halyard
