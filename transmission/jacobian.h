#pragma once
/// Jacobians by dual numbers, exact to rounding:
///
///   y = f(x),   J = ∂f/∂x
///
///   x   [n_x]      y   [n_y]      J   [n_y x n_x]

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "transmission/scalar.h"

namespace halyard {

/// Largest size of x and y. They are on the stack, because memory from the heap costs as much as a small f.
inline constexpr int kMaxJacobian = 128;

/// Fills y and J, which must have the size of the result. f(const Dual* x, Dual* y) writes all of y and is called once
/// for every kDualWidth entries of x. Throws std::invalid_argument if x or y has more than kMaxJacobian entries.
template <class Function>
void jacobian(Function&& f, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y,
              Eigen::Ref<Eigen::MatrixXd> J) {
  const int n_x = static_cast<int>(x.size()), n_y = static_cast<int>(y.size());
  if (std::max(n_x, n_y) > kMaxJacobian) throw std::invalid_argument("Jacobian by dual numbers: too many variables");
  std::array<Dual, kMaxJacobian> at, value;
  for (int first = 0; first < n_x; first += kDualWidth) {
    const int end = std::min(first + kDualWidth, n_x);
    for (int i = 0; i < n_x; ++i) at[i] = i >= first && i < end ? Dual::seed(x(i), i - first) : Dual(x(i));
    f(static_cast<const Dual*>(at.data()), value.data());
    for (int r = 0; r < n_y; ++r) {
      y(r) = value[r].a;
      for (int c = first; c < end; ++c) J(r, c) = value[r].d[c - first];
    }
  }
}

}  // namespace halyard
