#include "estimators/process/exponential_step.h"

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

constexpr double kMeanTolerance = 0.05;       // of a standard deviation
constexpr double kDeviationTolerance = 0.2;   // of the deviations
constexpr double kHeldForceTolerance = 0.05;  // of the response
constexpr int kMostBlocks = (kMaxStates + kLaneWidth - 1) / kLaneWidth;

/// ‖column of change‖ <= tolerance ‖column of whole‖ for all columns; false if one is not finite.
bool small_change(const LaneMatrix& change, const LaneMatrix& whole, double tolerance) {
  for (int c = 0; c < change.columns(); ++c) {
    const double limit = tolerance * tolerance * sum_of_squares(whole, c, whole.rows());
    if (!(sum_of_squares(change, c, change.rows()) <= limit)) return false;
  }
  return true;
}

}  // namespace

ExponentialStep::ExponentialStep(const ProcessModel& process) : process_(process) {
  const Step usual{.dt_s = 1e-3};
  process.linearise(usual, Eigen::VectorXd::Zero(process.n_states()), f_, A_);
  phi_.balance(usual.dt_s * A_);
  variance_.set_zero(process.n_states(), PhiFunctions::kMostDoublings + 2);  // its memory for any step
}

bool ExponentialStep::start(const Step& step, const Eigen::VectorXd& x, const Eigen::MatrixXd& S) {
  step_ = end_ = step;
  end_.time_s += step.dt_s;
  const double h = step.dt_s;
  const int n = static_cast<int>(x.size());
  process_.linearise(step, x, f_, A_);
  Z_ = h * A_;
  minus_Z_ = -Z_;
  usable_ = f_.allFinite() && phi_.compute(Z_);
  if (!usable_) return false;
  set_product(phi_.phi_1(), right(f_), 1, vector_);
  x_2_ = x + h * vector_.view().col(0);
  process_.derivative(end_, x_2_, f_2_);
  D_ = x_2_ - x;
  c_ = f_2_ - f_;
  for (int k = 0; k < n; ++k) c_ -= D_(k) * A_.col(k);
  set_product(phi_.phi_3(), right(c_), 1, vector_);
  c_ = (2 * h) * vector_.view().col(0);
  next_ = x_2_ + c_;
  set_product(phi_.E(), right(S), n, spread_);
  Lanes squares[kMostBlocks];
  set_row_squares(spread_, spread_.columns(), squares);
  for (int i = 0; i < n; ++i)
    usable_ &= c_(i) * c_(i) <= kMeanTolerance * kMeanTolerance * squares[i / kLaneWidth][i % kLaneWidth];
  return usable_;
}

void ExponentialStep::set_nonlinear_part(const Step& at, const Eigen::VectorXd& x, const Eigen::VectorXd& f,
                                         const LaneMatrix& d, Deviations& moved) {
  moved.points.reshape(d.rows(), d.columns());
  moved.N.reshape(d.rows(), d.columns());
  const double h = step_.dt_s;
  const int blocks = d.blocks();
  Lanes *points = moved.points.lanes(), *N = moved.N.lanes();
  for (int c = 0; c < d.columns(); ++c)
    for (int b = c * blocks; b < (c + 1) * blocks; ++b) points[b] = d.lanes()[b] + x(c);
  process_.derivatives(at, moved.points, moved.N);
  for (int c = 0; c < d.columns(); ++c)
    for (int b = c * blocks; b < (c + 1) * blocks; ++b) N[b] = h * (N[b] - f(c));
  moved.N.clear_padding();
  add_product(d, transposed(right(minus_Z_)), moved.N);
}

bool ExponentialStep::respond(const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> Gamma) {
  if (!usable_) return false;
  const int n = static_cast<int>(G.rows()), sources = static_cast<int>(G.cols());
  forces_.reshape(sources, n);
  forces_.view() = G.transpose();
  LaneMatrix& response = response_.d;
  set_product(forces_, transposed(right(phi_.level(1).E)), n, response);
  response.set_lanes([&](std::size_t i) { return 4.0 * response.lanes()[i] + forces_.lanes()[i]; });
  add_product(forces_, transposed(right(phi_.E())), response);
  response.set_lanes([&](std::size_t i) { return (1.0 / 6) * response.lanes()[i]; });
  set_nonlinear_part(end_, x_2_, f_2_, response, response_);
  set_product(response_.N, transposed(right(phi_.phi_2())), n, response_.change);
  if (!small_change(response_.change, response, kHeldForceTolerance)) return false;
  Gamma = (response.view() + response_.change.view()).transpose();
  return true;
}

bool ExponentialStep::advance_root(Eigen::VectorXd& x, LaneMatrix& FS) {
  if (!usable_) return false;
  const int n = static_cast<int>(x.size());
  process_.linearise(end_, x_2_, f_2_, A_2_);
  if (!A_2_.allFinite()) return false;
  slopes_.reshape(n, n);
  slopes_.view() = step_.dt_s * (A_2_ - A_);
  set_product(slopes_, right(spread_), n, moved_slopes_);
  FS = spread_;
  add_product(phi_.phi_2(), right(moved_slopes_), FS);
  x = next_;
  return true;
}

void ExponentialStep::set_variances(const LaneMatrix& d) {
  const int levels = phi_.doublings(), half = d.rows() / 2, n = d.columns();
  variance_.reshape(n, levels + 2);
  for (int i = 0; i < n; ++i) {
    variance_.view()(i, 0) = sum_of_squares(d, i, half);
    variance_.view()(i, levels + 1) = sum_of_squares(moved_.d, i, half);
  }
  for (int k = levels; k > 0; --k) {
    set_product(phi_.level(k).E, transposed(right(d)), half, half_);
    set_row_squares(half_, half, variance_.lanes() + (levels + 1 - k) * variance_.blocks());
  }
}

void ExponentialStep::set_mean_shift(const LaneMatrix& d) {
  const int levels = phi_.doublings(), n = d.columns();
  set_variances(d);
  const auto variance = variance_.view();
  part_.resize(n);
  change_of_m_.resize(n);
  shift_.set_zero(n, 1);
  // From node to node: shift_ is the integral up to the left one.
  for (int node = 0; node <= levels; ++node) {
    const int k = node == 0 ? levels : levels + 1 - node;
    const double share = std::exp2(-k), left = node == 0 ? 0 : share, right_end = node == 0 ? share : 2 * share;
    for (int i = 0; i < n; ++i) {
      const double drop = share * (first_(i) - last_(i)), fall = variance(i, 0) - variance(i, levels + 1);
      double at_left = 1 - left, at_right = 1 - right_end, bump = 0;
      if (fall > 0) {
        const double a = variance(i, node), b = variance(i, node + 1);
        at_left = std::clamp((a - variance(i, levels + 1)) / fall, 0.0, 1.0);
        at_right = std::clamp((b - variance(i, levels + 1)) / fall, 0.0, 1.0);
        bump = std::min(2.0 / 3 * (0.5 * (a + b) - std::sqrt(a * b)) / fall, std::max(at_left, at_right));
      }
      part_(i) = share * last_(i) + drop * (at_left - bump);
      change_of_m_(i) = drop * (at_right - at_left);
    }
    const PhiFunctions::Level& level = phi_.level(k);
    if (node > 0) {
      c_ = shift_.view().col(0);
      set_product(level.E, right(c_), 1, shift_);
    }
    add_product(level.phi_1, right(part_), shift_);
    add_product(level.phi_2, right(change_of_m_), shift_);
  }
  part_ = -first_;
  add_product(phi_.phi_1(), right(part_), shift_);
  part_ = first_ - last_;
  add_product(phi_.phi_2(), right(part_), shift_);
}

bool ExponentialStep::advance(Eigen::VectorXd& x, LaneMatrix& d) {
  if (!usable_) return false;
  const int n = d.columns(), blocks = d.blocks();
  LaneMatrix &d_2 = moved_.d, &change_of_N = moved_.N;
  set_nonlinear_part(step_, x, f_, d, start_);
  set_product(d, transposed(right(phi_.E())), n, d_2);
  add_product(start_.N, transposed(right(phi_.phi_1())), d_2);
  set_nonlinear_part(end_, x_2_, f_2_, d_2, moved_);
  first_.resize(n);
  last_.resize(n);
  for (int i = 0; i < n; ++i) {
    first_(i) = sum_of_rows(start_.N, i) / d.rows();
    last_(i) = sum_of_rows(moved_.N, i) / d.rows();
  }
  set_mean_shift(d);
  change_of_N.set_lanes([&](std::size_t i) { return change_of_N.lanes()[i] - start_.N.lanes()[i]; });
  set_product(change_of_N, transposed(right(phi_.phi_2())), n, moved_.change);
  if (!small_change(moved_.change, d_2, kDeviationTolerance)) return false;
  x = next_;
  for (int c = 0; c < n; ++c)
    for (int b = c * blocks; b < (c + 1) * blocks; ++b)
      d.lanes()[b] = d_2.lanes()[b] + moved_.change.lanes()[b] + shift_.view()(c, 0);
  d.clear_padding();
  return true;
}

}  // namespace halyard
