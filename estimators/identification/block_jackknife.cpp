#include "estimators/identification/block_jackknife.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace halyard {

JackknifeEstimate jackknife_least_squares(const std::vector<BlockSums>& blocks, const Eigen::VectorXd& u,
                                          const Eigen::VectorXd& bound) {
  const auto p = u.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(p, p);
  Eigen::VectorXd g = -u;
  for (const BlockSums& b : blocks) A += b.A, g += b.g;

  // One number after the other is held at its bound, the one that is furthest beyond first.
  Eigen::VectorXd step = Eigen::VectorXd::Zero(p);
  std::vector<int> free(static_cast<std::size_t>(p));
  std::iota(free.begin(), free.end(), 0);
  while (!free.empty()) {
    const Eigen::VectorXd rest = g - A * step;
    step(free) += A(free, free).ldlt().solve(rest(free));
    const auto furthest = std::ranges::max_element(free, {}, [&](int i) { return std::abs((u + step)(i)) / bound(i); });
    if (std::abs((u + step)(*furthest)) <= bound(*furthest)) break;
    step(*furthest) = std::copysign(bound(*furthest), (u + step)(*furthest)) - u(*furthest);
    free.erase(furthest);
  }

  const double count = static_cast<double>(blocks.size());
  const Eigen::MatrixXd A_free = A(free, free);
  Eigen::VectorXd held = step;
  held(free).setZero();
  Eigen::MatrixXd without(A_free.rows(), static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Eigen::VectorXd rest = (g - blocks[b].g) - (A - blocks[b].A) * held;
    without.col(static_cast<Eigen::Index>(b)) = (A_free - blocks[b].A(free, free)).ldlt().solve(rest(free));
  }
  const Eigen::VectorXd mean = without.rowwise().mean();
  const Eigen::MatrixXd inverse = A_free.ldlt().solve(Eigen::MatrixXd::Identity(A_free.rows(), A_free.rows()));
  const Eigen::VectorXd jackknife =
      (count - 1) / count * (without.colwise() - mean).rowwise().squaredNorm() + inverse.rowwise().squaredNorm();
  JackknifeEstimate e;
  e.u = u + step;
  e.deviation.setZero(p);
  e.deviation(free) = jackknife.cwiseMax(inverse.diagonal()).cwiseSqrt();
  e.blocks = static_cast<int>(blocks.size());
  return e;
}

}  // namespace halyard
