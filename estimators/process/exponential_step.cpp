#include "estimators/process/exponential_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halyard {
namespace {

constexpr double kChainAge = 1e-2;            // s; at 1 m/s or rad/s a change of 10 mm or mrad
constexpr double kMeanTolerance = 0.05;       // of a standard deviation
constexpr double kCurvedTolerance = 0.2;      // the same where f is seen to be curved evenly
constexpr double kRootTolerance = 0.2;        // of the root
constexpr double kHeldForceTolerance = 0.05;  // of the response
constexpr double kNoGrowth = 1e-3;            // of the root
constexpr double kNear = 1e-2;                // largest h (A - A_k) that is followed beside A_k
constexpr double kKinkReach = 4;              // standard deviations
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
      moving_(shape_.end - shape_.first),
      mean_shift_(shape_) {
  const Step usual{.dt_s = 1e-3};
  process.linearise(usual, Eigen::VectorXd::Zero(process.n_states()), f_, A_);
  phi_.balance(usual.dt_s * A_);
  L_.resize(moving_);
  excess_.resize(moving_);
  u_row_.reshape(1, shape_.n);
  excess_row_.reshape(1, moving_);
  Z_0_.resize(shape_.n, shape_.n);
  slopes_.resize(shape_.n, shape_.n);
  S_.reshape(shape_.n, shape_.n);
  odd_.reshape(shape_.n, moving_);
}

int ExponentialStep::level_of(double dt_s) const {
  for (int k = 0; k < phi_.doublings(); ++k)
    if (std::abs(std::ldexp(dt_s, k) - phi_dt_s_) <= kSameLength * phi_dt_s_) return k;
  return -1;
}

void ExponentialStep::linearise(const Step& step, const Eigen::VectorXd& x) {
  step_ = end_ = step;
  end_.time_s += step.dt_s;
  x_ = x;
  is_off_ = has_slopes_ = false;
  const bool known = step.time_s >= chain_known_since_ && step.time_s < chain_known_since_ + kChainAge;
  const int level = known && has_functions() ? level_of(step.dt_s) : -1;
  if (level != level_) answer_is_due_ = true;
  if (level >= 0 && process_.is_plain()) {
    process_.rates_beside(step, x, f_, point_);
    level_ = level;
    const double off = step.dt_s * point_.excess_rate;
    is_off_ = off > kNoGrowth;
    if (off <= kNear) return;
    is_off_ = false;
  }
  if (!known) chain_known_since_ = step.time_s, has_curvature_ = false;
  process_.linearise(step, x, known ? &point_.chain : nullptr, f_, A_2_, point_);
  if (level >= 0 && !process_.is_plain()) {
    const double off = step.dt_s * phi_.distance(A_2_, A_);
    if (off <= kNear) {
      level_ = level;
      is_off_ = off > kNoGrowth;
      if (is_off_) Z_0_ = step.dt_s * (A_2_ - A_);
      return;
    }
  }
  A_.swap(A_2_);
  phi_dt_s_ = step.dt_s;
  level_ = 0;
  phi_is_due_ = answer_is_due_ = true;
}

bool ExponentialStep::has_functions() {
  if (phi_is_due_ && !phi_.compute(phi_dt_s_, A_, shape_)) return false;
  phi_is_due_ = false;
  return true;
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
  phi_is_due_ = answer_is_due_ = true;
}

bool ExponentialStep::start(const LaneMatrix& S, const Eigen::MatrixXd& G) {
  const int n = static_cast<int>(x_.size());
  usable_ = std::isfinite(f_.sum()) && has_functions();
  is_finite_ = false;
  if (!usable_) return forget(), false;
  set_x_2();
  is_smooth_ = process_.is_plain() && !process_.has_kink_near(step_, x_, point_, x_2_, kKinkReach, S);
  set_linear_response(G);
  set_second_stage();
  set_product(phi().phi_3, right(D_), 1, shift_);
  c_ = 2 * shift_.view().col(0);
  next_ = x_2_ + c_;
  if (is_off_) {
    set_product(phi().phi_2, right(L_), 1, shift_);
    next_ += shift_.view().col(0);
    S_.reshape(n, n);
    set_transposed(S.view(), S_.view());
  }
  set_product(phi().E, right(S), n, moved_root_);
  spread_squares_.resize(n);
  set_row_squares(moved_root_, n, spread_squares_.data());
  is_finite_ = std::isfinite(c_.squaredNorm() + spread_squares_.sum());
  usable_ = is_within(kMeanTolerance) || (process_.has_effects() && is_within(kCurvedTolerance) && is_curved_evenly());
  return usable_;
}

bool ExponentialStep::is_within(double tolerance) const {
  bool within = true;
  for (int i = 0; i < shape_.n; ++i) within &= c_(i) * c_(i) <= tolerance * tolerance * spread_squares_(i);
  return within;
}

const Eigen::VectorXd& ExponentialStep::excess_of_u(const LinearisedPoint& at) {
  for (int c = 0; c < shape_.n; ++c) u_row_.view()(0, c) = u_(c);
  process_.near_excess(point_, at, step_.dt_s, u_row_, excess_row_);
  excess_ = excess_row_.view().row(0);
  return excess_;
}

bool ExponentialStep::is_curved_evenly() {
  part_ = D_;
  if (is_smooth_) {
    part_ -= 0.5 * excess_of_u(point_2_);
  } else {
    set_end_slopes();
    part_.noalias() -= 0.5 * slopes_.middleRows(shape_.first, moving_) * u_;
  }
  if (is_off_) part_ += 0.5 * L_;
  set_product(phi().phi_3, right(part_), 1, shift_);
  c_ = 2 * shift_.view().col(0);
  return is_within(kMeanTolerance);
}

void ExponentialStep::set_x_2() {
  const int p = shape_.first;
  part_ = f_.segment(p, moving_);
  part_.noalias() -= A_.block(p, p, moving_, p) * x_.segment(p, p);
  part_ *= step_.dt_s;
  shift_.reshape(shape_.n, 1);
  multiply(phi().E.columns(p, p), rows_from(p, right(x_)), shift_.columns(0, 1), false);
  multiply(phi().phi_1.columns(0, moving_), right(part_), shift_.columns(0, 1), true);
  x_2_ = x_ + shift_.view().col(0);
  x_2_.segment(p, p) -= x_.segment(p, p);
}

void ExponentialStep::set_linear_response(const Eigen::MatrixXd& G) {
  const int n = shape_.n, sources = static_cast<int>(G.cols());
  if (!answer_is_due_ && G_.size() == G.size() && std::equal(G.data(), G.data() + G.size(), G_.data())) return;
  answer_is_due_ = false;
  G_ = G;
  forces_.reshape(1 + sources, n);
  response_.reshape(1 + sources, n);
  set_rows_transposed(G, forces_, 1);
  const LaneColumns<const Lanes> forces = forces_.columns(shape_.first, moving_);
  const auto response = response_.columns(0, n);
  multiply(forces, transposed(right(phi_.level(level_ + 1).E.columns(shape_.first, moving_))), response, false);
  response_.set_lanes([&](std::size_t i) { return 4.0 * response_.lanes()[i] + forces_.lanes()[i]; });
  multiply(forces, transposed(right(phi().E.columns(shape_.first, moving_))), response, true);
  response_.set_lanes([&](std::size_t i) { return (1.0 / 6) * response_.lanes()[i]; });
}

void ExponentialStep::set_second_stage() {
  if (!is_smooth_) return set_rough_stage();
  const double h = step_.dt_s;
  u_ = x_2_ - x_;
  process_.second_stage(end_, point_, x_, x_2_, point_2_, D_);
  D_ *= h;
  process_.far_excess(end_, point_, point_2_, x_2_, -h, response_, minus_N_);
  if (!is_off_) return;
  L_ = excess_of_u(point_);
  D_ -= L_;
}

bool ExponentialStep::respond(Eigen::Ref<Eigen::MatrixXd> Gamma) {
  if (!usable_) return false;
  const int n = response_.columns(), sources = response_.rows() - 1;
  change_.reshape(sources + 1, n);
  multiply(minus_N_.columns(0, moving_), transposed(right(phi().phi_2)), change_.columns(0, n), false);
  if (is_small_change(change_, response_, kHeldForceTolerance)) {
    change_.set_lanes([&](std::size_t i) { return response_.lanes()[i] - change_.lanes()[i]; });
  } else if (is_smooth_) {
    change_ = response_;
    process_.impulse_response(step_, point_, A_, x_, x_2_, forces_, change_);
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
  if (!is_smooth_) return set_rough_growth(moved);
  if (step_.dt_s * point_2_.excess_rate <= kNoGrowth && !is_off_) return growth_.set_zero(0, 0), true;
  set_spread(moved);
  process_.near_excess(point_, point_2_, step_.dt_s, spread_, moved_);
  if (is_off_) process_.near_excess(point_, point_, step_.dt_s, S_, odd_);
  set_growth_of_rates(moved.columns());
  return true;
}

void ExponentialStep::set_growth_of_rates(int n) {
  if (!is_off_) return set_product(moved_, transposed(right(phi().phi_2)), n, growth_);
  moved_.set_lanes([&](std::size_t i) { return moved_.lanes()[i] - odd_.lanes()[i]; });
  set_product(odd_, transposed(right(phi().phi_1)), n, growth_);
  add_product(moved_, transposed(right(phi().phi_2)), growth_);
}

bool ExponentialStep::set_rough_growth(const LaneMatrix& moved) {
  const int n = moved.columns();
  set_end_slopes();
  const double change = step_.dt_s * phi_.distance(A_2_, A_);
  if (!std::isfinite(change)) return false;
  if (change <= kNoGrowth && !is_off_) return growth_.set_zero(0, 0), true;
  set_spread(moved);
  moved_.reshape(n, moving_);
  multiply(spread_.columns(0, n), transposed(rows_from(shape_.first, right(slopes_))), moved_.columns(0, moving_),
           false);
  if (is_off_) {
    odd_.reshape(n, moving_);
    multiply(S_.columns(0, n), transposed(rows_from(shape_.first, right(Z_0_))), odd_.columns(0, moving_), false);
  }
  set_growth_of_rates(n);
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
  usable_ = is_smooth_ ? set_smooth_pairs(gamma) : set_pairs(gamma);
  if (!usable_) return false;
  mean_shift_.compute(phi_, level_, S_, spread_squares_, first_, last_, shift_);
  shift = shift_.view().col(0);
  add_growth(moved_root_, FS);
  x = next_;
  return true;
}

bool ExponentialStep::transition(LaneMatrix& F) {
  if (is_off_) S_.view().setIdentity();  // a root that is the unit matrix
  if (!usable_ || !set_growth(phi().E)) return false;
  F.reshape(shape_.n, shape_.n);
  add_growth(phi().E, F);
  return true;
}

bool ExponentialStep::set_smooth_pairs(double gamma) {
  if (!set_growth(moved_root_)) return false;
  if (growth_.columns() == 0) set_spread(moved_root_);
  else if (!is_small_change(growth_, spread_, kRootTolerance)) return false;
  set_chain_curvature(gamma);
  process_.mean_curvature(step_, x_, point_.chain, point_, gamma, S_, first_);
  process_.mean_curvature(end_, x_2_, point_.chain, point_2_, gamma, spread_, last_);
  first_ *= step_.dt_s;
  last_ *= step_.dt_s;
  return true;
}

void ExponentialStep::set_chain_curvature(double gamma) {
  if (!has_curvature_) process_.chain_curvature(point_, x_, f_, A_, gamma, S_);
  has_curvature_ = true;
}

bool ExponentialStep::set_pairs(double gamma) {
  const int n = S_.columns();
  set_spread(moved_root_);
  set_chain_curvature(gamma);
  deviations_.reshape(n, n);
  for (int c = 0, i = 0; c < n; ++c)
    for (const int end = (c + 1) * S_.blocks(); i < end; ++i)
      deviations_.lanes()[i] = (gamma * S_.lanes()[i] + x_(c)) - x_(c);
  set_both_parts(step_, {x_.data(), f_.data(), point_.force}, deviations_, odd_, first_);
  set_product(deviations_, transposed(right(phi().E)), n, growth_);
  add_product(odd_, transposed(right(phi().phi_1)), growth_);
  for (int c = 0, i = 0; c < n; ++c)
    for (const int end = (c + 1) * S_.blocks(); i < end; ++i)
      growth_.lanes()[i] = (growth_.lanes()[i] + x_2_(c)) - x_2_(c);
  set_both_parts(end_, {x_2_.data(), f_2_.data(), point_2_.force}, growth_, odd_end_, last_);
  odd_end_.set_lanes([&](std::size_t i) { return odd_end_.lanes()[i] - odd_.lanes()[i]; });
  set_product(odd_end_, transposed(right(phi().phi_2)), n, last_term_);
  if (!is_small_change(last_term_, growth_, kRootTolerance)) return false;
  growth_.set_lanes(
      [&](std::size_t i) { return (growth_.lanes()[i] + last_term_.lanes()[i]) * (1 / gamma) - spread_.lanes()[i]; });
  return true;
}

}  // namespace halyard
