#pragma once
/// A step of the process model by an exponential integrator, without sub-steps. With the rates f(t, x) of
/// arm_dynamics.h, A = ∂f/∂x at the start x, and E, φ_k of h A (phi_functions.h),
///
///   mean          x_2 = x + h φ_1 f(t, x)                            second order: exponential Rosenbrock-Euler
///                 x⁺  = x_2 + c,   c = 2 h φ_3 D,                    third order
///                 D   = f(t + h, x_2) - f(t, x) - A (x_2 - x)
///   transition    F   = E + h φ_2 (A_2 - A) E,   A_2 = ∂f/∂x at x_2   second order
///   deviations    d_2 = E d + h φ_1 N(t, x, d)                       exact for linear f, second order for others
///                 d⁺  = d_2 + h φ_2 (N(t + h, x_2, d_2) - N(t, x, d))
///                 N(t, x, d) = f(t, x + d) - f(t, x) - A d
///   their mean    ∫ exp(A (h - s)) m(s) ds replaces the terms of the mean of N, m(0) to m(h), of all deviations
///   held force    Γ   = Γ_0 + h φ_2 N(t + h, x_2, Γ_0)               response to the accelerations G / h
///                 Γ_0 = (G + 4 exp(h A / 2) G + E G) / 6             φ_1 G by Simpson's rule, as in noise.h
///
///   h      length of the step                            s
///   d      deviation of a sigma point from the mean      [n_states]
///   c      error estimate of x_2                         [n_states]
///   G      impulses of force noise (noise.h)             [n_states x sources]
///
/// The mean of N over a pair of sigma points is the curvature of f, half the second derivative times the variance of
/// what is curved. At rest it falls within the step, as the square of the stiffest deviations, to what the slow ones
/// leave: a straight line from m(0) to m(h) overstates its part in x⁺ 17 times for h λ = 4.4. The integral takes
///
///   m_i(s) = m_i(h) + (m_i(0) - m_i(h)) (V_i(s) - V_i(h)) / (V_i(0) - V_i(h)),   V_i(s) = Σ (exp(A s) d)_i²
///
/// where V_i falls, else the straight line. It goes over [0, h / 2^s], [h / 2^s, 2 h / 2^s], ..., [h / 2, h] by the
/// functions of phi_functions.h, with Simpson's mean of V in each, its middle being the geometric mean of the ends.
///
/// Γ_0 is the response of the linearised model to a force that is held over the step; Γ Γᵀ replaces Van Loan's
/// integral, which is for white noise. Simpson's rule keeps it equal to what the sub-steps give where the model is linear.
///
/// The guard: the step is refused, and the caller takes the sub-steps of process_model.h, if
///
///   - a component of c exceeds 5 % of the standard deviation that the linearised step predicts for it (friction that
///     reverses, a gap that closes, a command that jumps within the step), or
///   - h φ_2 (...) of the deviations exceeds 20 % of them, or
///   - a number is not finite.
///
/// Held forces are refused if the last term of Γ exceeds 5 % of it: at rest, where the noise is faster than friction's
/// smoothing speed and is damped less than the slope of friction says.
///
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010: exponential Rosenbrock-Euler method
/// and exprb32 (mean), ETD2RK (deviations). Van Loan, "Computing integrals involving the matrix exponential", IEEE
/// Trans. Automatic Control 23 (1978).

#include "estimators/matrix/phi_functions.h"
#include "estimators/process/process_model.h"

namespace halyard {

/// Not thread-safe. The process model must outlive this object.
class ExponentialStep {
 public:
  explicit ExponentialStep(const ProcessModel& process);

  /// Linearises at the start x of a step. S: root of the covariance of x. `step` must stay as it is until the next
  /// start(). False if the guard refuses the step.
  bool start(const Step& step, const Eigen::VectorXd& x, const Eigen::MatrixXd& S);

  /// Γ [n_states x sources] of the held forces G; false: refused, Γ is undefined.
  bool respond(const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> Gamma);
  /// x, that of start(), becomes x⁺, and FS [n_states x n_states] F S with the S of start(). False: refused, nothing has
  /// changed.
  bool advance_root(Eigen::VectorXd& x, LaneMatrix& FS);
  /// x, that of start(), becomes x⁺, and every row of d [count x n_states], a deviation, d⁺. With + d_i for the first
  /// half of the rows and - d_i for the second. False: refused, nothing has changed.
  bool advance(Eigen::VectorXd& x, LaneMatrix& d);

 private:
  /// Deviations from the mean as rows, and memory for what follows from them.
  struct Deviations {
    LaneMatrix d, points, N, change;
  };
  /// moved.N = h N of every row d, at the state x with the rates f.
  void set_nonlinear_part(const Step& at, const Eigen::VectorXd& x, const Eigen::VectorXd& f, const LaneMatrix& d,
                          Deviations& moved);
  /// V(0) to V(h) at the nodes 0, h / 2^s, ..., h / 2, h, in variance_.
  void set_variances(const LaneMatrix& d);
  /// ∫ exp(A (h - s)) (m(s) - its straight line) ds, in shift_.
  void set_mean_shift(const LaneMatrix& d);

  const ProcessModel& process_;
  Step step_, end_;
  bool usable_ = false;
  Eigen::VectorXd f_, f_2_, x_2_, next_, D_, c_, part_, change_of_m_;
  Eigen::VectorXd first_, last_;  // h m(0), h m(h)
  Eigen::MatrixXd A_, A_2_, Z_, minus_Z_;
  LaneMatrix spread_;  // E S
  LaneMatrix forces_;
  Deviations response_, start_, moved_;  // of held forces; of sigma points at the start, and d_2
  LaneMatrix half_, variance_;           // E d of half of the points, as columns; V at the nodes
  LaneMatrix vector_, shift_;            // one column
  LaneMatrix slopes_, moved_slopes_;
  PhiFunctions phi_;
};

}  // namespace halyard
