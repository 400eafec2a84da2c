#pragma once
/// The arm in discrete time: x_k+1 = f(x_k) integrates the differential equation of arm_dynamics.h over one step under
/// a held command; z = h(x) is the reading of the motor encoders.
///
///   x       state, ordered as in StateLayout: q_m and q joint by joint, their rates, effects    [n_states]
///   f       classical Runge-Kutta of fourth order in `substeps(dt)` equal parts
///   F       ∂f/∂x of the whole step, exact to rounding                                          [n_states x n_states]
///   z       reading of motor k: q_m + offset + sensor effects                                   [n]  rad
///
/// Friction near standstill is far stiffer than cables, and an unstable step there makes a filter diverge. So the
/// sub-step h satisfies h |λ| <= 2.2, where λ is the largest eigenvalue of ∂x'/∂x at standstill. (Runge-Kutta's limit
/// is 2.6 in its least stable direction.) λ is searched for at home and at the ends of the joints' ranges, both
/// unloaded and under the motors' full torque in either direction.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimators/lanes/lane_kernels.h"
#include "estimators/matrix/lane_matrix.h"
#include "estimators/process/arm_dynamics.h"
#include "estimators/process/held_torques.h"
#include "model/arm_model.h"

namespace halyard {

/// Time, inputs and length of one step.
struct Step {
  double time_s = 0;                        ///< start of the step
  double dt_s = 0;                          ///< > 0
  const double* motor_torque = nullptr;     ///< [n] commanded, held over the step, N m
  const double* external_force = nullptr;   ///< [n] on the joints, N m | N; null: none
  const CommandHistory* history = nullptr;  ///< for effects with a delay; null: none
  const HeldTorques* held = nullptr;        ///< how well the torques are known; null: exactly, but for their noise
};

/// How long filters remember commands, s: longer than any delay.
inline constexpr double kHistorySpan = 2;

/// Into how many equal steps, none longer than `longest_s`, a span is divided; at least one.
int steps_over(double span_s, double longest_s);

/// Eight columns of X from `first` on; the last one fills unused lanes.
void load_lanes(const Eigen::Ref<const Eigen::MatrixXd>& X, int first, Lanes* x);

/// Accelerations of joints for sensors whose delay d is of second order: q'' = slope (q' - slow), where `slow` is q'
/// behind a low-pass filter of first order with the time constant 1/slope. A state's own q'' would not do: friction
/// near standstill makes it sensitive to q' by 1e5 1/s.
struct LaggedRates {
  double slow[kMaxJoints] = {};   ///< rad/s | m/s
  double slope[kMaxJoints] = {};  ///< 1/s; 0: no acceleration
};

/// What the encoders read of a state: motors [n], 0 for a joint without one, and joints [n], if they are wanted.
template <class T>
HALYARD_INLINE void read_encoders(const Transmission<T>& transmission, const StateLayout& layout, double time_s,
                                  const T* x, T* motors, T* joints = nullptr, const LaggedRates& lagged = {}) {
  JointSignals<T> s[kMaxJoints];
  unpack_state(transmission.arm(), layout, x, s);
  for (int k = 0; k < layout.n_joints; ++k)
    s[k].joint_acceleration = T(lagged.slope[k]) * (s[k].joint_rate - T(lagged.slow[k]));
  transmission.sensor_errors(time_s, x + layout.effect_states, s);
  for (int k = 0; k < layout.n_joints; ++k) {
    const bool driven = transmission.arm().joint[k].drive != Drive::none;
    motors[k] = driven ? s[k].motor_angle + s[k].motor_error : T(0.0);
    if (joints) joints[k] = s[k].joint_position + s[k].joint_error;
  }
}

class ProcessModel {
 public:
  /// Largest number of sub-steps in a step of up to 1 ms; a longer step may have as many in each millisecond. This
  /// limits the cost at 1 kHz. A model that needs more is too stiff.
  static constexpr int kMaxSubsteps = 500;

  /// Throws InputError if the effects have too many states, and std::runtime_error if the model gives no finite
  /// derivative at standstill.
  explicit ProcessModel(const ArmModel& model);

  int n_joints() const { return layout_.n_joints; }
  int n_states() const { return layout_.size; }
  const StateLayout& layout() const { return layout_; }
  const ArmParameters<double>& arm() const { return transmission_.arm(); }  ///< with the effects' changes
  const Transmission<double>& transmission() const { return transmission_; }
  const Transmission<Dual>& dual_transmission() const { return dual_; }
  const Transmission<Lanes>& lane_transmission() const { return lanes_; }
  /// "motor_rate_2", "joint_position_1", "hysteresis_3_state_1", ...
  const std::string& state_name(int i) const { return state_names_[i]; }

  /// Largest |λ| at standstill, 1/s.
  double stiffest_rate() const { return stiffest_rate_; }
  /// The state with the largest part in that eigenvalue's mode.
  const std::string& stiffest_state() const { return state_names_[stiffest_state_]; }
  /// Number of sub-steps that keep h |λ| within the bound.
  double substeps_needed(double dt_s) const;
  /// Number of sub-steps of a step. Throws std::runtime_error naming state and rate if kMaxSubsteps is too few.
  int substeps(double dt_s) const;

  /// x becomes f(x). This and the following functions throw std::runtime_error with time and state name if a result is
  /// not finite.
  void advance(const Step& step, double* x) const;
  /// Every column of X [n_states x count] becomes f(column), eight at a time.
  void advance_many(const Step& step, Eigen::Ref<Eigen::MatrixXd> X) const { advance_many(step, X, lane_kernels()[0]); }
  void advance_many(const Step& step, Eigen::Ref<Eigen::MatrixXd> X, const LaneKernels& kernels) const;
  /// F becomes ∂f/∂x at the old x; then x becomes f(x).
  void advance_with_jacobian(const Step& step, double* x, Eigen::Ref<Eigen::MatrixXd> F) const {
    advance_with_jacobian(step, x, F, lane_kernels()[0]);
  }
  void advance_with_jacobian(const Step& step, double* x, Eigen::Ref<Eigen::MatrixXd> F,
                             const LaneKernels& kernels) const;

  /// x' at x, and its Jacobian A = ∂x'/∂x [n_states x n_states].
  Eigen::VectorXd derivative(const Step& step, const Eigen::VectorXd& x, Eigen::MatrixXd* A = nullptr) const;
  /// The same into memory of the caller.
  void derivative(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot) const;
  void linearise(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot, Eigen::MatrixXd& A) const;
  /// The same, and `point`, what is found besides (arm_linearisation.h). near: null, or what was found of the chain at
  /// a state shortly before, from which its masses and slopes are taken.
  void linearise(const Step& step, const Eigen::VectorXd& x, const ChainPoint* near, Eigen::VectorXd& x_dot,
                 Eigen::MatrixXd& A, LinearisedPoint& point) const;
  /// A at x, with the chain as linearise() found it at a state shortly before.
  void jacobian_beside(const Step& step, const Eigen::VectorXd& x, const ChainPoint& chain, Eigen::MatrixXd& A) const;
  /// f(x + d) - f(x) of every row d of the matrix [count x n_states], eight at a time: changes [count x n_states -
  /// positions], without the rows of the positions (arm_changes.h). first_force: null, or F [n] at the first x + d.
  void changes(const Step& step, const ChainPoint& chain, const KnownRates& at, const LaneMatrix& d,
               LaneMatrix& changes, double* first_force = nullptr) const;
  /// The chain's part of the mean of f(x + d_i) - f(x) - A d_i over d_i = gamma S_i, into point.chain.curvature
  /// (arm_curvature.h). x_dot, A, point: of linearise() at x. root: S transposed.
  void chain_curvature(LinearisedPoint& point, const Eigen::VectorXd& x, const Eigen::VectorXd& x_dot,
                       const Eigen::MatrixXd& A, double gamma, const LaneMatrix& root) const;
  /// Of a model that is_plain(), as the next ones: mean [n_states] of it all at x, with the chain's part that of
  /// `chain`. point: at x and the start of the step.
  void mean_curvature(const Step& step, const Eigen::VectorXd& x, const ChainPoint& chain, const LinearisedPoint& point,
                      double gamma, const LaneMatrix& root, Eigen::VectorXd& mean) const;
  /// With `start` at x, the second stage x_2 of a step (arm_second_stage.h): D [moving_states() - layout().positions],
  /// and `end`, the point at x_2 and the start of the step `next`, as in the next ones.
  void second_stage(const Step& next, const LinearisedPoint& start, const Eigen::VectorXd& x,
                    const Eigen::VectorXd& x_2, LinearisedPoint& end, Eigen::VectorXd& D) const;
  /// x' at x, beside the A and `point` of linearise() at a state shortly before: slopes stay those of A.
  /// point.excess_rate says how well they fit.
  void rates_beside(const Step& step, const Eigen::VectorXd& x, Eigen::VectorXd& x_dot, LinearisedPoint& point) const;
  /// factor N(d) at x_2, of every row d of the matrix [count x n_states]; rates [count x D.size()].
  void far_excess(const Step& next, const LinearisedPoint& start, const LinearisedPoint& end,
                  const Eigen::VectorXd& x_2, double factor, const LaneMatrix& d, LaneMatrix& rates) const;
  /// factor N' d, with the slopes at a point, `start` or `end`.
  void near_excess(const LinearisedPoint& start, const LinearisedPoint& at, double factor, const LaneMatrix& d,
                   LaneMatrix& rates) const;
  /// True if an effect of a cable has a kink between x and x_2, or within so many standard deviations beside them.
  /// at: the point at x. S: root of the covariance.
  bool has_kink_near(const Step& step, const Eigen::VectorXd& x, const LinearisedPoint& at, const Eigen::VectorXd& x_2,
                     double deviations, const LaneMatrix& S) const;
  /// Γ of the impulses G (arm_impulses.h): rows of [n_states]; Gamma: of the shape of G. A, start: as in
  /// second_stage().
  void impulse_response(const Step& step, const LinearisedPoint& start, const Eigen::MatrixXd& A,
                        const Eigen::VectorXd& x, const Eigen::VectorXd& x_2, const LaneMatrix& G,
                        LaneMatrix& Gamma) const;

  /// h(x) [n] and H = ∂h/∂x [n x n_states]; the row of a joint without motor is zero.
  Eigen::VectorXd motor_readings(double time_s, const Eigen::VectorXd& x, Eigen::MatrixXd* H = nullptr) const;
  /// z [n] becomes h(x).
  void read(double time_s, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const;
  /// z [n] becomes h(x), H [n x n_states] its slopes.
  void linearise_readings(double time_s, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                          Eigen::Ref<Eigen::MatrixXd> H) const;
  /// True if few derivatives say everything: all cables follow the paper's law, and the transmission is plain
  /// (plain_transmission.h). Then f has no kinks but those of effects of the cables.
  bool is_plain() const { return is_plain_; }
  /// True if it has effects between the commands and the joints.
  bool has_effects() const { return has_effects_; }
  /// Number of states before those at the end that surely are constant: x' = 0.
  int moving_states() const { return plain_ ? layout_.effect_states : layout_.size; }
  /// True if h is affine, that is, if no effect acts at the sensors.
  bool readings_are_linear() const { return readings_are_linear_; }

  /// Throws the std::runtime_error of a state that is not finite.
  [[noreturn]] void throw_not_finite(double time_s, int state) const;

  /// The state at rest with these motor angles and joint positions [n], internal states zero.
  Eigen::VectorXd state_at_rest(const Eigen::VectorXd& motor_angle, const Eigen::VectorXd& joint_position) const;

 private:
  void find_stiffest_rate(const ArmModel& model);
  LinearisedArm linearised_arm() const { return {dual_, lanes_, plain_ ? &*plain_ : nullptr, arm(), layout_}; }

  Transmission<double> transmission_;
  Transmission<Dual> dual_;
  Transmission<Lanes> lanes_;
  StateLayout layout_;
  std::optional<PlainTransmission> plain_;
  std::vector<std::string> state_names_;
  void differentiate_readings(double time_s, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                              Eigen::Ref<Eigen::MatrixXd> H) const;

  bool is_plain_ = false;
  bool has_effects_ = false;
  bool readings_are_linear_ = true;
  Eigen::VectorXd linear_z_;  // h(0), and H, if they are linear
  LaneMatrix linear_H_;
  double stiffest_rate_ = 0;
  int stiffest_state_ = 0;
};

}  // namespace halyard
