#include "estimators/process/exponential_step.h"

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

constexpr double kMeanTolerance = 0.05;       // of a standard deviation
constexpr double kDeviationTolerance = 0.2;   // of the deviations
constexpr double kHeldForceTolerance = 0.05;  // of the response
constexpr int kMostBlocks = (kMaxStates + kLaneWidth - 1) / kLaneWidth;

/// ‖row of change‖ <= tolerance ‖row of whole‖ for all rows; false if one is not finite.
bool small_change(const LaneMatrix& change, const LaneMatrix& whole, double tolerance) {
  Lanes of_change[kMostBlocks], of_whole[kMostBlocks];
  set_row_squares(change, change.columns(), of_change);
  set_row_squares(whole, whole.columns(), of_whole);
  for (int r = 0; r < change.rows(); ++r) {
    const int block = r / kLaneWidth, lane = r % kLaneWidth;
    if (!(of_change[block][lane] <= tolerance * tolerance * of_whole[block][lane])) return false;
  }
  return true;
}

}  // namespace

ExponentialStep::ExponentialStep(const ProcessModel& process) : process_(process) {
  const Step usual{.dt_s = 1e-3};
  process.linearise(usual, Eigen::VectorXd::Zero(process.n_states()), f_, A_);
  phi_.balance(usual.dt_s * A_);
}

bool ExponentialStep::start(const Step& step, const Eigen::VectorXd& x, const Eigen::MatrixXd& S) {
  step_ = end_ = step;
  end_.time_s += step.dt_s;
  const double h = step.dt_s;
  process_.linearise(step, x, f_, A_);
  Z_ = h * A_;
  usable_ = f_.allFinite() && phi_.compute(Z_);
  if (!usable_) return false;
  minus_Z_.set_zero(static_cast<int>(Z_.rows()), static_cast<int>(Z_.cols()));
  minus_Z_.view() = -Z_;
  x_2_ = x;
  x_2_.noalias() += h * (phi_.phi_1().view() * f_);
  process_.derivative(end_, x_2_, f_2_);
  D_ = x_2_ - x;
  c_.noalias() = A_ * D_;
  D_ = f_2_ - f_ - c_;
  c_.noalias() = (2 * h) * (phi_.phi_3().view() * D_);
  next_ = x_2_ + c_;
  set_product(phi_.E(), S, spread_);
  Lanes squares[kMostBlocks];
  set_row_squares(spread_, spread_.columns(), squares);
  for (int i = 0; i < c_.size(); ++i)
    usable_ &= c_(i) * c_(i) <= kMeanTolerance * kMeanTolerance * squares[i / kLaneWidth][i % kLaneWidth];
  return usable_;
}

void ExponentialStep::set_nonlinear_part(const Step& at, const Eigen::Ref<const Eigen::VectorXd>& x,
                                         const Eigen::VectorXd& f, const LaneMatrix& d, LaneMatrix& N) {
  points_.set_zero(d.rows(), d.columns());
  points_.view() = d.view().colwise() + x;
  N.set_zero(d.rows(), d.columns());
  auto h_N = N.view();
  process_.derivatives(at, points_.view(), h_N);
  h_N = step_.dt_s * (h_N.colwise() - f);
  add_product(minus_Z_, d.view(), N);
}

bool ExponentialStep::respond(const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> Gamma) {
  if (!usable_) return false;
  set_product(phi_.level(1).E, G, d_);
  d_.view() = 4 * d_.view() + G;
  add_product(phi_.E(), G, d_);
  d_.view() /= 6;
  set_nonlinear_part(end_, x_2_, f_2_, d_, N_);
  set_product(phi_.phi_2(), N_.view(), change_);
  if (!small_change(change_, d_, kHeldForceTolerance)) return false;
  Gamma = d_.view() + change_.view();
  return true;
}

bool ExponentialStep::advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) {
  if (!usable_) return false;
  process_.linearise(end_, x_2_, f_2_, A_2_);
  if (!A_2_.allFinite()) return false;
  d_.set_zero(static_cast<int>(x.size()), static_cast<int>(x.size()));
  d_.view() = step_.dt_s * (A_2_ - A_);
  set_product(d_, phi_.E().view(), N_);
  d_2_ = phi_.E();
  add_product(phi_.phi_2(), N_.view(), d_2_);
  F = d_2_.view();
  x = next_;
  return true;
}

void ExponentialStep::set_variances() {
  const int levels = phi_.doublings(), half = d_.columns() / 2;
  variance_.set_zero(d_.rows(), levels + 2);
  const auto at = [&](int node) { return variance_.lanes() + node * variance_.blocks(); };
  set_row_squares(d_, half, at(0));
  for (int k = levels; k > 0; --k) {
    set_product(phi_.level(k).E, d_.view().leftCols(half), change_);
    set_row_squares(change_, half, at(levels + 1 - k));
  }
  set_row_squares(d_2_, half, at(levels + 1));
}

void ExponentialStep::set_mean_shift() {
  const int levels = phi_.doublings(), n = d_.rows();
  set_variances();
  const auto variance = variance_.view();
  part_.resize(n);
  change_of_m_.resize(n);
  shift_.setZero(n);
  // From node to node: shift_ is the integral up to the left one.
  for (int node = 0; node <= levels; ++node) {
    const int k = node == 0 ? levels : levels + 1 - node;
    const double share = std::exp2(-k), left = node == 0 ? 0 : share, right = node == 0 ? share : 2 * share;
    for (int i = 0; i < n; ++i) {
      const double drop = first_(i) - last_(i), fall = variance(i, 0) - variance(i, levels + 1);
      double at_left = 1 - left, at_right = 1 - right, bump = 0;
      if (fall > 0) {
        const double a = variance(i, node), b = variance(i, node + 1);
        at_left = std::clamp((a - variance(i, levels + 1)) / fall, 0.0, 1.0);
        at_right = std::clamp((b - variance(i, levels + 1)) / fall, 0.0, 1.0);
        bump = std::min(2.0 / 3 * (0.5 * (a + b) - std::sqrt(a * b)) / fall, std::max(at_left, at_right));
      }
      part_(i) = last_(i) + drop * (at_left - bump);
      change_of_m_(i) = drop * (at_right - at_left);
    }
    const PhiFunctions::Level& level = phi_.level(k);
    if (node > 0) {
      next_shift_.noalias() = level.E.view() * shift_;
      shift_.swap(next_shift_);
    }
    shift_.noalias() += share * (level.phi_1.view() * part_);
    shift_.noalias() += share * (level.phi_2.view() * change_of_m_);
  }
  shift_.noalias() -= phi_.phi_1().view() * first_;
  part_ = last_ - first_;
  shift_.noalias() -= phi_.phi_2().view() * part_;
}

bool ExponentialStep::advance(Eigen::MatrixXd& X) {
  if (!usable_) return false;
  const int n = static_cast<int>(X.rows()), count = static_cast<int>(X.cols()) - 1;
  d_.set_zero(n, count);
  d_.view() = X.rightCols(count).colwise() - X.col(0);
  set_nonlinear_part(step_, X.col(0), f_, d_, N_);
  set_product(phi_.E(), d_.view(), d_2_);
  add_product(phi_.phi_1(), N_.view(), d_2_);
  set_nonlinear_part(end_, x_2_, f_2_, d_2_, N_2_);
  first_ = N_.view().rowwise().mean();
  last_ = N_2_.view().rowwise().mean();
  set_mean_shift();
  N_2_.set_lanes([&](std::size_t i) { return N_2_.lanes()[i] - N_.lanes()[i]; });
  set_product(phi_.phi_2(), N_2_.view(), change_);
  if (!small_change(change_, d_2_, kDeviationTolerance)) return false;
  X.col(0) = next_;
  d_2_.set_lanes([&](std::size_t i) { return d_2_.lanes()[i] + change_.lanes()[i]; });
  d_2_.view().colwise() += shift_;
  X.rightCols(count) = d_2_.view().colwise() + next_;
  return true;
}

}  // namespace halyard
