#include "plant/integrators/step_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace halyard {
namespace {

/// Gaussian elimination with the largest pivot of each column; row[i] is the row of A that ends as row i.
void decompose(int n, double* A, int* row) {
  std::iota(row, row + n, 0);
  for (int k = 0; k < n; ++k) {
    int largest = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(A[i * n + k]) > std::abs(A[largest * n + k])) largest = i;
    if (largest != k) {
      std::swap_ranges(A + k * n, A + (k + 1) * n, A + largest * n);
      std::swap(row[k], row[largest]);
    }
    const double* pivot_row = A + k * n;
    const double per_pivot = A[k * n + k] = 1 / A[k * n + k];
    for (int i = k + 1; i < n; ++i) {
      double* const a = A + i * n;
      const double factor = a[k] *= per_pivot;
      for (int c = k + 1; c < n; ++c) a[c] -= factor * pivot_row[c];
    }
  }
}

/// Solves A x = b with the factors of decompose(); x is b with its rows in the order of the factors, in place.
void substitute(int n, const double* A, double* x) {
  for (int i = 1; i < n; ++i)
    for (int c = 0; c < i; ++c) x[i] -= A[i * n + c] * x[c];
  for (int i = n - 1; i >= 0; --i) {
    for (int c = i + 1; c < n; ++c) x[i] -= A[i * n + c] * x[c];
    x[i] *= A[i * n + i];
  }
}

}  // namespace

StepMatrix::StepMatrix(const PlantLayout& l)
    : size_(l.size()), meters_{2 * l.n + l.input_energy, 2 * l.n + l.lost_energy} {
  for (int k = 0; k < l.n; ++k) position_.push_back(k), core_.push_back(l.n + k);
  for (int k = 0; k < l.n; ++k) {
    if (!l.motor_angle[k]) continue;
    position_.push_back(2 * l.n + *l.motor_angle[k]);
    core_.push_back(2 * l.n + *l.motor_rate[k]);
  }
  for (int i = 0; i < l.n_effect_states; ++i) core_.push_back(2 * l.n + l.effect_states + i);
  lu_.resize(core_.size() * core_.size());
  position_part_.resize(core_.size() * position_.size());
  meter_part_.resize(kMeters * l.size());
  row_.resize(core_.size());
  right_.resize(core_.size());
}

void StepMatrix::factor(const Eigen::MatrixXd& J, double gamma_h) {
  gamma_h_ = gamma_h;
  const int n_c = static_cast<int>(core_.size()), n_x = static_cast<int>(position_.size());
  for (int r = 0; r < n_c; ++r) {
    double* const row = lu_.data() + r * n_c;
    double* const part = position_part_.data() + r * n_x;
    for (int c = 0; c < n_c; ++c) row[c] = -J(core_[r], core_[c]);
    for (int c = 0; c < n_x; ++c) {
      part[c] = gamma_h * J(core_[r], position_[c]);
      row[c] -= part[c];
    }
    row[r] += 1 / gamma_h;
  }
  for (int m = 0; m < kMeters; ++m)
    for (int c = 0; c < size_; ++c) meter_part_[m * size_ + c] = J(meters_[m], c);
  decompose(n_c, lu_.data(), row_.data());
}

void StepMatrix::solve(double* r) const {
  const int n_c = static_cast<int>(core_.size()), n_x = static_cast<int>(position_.size());
  for (int i = 0; i < n_c; ++i) {
    const double* const part = position_part_.data() + row_[i] * n_x;
    double sum = r[core_[row_[i]]];
    for (int c = 0; c < n_x; ++c) sum += part[c] * r[position_[c]];
    right_[i] = sum;
  }
  substitute(n_c, lu_.data(), right_.data());
  for (int i = 0; i < n_c; ++i) r[core_[i]] = right_[i];
  for (int i = 0; i < n_x; ++i) r[position_[i]] = gamma_h_ * (r[position_[i]] + right_[i]);
  for (int m = 0; m < kMeters; ++m) {
    double sum = r[meters_[m]];
    for (int c = 0; c < size_ - kMeters; ++c) sum += meter_part_[m * size_ + c] * r[c];
    r[meters_[m]] = gamma_h_ * sum;
  }
}

}  // namespace halyard
