#include <algorithm>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "plant/integrators/integrator.h"
#include "plant/integrators/step_matrix.h"

namespace halyard {
namespace {

using boost::numeric::odeint::default_rosenbrock_coefficients;

/// Steps between two ticks before the motion counts as not integrable.
constexpr int kMaxSteps = 100000;
/// Bounds of the ratio of a step to the step before, and the share of the step that just meets the tolerance
/// (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8).
constexpr double kMostShrink = 0.2, kMostGrowth = 6, kSafety = 0.9;
/// How much longer than kSafety allows a step may be if that saves one: still within the tolerance, 1.1 kSafety < 1.
constexpr double kStretch = 1.1;
/// Distance in time of the difference that gives ∂f/∂t, as a share of a step.
constexpr double kTimeDifference = 1e-3;

/// Rosenbrock's method of fourth order with an error estimate of third order, stiffly accurate (RODAS; Hairer and
/// Wanner, IV.7). With the exact Jacobian J, a step h from y solves a linear system for each of its six stages:
///
///   (1 / (γ h) - J) g_i = f(t + c_i h, y + Σ_j a_ij g_j) + h d_i ∂f/∂t + Σ_j c_ij g_j / h
///
/// The last stage is the estimate of the error. The coefficients, in this notation, are those of Boost's odeint. Its
/// own stepper is not used because its linear algebra takes several times as long.
class Rosenbrock : public Integrator {
 public:
  Rosenbrock(ArmPlant& plant, const IntegratorOptions& options, double time_s, const Eigen::VectorXd& y)
      : plant_(plant),
        relative_tolerance_(options.relative_tolerance),
        absolute_tolerance_(absolute_tolerances(plant.drive(), options.absolute_tolerance)),
        depends_on_time_(!plant.drive().transmission().effects().empty()),
        matrix_(plant.layout()),
        time_(time_s),
        y_(y),
        J_(Eigen::MatrixXd::Zero(y.size(), y.size())) {
    for (Eigen::VectorXd* v : {&at_, &f_, &f_time_, &rate_}) v->setZero(y.size());
    for (Eigen::VectorXd& g : g_) g.setZero(y.size());
  }

  void advance(double until_s) override {
    int steps = 0;
    // The torque jumps at a tick, and what follows is fast: a tick begins like the one before, not as that one ended.
    step_ = first_step_;
    try {
      for (bool first = true; time_ < until_s; first = false) {
        step(until_s, steps);
        if (first) first_step_ = step_;
      }
    } catch (const std::runtime_error& error) {
      fail_between(time_, until_s, error.what());
    }
  }

  const Eigen::VectorXd& state() const override { return y_; }

 private:
  void step(double until_s, int& steps) {
    const double left = until_s - time_;
    double h = left / std::ceil(left / (kStretch * step_));  // equal steps to the tick, so that none is tiny
    linearise(h);
    double error = attempt(h);
    while (!(error <= 1)) {
      h *= std::isfinite(error) ? std::max(kMostShrink, change(error)) : kMostShrink;
      if (time_ + h == time_) throw std::runtime_error(why_.empty() ? "the step becomes too small" : why_);
      error = attempt(h);
      ++steps;
    }
    if (++steps > kMaxSteps) throw std::runtime_error("too many steps");
    time_ = h < left ? time_ + h : until_s;
    y_.swap(at_);
    step_ = h * std::min(kMostGrowth, change(error));
  }

  static double change(double error) { return kSafety / std::sqrt(std::sqrt(std::max(error, 1e-12))); }

  /// f, ∂f/∂t and J at the start of a step.
  void linearise(double h) {
    plant_.jacobian(time_, y_.data(), f_.data(), J_);
    if (!depends_on_time_) return;
    const double dt = kTimeDifference * h;
    plant_.derivative(time_ + dt, y_.data(), f_time_.data());
    f_time_ = (f_time_ - f_) / dt;
  }

  /// Sets at_ to the state after a step of h; returns its error over the tolerance. Infinite: no rate there.
  double attempt(double h) {
    try {
      stages(h);
    } catch (const std::runtime_error& error) {
      why_ = error.what();
      return INFINITY;
    }
    double sum = 0;
    for (Eigen::Index i = 0; i < y_.size(); ++i) {
      const double size = std::max(std::abs(y_(i)), std::abs(at_(i)));
      const double share = g_[5](i) / (absolute_tolerance_(i) + relative_tolerance_ * size);
      if (absolute_tolerance_(i) < kUncontrolled) sum += share * share;
    }
    return std::sqrt(sum / static_cast<double>(y_.size() - 2));
  }

  void stages(double h) {
    const auto& k = coefficients_;
    matrix_.factor(J_, k.gamma * h);
    solve(0, f_, h, k.d1);
    rate_at(time_ + k.c2 * h, k.a21);
    solve(1, rate_, h, k.d2, k.c21);
    rate_at(time_ + k.c3 * h, k.a31, k.a32);
    solve(2, rate_, h, k.d3, k.c31, k.c32);
    rate_at(time_ + k.c4 * h, k.a41, k.a42, k.a43);
    solve(3, rate_, h, k.d4, k.c41, k.c42, k.c43);
    rate_at(time_ + h, k.a51, k.a52, k.a53, k.a54);
    solve(4, rate_, h, 0, k.c51, k.c52, k.c53, k.c54);
    at_ += g_[4];
    plant_.derivative(time_ + h, at_.data(), rate_.data());
    solve(5, rate_, h, 0, k.c61, k.c62, k.c63, k.c64, k.c65);
    at_ += g_[5];
  }

  /// f at the state that the stages before lead to, which at_ keeps.
  template <class... Share>
  void rate_at(double time_s, Share... a) {
    at_ = plus_stages(y_, std::index_sequence_for<Share...>(), a...);
    plant_.derivative(time_s, at_.data(), rate_.data());
  }

  template <class... Share>
  void solve(int stage, const Eigen::VectorXd& rate, double h, double d, Share... c) {
    Eigen::VectorXd& g = g_[stage];
    g = plus_stages(rate, std::index_sequence_for<Share...>(), c / h...);
    if (depends_on_time_ && d != 0) g += h * d * f_time_;
    matrix_.solve(g.data());
  }

  /// x + Σ_j a_j g_j in one pass.
  template <std::size_t... j, class... Share>
  auto plus_stages(const Eigen::VectorXd& x, std::index_sequence<j...>, Share... a) const {
    return (x + ... + (a * g_[j]));
  }

  const default_rosenbrock_coefficients<double> coefficients_;
  ArmPlant& plant_;
  double relative_tolerance_;
  Eigen::VectorXd absolute_tolerance_;
  bool depends_on_time_;  ///< an effect may depend on the time itself
  StepMatrix matrix_;
  double time_, step_ = 1e-3, first_step_ = step_;
  Eigen::VectorXd y_, at_, f_, f_time_, rate_, g_[6];
  Eigen::MatrixXd J_;
  std::string why_;  ///< what the last stage without a rate said
};

}  // namespace

std::unique_ptr<Integrator> make_rosenbrock_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                       const Eigen::VectorXd& y) {
  return std::make_unique<Rosenbrock>(plant, options, time_s, y);
}

}  // namespace halyard
