#include "estimators/process/exponential_step.h"

#include <algorithm>
#include <cmath>

namespace halyard {
namespace {

constexpr double kChainAge = 1e-2;            // s; at 1 m/s or rad/s a change of 10 mm or mrad
constexpr double kMeanTolerance = 0.05;       // of a standard deviation
constexpr double kRootTolerance = 0.2;        // of the root
constexpr double kHeldForceTolerance = 0.05;  // of the response
constexpr double kNoGrowth = 1e-3;            // of the root
constexpr double kSameLength = 1e-9;          // of a step

/// ‖column of change‖ <= tolerance ‖column of whole‖ for all columns; false if one is not finite.
bool is_small_change(const LaneMatrix& change, const LaneMatrix& whole, double tolerance) {
  double changed[kMaxStates], all[kMaxStates];
  set_squares(change, changed);
  set_squares(whole, all);
  for (int c = 0; c < change.columns(); ++c)
    if (!(changed[c] <= tolerance * tolerance * all[c])) return false;
  return true;
}

}  // namespace

ExponentialStep::ExponentialStep(const ProcessModel& process)
    : process_(process),
      shape_{process.n_states(), process.layout().positions, process.moving_states()},
      moving_(shape_.end - shape_.first) {
  const Step usual{.dt_s = 1e-3};
  process.linearise(usual, Eigen::VectorXd::Zero(process.n_states()), f_, A_);
  phi_.balance(usual.dt_s * A_);
  variance_.resize(shape_.n, PhiFunctions::kMostDoublings + 2);  // for any step
}

void ExponentialStep::linearise(const Step& step, const Eigen::VectorXd& x) {
  step_ = end_ = step;
  end_.time_s += step.dt_s;
  x_ = x;
  // Beside rates at sigma points, those of x have to be exact.
  const bool known =
      process_.is_smooth() && step.time_s >= chain_known_since_ && step.time_s < chain_known_since_ + kChainAge;
  if (known && std::abs(step.dt_s - phi_dt_s_) <= kSameLength * step.dt_s) {
    process_.rates_beside(step, x, f_, point_);
    if (step.dt_s * point_.excess_rate <= kNoGrowth) return;
  }
  if (!known) chain_known_since_ = step.time_s, has_curvature_ = false;
  phi_dt_s_ = step.dt_s;
  phi_is_due_ = true;
  process_.linearise(step, x, known ? &point_.chain : nullptr, f_, A_, point_);
}

void ExponentialStep::save(Kept& kept) const {
  kept.chain_known_since_s = chain_known_since_;
  kept.has_curvature = has_curvature_;
  kept.point = point_;
  kept.phi_dt_s = phi_dt_s_;
  kept.A = A_;
}

void ExponentialStep::restore(const Kept& kept) {
  chain_known_since_ = kept.chain_known_since_s;
  has_curvature_ = kept.has_curvature;
  point_ = kept.point;
  phi_dt_s_ = kept.phi_dt_s;
  A_ = kept.A;
  phi_is_due_ = true;
}

bool ExponentialStep::start(const LaneMatrix& S, const Eigen::MatrixXd& G) {
  const int n = static_cast<int>(x_.size());
  usable_ = std::isfinite(f_.sum()) && (!phi_is_due_ || phi_.compute(phi_dt_s_, A_, shape_));
  is_finite_ = false;
  if (!usable_) return forget(), false;
  set_x_2();
  set_linear_response(G);
  phi_is_due_ = false;
  set_second_stage();
  set_product(phi_.phi_3(), right(D_), 1, shift_);
  c_ = 2 * shift_.view().col(0);
  next_ = x_2_ + c_;
  set_product(phi_.E(), right(S), n, moved_root_);
  spread_squares_.resize(n);
  set_row_squares(moved_root_, n, spread_squares_.data());
  is_finite_ = std::isfinite(c_.squaredNorm() + spread_squares_.sum());
  for (int i = 0; i < n; ++i) usable_ &= c_(i) * c_(i) <= kMeanTolerance * kMeanTolerance * spread_squares_(i);
  return usable_;
}

void ExponentialStep::set_x_2() {
  const int p = shape_.first;
  part_ = f_.segment(p, moving_);
  part_.noalias() -= A_.block(p, p, moving_, p) * x_.segment(p, p);
  part_ *= step_.dt_s;
  shift_.reshape(shape_.n, 1);
  multiply(phi_.E().columns(p, p), rows_from(p, right(x_)), shift_.columns(0, 1), false);
  multiply(phi_.phi_1().columns(0, moving_), right(part_), shift_.columns(0, 1), true);
  x_2_ = x_ + shift_.view().col(0);
  x_2_.segment(p, p) -= x_.segment(p, p);
}

void ExponentialStep::set_linear_response(const Eigen::MatrixXd& G) {
  const int n = shape_.n, sources = static_cast<int>(G.cols());
  if (!phi_is_due_ && G_.size() == G.size() && std::equal(G.data(), G.data() + G.size(), G_.data())) return;
  G_ = G;
  forces_.reshape(1 + sources, n);
  response_.reshape(1 + sources, n);
  set_rows_transposed(G, forces_, 1);
  const LaneColumns<const Lanes> forces = forces_.columns(shape_.first, moving_);
  const auto response = response_.columns(0, n);
  multiply(forces, transposed(right(phi_.level(1).E.columns(shape_.first, moving_))), response, false);
  response_.set_lanes([&](std::size_t i) { return 4.0 * response_.lanes()[i] + forces_.lanes()[i]; });
  multiply(forces, transposed(right(phi_.E().columns(shape_.first, moving_))), response, true);
  response_.set_lanes([&](std::size_t i) { return (1.0 / 6) * response_.lanes()[i]; });
}

void ExponentialStep::set_second_stage() {
  const double h = step_.dt_s;
  if (process_.is_smooth()) {
    process_.second_stage(point_, x_, x_2_, point_2_, D_);
    D_ *= h;
    return process_.far_excess(point_, point_2_, x_2_, -h, response_, minus_N_);
  }
  const int first = shape_.first, blocks = response_.blocks();
  set_rates(end_, x_2_, response_, rates_);
  f_2_.resize(shape_.n);
  for (int c = 0; c < shape_.n; ++c) f_2_(c) = rates_.lanes()[c * blocks][0];
  for (int c = 0; c < shape_.n; ++c) response_.lanes()[c * blocks].set(0, x_2_(c) - x_(c));
  minus_N_.reshape(response_.rows(), moving_);
  for (int c = 0, i = 0; c < moving_; ++c) {
    for (const int end = (c + 1) * blocks; i < end; ++i)
      minus_N_.lanes()[i] = h * (f_2_(first + c) - rates_.lanes()[first * blocks + i]);
    minus_N_.lanes()[c * blocks].set(0, h * (f_(first + c) - f_2_(first + c)));
  }
  minus_N_.clear_padding();
  Z_ = h * A_;
  multiply(response_.columns(0, shape_.n), transposed(rows_from(first, right(Z_))), minus_N_.columns(0, moving_), true);
  D_.resize(moving_);
  for (int c = 0; c < moving_; ++c) {
    Lanes& of_x_2 = minus_N_.lanes()[c * blocks];
    D_(c) = -of_x_2[0];
    of_x_2.set(0, 0);
  }
  for (int c = 0; c < shape_.n; ++c) response_.lanes()[c * blocks].set(0, 0);
}

void ExponentialStep::set_rates(const Step& at, const Eigen::VectorXd& x, const LaneMatrix& d, LaneMatrix& rates) {
  points_.reshape(d.rows(), d.columns());
  rates.reshape(d.rows(), d.columns());
  for (int c = 0, i = 0; c < d.columns(); ++c)
    for (const int end = (c + 1) * d.blocks(); i < end; ++i) points_.lanes()[i] = d.lanes()[i] + x(c);
  process_.derivatives(at, points_, rates);
}

bool ExponentialStep::respond(Eigen::Ref<Eigen::MatrixXd> Gamma) {
  if (!usable_) return false;
  const int n = response_.columns(), sources = response_.rows() - 1;
  change_.reshape(sources + 1, n);
  multiply(minus_N_.columns(0, moving_), transposed(right(phi_.phi_2())), change_.columns(0, n), false);
  if (is_small_change(change_, response_, kHeldForceTolerance)) {
    change_.set_lanes([&](std::size_t i) { return response_.lanes()[i] - change_.lanes()[i]; });
  } else if (process_.is_smooth()) {
    change_ = response_;
    process_.impulse_response(point_, A_, x_, x_2_, step_.dt_s, forces_, change_);
  } else {
    return false;
  }
  set_transposed(std::as_const(change_).view().bottomRows(sources), Gamma);
  return true;
}

void ExponentialStep::set_spread(const LaneMatrix& moved) {
  spread_.reshape(moved.columns(), moved.rows());
  set_transposed(moved.view(), spread_.view());
}

bool ExponentialStep::set_growth(const LaneMatrix& moved) {
  const int n = moved.columns();
  if (process_.is_smooth() && step_.dt_s * point_2_.excess_rate <= kNoGrowth) return growth_.set_zero(0, 0), true;
  set_spread(moved);
  if (process_.is_smooth()) {
    process_.near_excess(point_, point_2_, step_.dt_s, spread_, moved_);
  } else {
    process_.linearise(end_, x_2_, &point_.chain, f_2_, A_2_, point_2_);
    slopes_ = step_.dt_s * (A_2_ - A_);
    if (!std::isfinite(slopes_.sum())) return false;
    moved_.reshape(n, moving_);
    multiply(spread_.columns(0, n), transposed(rows_from(shape_.first, right(slopes_))), moved_.columns(0, moving_),
             false);
  }
  set_product(moved_, transposed(right(phi_.phi_2())), n, growth_);
  return true;
}

void ExponentialStep::add_growth(const LaneMatrix& moved, LaneMatrix& F) {
  const std::size_t size = static_cast<std::size_t>(moved.blocks()) * static_cast<std::size_t>(moved.columns());
  if (growth_.columns() > 0) {
    set_transposed(std::as_const(growth_).view(), F.view());
    for (std::size_t i = 0; i < size; ++i) F.lanes()[i] += moved.lanes()[i];
  } else {
    std::copy_n(moved.lanes(), size, F.lanes());
  }
}

bool ExponentialStep::advance_root(Eigen::VectorXd& x, LaneMatrix& FS) {
  if (!usable_ || !set_growth(moved_root_)) return false;
  add_growth(moved_root_, FS);
  x = next_;
  return true;
}

bool ExponentialStep::advance_pairs(Eigen::VectorXd& x, const LaneMatrix& S, double gamma, LaneMatrix& FS,
                                    Eigen::VectorXd& shift) {
  if (!usable_) return false;
  S_.reshape(shape_.n, shape_.n);
  set_transposed(S.view(), S_.view());
  usable_ = process_.is_smooth() ? set_smooth_pairs(gamma) : set_pairs(gamma);
  if (!usable_) return false;
  set_mean_shift();
  shift = shift_.view().col(0);
  add_growth(moved_root_, FS);
  x = next_;
  return true;
}

bool ExponentialStep::transition(LaneMatrix& F) {
  if (!usable_ || !set_growth(phi_.E())) return false;  // of a root that is the unit matrix
  F.reshape(shape_.n, shape_.n);
  add_growth(phi_.E(), F);
  return true;
}

bool ExponentialStep::set_smooth_pairs(double gamma) {
  if (!set_growth(moved_root_)) return false;
  if (growth_.columns() == 0) set_spread(moved_root_);
  else if (!is_small_change(growth_, spread_, kRootTolerance)) return false;
  process_.mean_curvature(point_, has_curvature_ ? &point_.chain : nullptr, x_, f_, A_, gamma, S_, first_);
  has_curvature_ = true;
  process_.mean_curvature(point_2_, &point_.chain, x_2_, f_, A_, gamma, spread_, last_);
  first_ *= step_.dt_s;
  last_ *= step_.dt_s;
  return true;
}

bool ExponentialStep::set_pairs(double gamma) {
  const int n = S_.columns();
  set_spread(moved_root_);
  deviations_.reshape(n, n);
  for (int c = 0, i = 0; c < n; ++c)
    for (const int end = (c + 1) * S_.blocks(); i < end; ++i)
      deviations_.lanes()[i] = (gamma * S_.lanes()[i] + x_(c)) - x_(c);
  set_both_parts(step_, x_, f_, deviations_, odd_, first_);
  const LaneColumns<const Lanes> odd = odd_.columns(shape_.first, moving_);
  set_product(deviations_, transposed(right(phi_.E())), n, growth_);
  multiply(odd, transposed(right(phi_.phi_1())), growth_.columns(0, n), true);
  for (int c = 0, i = 0; c < n; ++c)
    for (const int end = (c + 1) * S_.blocks(); i < end; ++i)
      growth_.lanes()[i] = (growth_.lanes()[i] + x_2_(c)) - x_2_(c);
  set_both_parts(end_, x_2_, f_2_, growth_, odd_end_, last_);
  odd_end_.set_lanes([&](std::size_t i) { return odd_end_.lanes()[i] - odd_.lanes()[i]; });
  multiply(odd_end_.columns(shape_.first, moving_), transposed(right(phi_.phi_2())), opposite_.columns(0, n), false);
  if (!is_small_change(opposite_, growth_, kRootTolerance)) return false;
  growth_.set_lanes(
      [&](std::size_t i) { return (growth_.lanes()[i] + opposite_.lanes()[i]) * (1 / gamma) - spread_.lanes()[i]; });
  return true;
}

void ExponentialStep::set_both_parts(const Step& at, const Eigen::VectorXd& x, const Eigen::VectorXd& f,
                                     const LaneMatrix& d, LaneMatrix& odd, Eigen::VectorXd& mean) {
  const int n = d.columns(), count = d.rows();
  const double half = 0.5 * step_.dt_s;
  opposite_.reshape(count, n);
  opposite_.set_lanes([&](std::size_t i) { return -d.lanes()[i]; });
  set_rates(at, x, d, rates_);
  set_rates(at, x, opposite_, odd);
  mean.resize(n);
  for (int c = 0, i = 0; c < n; ++c) {
    for (const int end = (c + 1) * d.blocks(); i < end; ++i) {
      const Lanes plus = rates_.lanes()[i] - f(c), minus = odd.lanes()[i] - f(c);
      rates_.lanes()[i] = half * (plus + minus);
      odd.lanes()[i] = half * (plus - minus);
    }
    mean(c) = sum_of_rows(rates_, c, count) / count;
  }
  multiply(opposite_.columns(0, n), transposed(rows_from(shape_.first, right(Z_))), odd.columns(shape_.first, moving_),
           true);
}

void ExponentialStep::set_variances() {
  const int levels = phi_.doublings();
  set_squares(S_, variance_.col(0).data());
  variance_.col(levels + 1) = spread_squares_;
  for (int k = levels; k > 0; --k) {
    set_product(S_, transposed(rows_from(shape_.first, right(phi_.level(k).E))), moving_, moved_);
    set_squares(moved_, variance_.col(levels + 1 - k).segment(shape_.first, moving_).data());
  }
}

void ExponentialStep::set_mean_shift() {
  const int levels = phi_.doublings();
  set_variances();
  change_of_m_.resize(moving_);
  shift_.set_zero(shape_.n, 1);
  // From node to node: shift_ is the integral up to the left one.
  for (int node = 0; node <= levels; ++node) {
    const int k = node == 0 ? levels : levels + 1 - node;
    const double share = std::exp2(-k), left = node == 0 ? 0 : share, right_end = node == 0 ? share : 2 * share;
    for (int r = 0; r < moving_; ++r) {
      const int i = shape_.first + r;
      const double drop = share * (first_(i) - last_(i)), fall = variance_(i, 0) - variance_(i, levels + 1);
      double at_left = 1 - left, at_right = 1 - right_end, bump = 0;
      if (fall > 0) {
        const double a = variance_(i, node), b = variance_(i, node + 1);
        at_left = std::clamp((a - variance_(i, levels + 1)) / fall, 0.0, 1.0);
        at_right = std::clamp((b - variance_(i, levels + 1)) / fall, 0.0, 1.0);
        bump = std::min(2.0 / 3 * (0.5 * (a + b) - std::sqrt(a * b)) / fall, std::max(at_left, at_right));
      }
      part_(r) = share * last_(i) + drop * (at_left - bump);
      change_of_m_(r) = drop * (at_right - at_left);
    }
    const PhiFunctions::Level& level = phi_.level(k);
    if (node > 0) {
      c_ = shift_.view().col(0);
      set_product(level.E, right(c_), 1, shift_);
    }
    add_product(level.phi_1, right(part_), shift_);
    add_product(level.phi_2, right(change_of_m_), shift_);
  }
}

}  // namespace halyard
