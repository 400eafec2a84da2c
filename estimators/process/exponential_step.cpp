#include "estimators/process/exponential_step.h"

#include <cmath>

namespace halyard {
namespace {

constexpr double kMeanTolerance = 0.05;       // of a standard deviation
constexpr double kDeviationTolerance = 0.2;   // of the deviations
constexpr double kHeldForceTolerance = 0.05;  // of the response

/// ‖row of change‖ <= tolerance ‖row of whole‖ for all rows; false if one is not finite.
bool small_change(const LaneMatrix& change, const LaneMatrix& whole, double tolerance) {
  return (change.view().rowwise().squaredNorm().array() <=
          tolerance * tolerance * whole.view().rowwise().squaredNorm().array())
      .all();
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
  usable_ =
      (c_.array().square() <= kMeanTolerance * kMeanTolerance * spread_.view().rowwise().squaredNorm().array()).all();
  return usable_;
}

void ExponentialStep::evaluate_around(const Step& at, const Eigen::VectorXd& x, const LaneMatrix& d, Rates& rates) {
  rates.points.resize(x.size(), d.columns() + 1);
  rates.points.col(0) = x;
  rates.points.rightCols(d.columns()) = d.view().colwise() + x;
  rates.x_dot.resize(rates.points.rows(), rates.points.cols());
  process_.derivatives(at, rates.points, rates.x_dot);
}

void ExponentialStep::set_nonlinear_part(const Rates& rates, const LaneMatrix& d, LaneMatrix& N) {
  N.set_zero(d.rows(), d.columns());
  N.view() = step_.dt_s * (rates.x_dot.rightCols(d.columns()).colwise() - rates.x_dot.col(0));
  add_product(minus_Z_, d.view(), N);
}

bool ExponentialStep::respond(const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> Gamma) {
  if (!usable_) return false;
  set_product(phi_.E_half(), G, d_);
  d_.view() = 4 * d_.view() + G;
  add_product(phi_.E(), G, d_);
  d_.view() /= 6;
  evaluate_around(end_, x_2_, d_, forces_);
  set_nonlinear_part(forces_, d_, N_);
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

void ExponentialStep::set_mean_shift(const Eigen::VectorXd& first, const Eigen::VectorXd& last) {
  const int parts = phi_.parts();
  const auto E = phi_.E_part().view();
  shift_.setZero(first.size());
  ratio_ = (first.array() * last.array() > 0 && last.array().abs() < first.array().abs())
               .select(last.array() / first.array(), 1.0);
  // The straight line lacks nothing at both ends of the step.
  for (int i = 1; i < parts; ++i) {
    const double s = static_cast<double>(i) / parts;
    part_.noalias() = E * shift_;
    shift_ = part_;
    for (Eigen::Index k = 0; k < shift_.size(); ++k)
      if (ratio_(k) < 1)
        shift_(k) += (first(k) * std::pow(ratio_(k), s) - (first(k) + s * (last(k) - first(k)))) / parts;
  }
  part_.noalias() = E * shift_;
  shift_ = part_;
}

bool ExponentialStep::advance(Eigen::MatrixXd& X) {
  if (!usable_) return false;
  const int n = static_cast<int>(X.rows()), count = static_cast<int>(X.cols()) - 1;
  d_.set_zero(n, count);
  d_.view() = X.rightCols(count).colwise() - X.col(0);
  deviations_.x_dot.resize(n, count + 1);
  process_.derivatives(step_, X, deviations_.x_dot);
  set_nonlinear_part(deviations_, d_, N_);
  set_product(phi_.E(), d_.view(), d_2_);
  add_product(phi_.phi_1(), N_.view(), d_2_);
  evaluate_around(end_, x_2_, d_2_, deviations_);
  set_nonlinear_part(deviations_, d_2_, N_2_);
  first_ = N_.view().rowwise().mean();
  last_ = N_2_.view().rowwise().mean();
  set_mean_shift(first_, last_);
  N_2_.view() -= N_.view();
  set_product(phi_.phi_2(), N_2_.view(), change_);
  if (!small_change(change_, d_2_, kDeviationTolerance)) return false;
  X.col(0) = next_;
  d_2_.view() += change_.view();
  d_2_.view().colwise() += shift_;
  X.rightCols(count) = d_2_.view().colwise() + next_;
  return true;
}

}  // namespace halyard
