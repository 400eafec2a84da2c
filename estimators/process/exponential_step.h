#pragma once
/// A step of the process model by an exponential integrator, in place of many sub-steps. With the rates f(t, x) of
/// arm_dynamics.h, A = ∂f/∂x at the start x, and E, φ_k of h A (phi_functions.h),
///
///   mean          x_2 = x + h φ_1 f(t, x)                            second order: exponential Rosenbrock-Euler
///                 x⁺  = x_2 + c,   c = 2 h φ_3 D,                    third order, for smooth f in cables and friction
///                 D   = f(t + h, x_2) - f(t, x) - A (x_2 - x)
///   transition    F   = E + h φ_2 (A_2 - A) E,   A_2 = ∂f/∂x at x_2   second order
///   curvature     ∫ exp(A (h - s)) m(s) ds, where m is the mean of N over sigma points x ± d_i; m(0) from N(t, x, d),
///                 m(h) from N_2(t + h, x_2, E d)
///                 N(t, x, d) = f(t, x + d) - f(t, x) - A d: what f is more than linear;   N_2: with A_2
///   held force    Γ   = Γ_0 + h φ_2 (f(t + h, x_2 + Γ_0) - f(t + h, x_2) - A Γ_0)
///                                                                     response to the accelerations G / h
///                 Γ_0 = (G + 4 exp(h A / 2) G + E G) / 6             φ_1 G by Simpson's rule, as in noise.h
///
///   h      length of the step                                        s
///   x      state; x⁺ at the end of the step, x_2 a first estimate    [n_states]
///   D      what f(t + h, x_2) is more than linear from x             [n_states] per s
///   c      correction of x_2, and the estimate of its error          [n_states]
///   S      root of the covariance of x; F S that of x⁺               [n_states x n_states]
///   d      deviation of a sigma point, γ times a column of S         [n_states]
///   G      impulses of force noise (noise.h)                         [n_states x sources]
///   Γ      what these do to x⁺ if the force is held over the step    [n_states x sources]
///
/// Sigma points are assumed to be narrow. Where f is smooth, N then is half the second derivative of f in the direction
/// d. If the process is_plain(), too, arm_curvature.h gives its mean without rates at the points, and the pairs'
/// differences are those of the linear F. There, A_2 and f(t + h, x_2 + Γ_0) take the chain as linear
/// (arm_second_stage.h), so that neither needs a Jacobian at x_2. An effect of a cable may have a kink, such as the
/// edge of a backlash: a step is smooth if none lies between x and x_2 or within four standard deviations beside them.
/// In other steps, and with other effects and slack cables, there may be a kink between the points of a pair. Then the
/// transmission is evaluated at both (arm_changes.h), and this F S takes the place of that with the Jacobian:
///
///   F S   = (d_2 + h φ_2 (N°(t + h, x_2, d_2) - N°(t, x, d))) / γ,   d_2 = E d + h φ_1 N°(t, x, d),   d = γ S
///
/// N° is the odd part of N. N Nᵀ is left out of the covariance: it is of fourth order.
///
/// m is half the mean second derivative of f over the sigma points. At rest it falls within the step; mean_shift.h has
/// the integral.
///
/// The rigid chain changes slowly: within a step it is taken as linear. Beside the slopes of cables and friction its
/// own are small, as is its curvature: a step takes both, and the masses, from an earlier one of the last 10 ms, if it
/// can. It also keeps A and the φ functions of an earlier step if its length is that step's divided by a power of two,
/// and if A_0 = ∂f/∂x at x differs from A by less than 1e-2 / h. f(t, x) is always new, and D and N are the parts of f
/// that are not linear in this A. With an A of an earlier step the mean is of second order, not of third.
///
/// How far A_0 is off, the rates of friction and cables say if the process is plain (excess rate, arm_second_stage.h),
/// else the matrix (distance(), phi_functions.h). Beyond 1e-3 / h the step follows B = A_0 - A: the part h B (x_2 - x)
/// of h D grows with s and not with s², so that it has the weight φ_2 in x⁺, and not 2 φ_3, and
/// F = E + h φ_1 B + h φ_2 ((A_2 - A) E - B). Where f is not smooth, N has it in itself.
///
/// Γ_0 is the response of the linearised model to a force that is held over the step; Γ Γᵀ replaces Van Loan's
/// integral, which is for white noise. Simpson's rule keeps it equal to what the sub-steps give where the model is
/// linear.
///
/// The guard: the step is refused, and the caller takes shorter ones or the sub-steps of process_model.h, if
///
///   - a component of c exceeds 5 % of the standard deviation that the linearised step predicts for it (friction that
///     reverses, a gap that closes, a command that jumps within the step). With effects, up to 20 % will do where f is
///     seen to be curved evenly: its slopes then change by (A_2 - A_0) (x_2 - x) = 2 D, and what D is more than half of
///     it makes c, or
///   - the last term of F S exceeds 20 % of it where sigma points ask for it, or
///   - a number is not finite.
///
/// Held forces are not taken from this formula if the last term of Γ exceeds 5 % of it: at rest, where the noise is
/// faster than friction's smoothing speed and is damped less than the slope of friction says. Where f is smooth,
/// sub-steps of the deviations give it then (arm_impulses.h); else it is refused.
///
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010: exponential Rosenbrock-Euler method
/// and exprb32 (mean), ETD2RK (pairs). Van Loan, "Computing integrals involving the matrix exponential", IEEE
/// Trans. Automatic Control 23 (1978).

#include <limits>

#include "estimators/matrix/mean_shift.h"
#include "estimators/process/process_model.h"

namespace halyard {

/// Not thread-safe. The process model must outlive this object.
class ExponentialStep {
 public:
  explicit ExponentialStep(const ProcessModel& process);

  /// What a step takes from an earlier one. A filter that goes back in time restores it.
  struct Kept {
    double chain_known_since_s = std::numeric_limits<double>::infinity();
    bool has_curvature = false;
    LinearisedPoint point = {};
    double phi_dt_s = std::numeric_limits<double>::quiet_NaN();
    Eigen::MatrixXd A = {};
  };
  void save(Kept& kept) const;
  void restore(const Kept& kept);
  /// The next step does not follow the last one.
  void forget() { chain_known_since_ = std::numeric_limits<double>::infinity(); }
  /// Linearises at the start x of a step. `step` must stay as it is until the next linearise().
  void linearise(const Step& step, const Eigen::VectorXd& x);
  /// M(q)⁻¹ at x.
  Eigen::Map<const Eigen::MatrixXd> mobility() const {
    return {point_.chain.mobility, process_.n_joints(), process_.n_joints()};
  }
  /// Starts the step that has been linearised. S: root of the covariance of x. G [n_states x sources]: held forces,
  /// which may be none. False if the guard refuses the step.
  bool start(const LaneMatrix& S, const Eigen::MatrixXd& G);
  /// False if start() has refused the step because a number is not finite: a shorter one would be refused, too.
  bool is_finite() const { return is_finite_; }

  /// Γ [n_states x sources]; false: refused, Γ is undefined.
  bool respond(Eigen::Ref<Eigen::MatrixXd> Gamma);
  /// x, that of linearise(), becomes x⁺, and the first columns of FS [n_states x any] F S with the S of start(). False:
  /// refused, nothing has changed.
  bool advance_root(Eigen::VectorXd& x, LaneMatrix& FS);
  /// The same, and `shift` becomes the mean of the sigma points x ± gamma S_i after the step, less x⁺. S: of start().
  bool advance_pairs(Eigen::VectorXd& x, const LaneMatrix& S, double gamma, LaneMatrix& FS, Eigen::VectorXd& shift);
  /// F [n_states x n_states] of the step that one of these has just taken; false: it was refused.
  bool transition(LaneMatrix& F);

 private:
  /// The level of phi_ that has the functions for steps of this length; negative: none has.
  int level_of(double dt_s) const;
  /// False if phi_ cannot be computed.
  bool has_functions();
  /// Of this step.
  const PhiFunctions::Level& phi() const { return phi_.level(level_); }
  /// x + h φ_1 f. With w, the rates of the positions, E w - w is h φ_1 A w, and f - A w has no kinematic rows.
  void set_x_2();
  /// Γ_0.
  void set_linear_response(const Eigen::MatrixXd& G);
  /// h D, and -h N of the held forces.
  void set_second_stage();
  /// h N' (x_2 - x) with the slopes at this point, of the moving rows.
  const Eigen::VectorXd& excess_of_u(const LinearisedPoint& at);
  /// |c| <= tolerance, in standard deviations.
  bool is_within(double tolerance) const;
  /// The same with the guard's tolerance, after c has become that of a curvature which is not even.
  bool is_curved_evenly();
  /// h (A_2 - A) in slopes_, once a step.
  void set_end_slopes();
  /// The same as set_second_stage(), by the transmission at x_2 and at x_2 + Γ_0.
  void set_rough_stage();
  void set_spread(const LaneMatrix& moved);
  /// The last term of F S in growth_, which is empty where it is small. moved: E S. False: A_2 is not finite.
  bool set_growth(const LaneMatrix& moved);
  /// The same where f is not smooth. S_: the root, where B is followed.
  bool set_rough_growth(const LaneMatrix& moved);
  /// growth_ of n columns, from h (A_2 - A) E S in moved_ and h B S in odd_.
  void set_growth_of_rates(int n);
  /// The first columns of F become `moved` and growth_.
  void add_growth(const LaneMatrix& moved, LaneMatrix& F);
  /// growth_, first_ and last_ from one point of each pair, where f is smooth; false: refused.
  bool set_smooth_pairs(double gamma);
  /// The same from both points.
  bool set_pairs(double gamma);
  /// The chain's part of the means of N, in point_.
  void set_chain_curvature(double gamma);
  /// h N(t, x, ± d_i) where `known` is of x: the moving rows of its odd part for every row of d, and the mean of its
  /// even part.
  void set_both_parts(const Step& at, const KnownRates& known, const LaneMatrix& d, LaneMatrix& odd,
                      Eigen::VectorXd& mean);

  const ProcessModel& process_;
  const PhiShape shape_;  // of A
  const int moving_;      // number of rows that are neither kinematic nor zero
  Step step_, end_;
  bool usable_ = false, is_finite_ = false;
  bool is_smooth_ = false;  // the step uses the structure of a plain transmission
  double chain_known_since_ = std::numeric_limits<double>::infinity();  // time of M and the slopes in point_.chain, s
  bool has_curvature_ = false;                                          // in point_.chain
  double phi_dt_s_ = std::numeric_limits<double>::quiet_NaN();          // length of the step of phi_, whose A is A_
  bool phi_is_due_ = true;                                              // it has to be computed from A_
  int level_ = 0;                                                       // of phi_, for this step
  bool answer_is_due_ = true;                                           // so has response_
  bool is_off_ = false, has_slopes_ = false;                            // B is followed; slopes_ are of this step
  Eigen::VectorXd x_, f_, f_2_, x_2_, u_, next_, c_;                    // u_: x_2 - x
  Eigen::VectorXd D_, L_, excess_, part_;                               // of the moving rows; h D, h B (x_2 - x)
  Eigen::VectorXd first_, last_;                                        // h m(0), h m(h)
  Eigen::MatrixXd A_, A_2_, Z_, Z_0_, slopes_;                          // Z_: h A; Z_0_: h B
  LinearisedPoint point_{}, point_2_{};                                 // of linearise() at x and x_2
  // Transposed, a row for each column of S or G:
  LaneMatrix S_, spread_, moved_, growth_;  // S, E S, products with S, the last term of F S
  Eigen::MatrixXd G_;                       // of response_
  LaneMatrix forces_, response_;            // G, Γ_0; row 0 is for x_2 itself
  LaneMatrix held_, rates_;                 // x_2 - x with Γ_0, and what f changes by there
  LaneMatrix minus_N_, change_;             // -h N, and what the last term of Γ subtracts; then Γ
  LaneMatrix u_row_, excess_row_;           // u, and excess_of_u()
  LaneMatrix pairs_, pair_changes_;         // ± d, and what f changes by there
  LaneMatrix deviations_, odd_, odd_end_;   // d, and the odd parts of h N at the start and the end
  LaneMatrix last_term_;                    // of γ F S
  LaneMatrix shift_;                        // one column
  LaneMatrix moved_root_;                   // E S
  Eigen::VectorXd spread_squares_;          // of its rows
  MeanShift mean_shift_;
  PhiFunctions phi_;
};

}  // namespace halyard
