#pragma once
/// The dual unscented Kalman filter: one filter for the state given the weights, one for the weights given the state.
/// Weights are uncertain parameters of the arm.
///
///   x_k = f(x_k-1, w) + v,   z_k = h(x_k, w) + n                the state's filter, sr_ukf.h
///   w_k = w_k-1 + r_k,       z_k = h(f(x_k-1(w), w), w) + e_k     the weights' filter
///
///   x    state as StateLayout orders it                          [n_states]
///   w    weights, each with prior standard deviation 1           [p]
///   z    readings of motor and joint encoders                    [2n]; those available in a sample: [m]
///   r    cov r_k = (1/λ - 1) P_w, forgetting factor λ = exp(-dt / T), T = T_0 exp(t / τ): early samples, which may
///        follow a wrong start, are forgotten faster than later ones
///   e    cov e_k = S_k, the innovation covariance of the state's filter
///
/// x_k-1 depends on w: another w since the start would have led to another state. Within one step of 1 ms the influence
/// of a coupling is too small to measure; it shows only in this accumulated dependence Ψ = dx/dw. So each of the
/// weights' sigma points ω_±i = w ± α √p S_w,i, with α = 0.03, starts at a state of its own, and Ψ is propagated
/// through prediction and correction:
///
///   X_±i = f(x + Ψ (ω_±i - w), ω_±i),   y_±i = h(X_±i, ω_±i)
///   Ψ' = cross(X, ω) P_w⁻¹,   Y = cross(y, ω) P_w⁻¹                  [n_states x p], [m x p]
///   Ψ = Ψ' - K Y,   cov(z) = Y P_w Yᵀ + S_k
///
/// If a sample would move a weight by more than 0.02, the sample's noise is doubled until the step is at most 0.02.
/// Otherwise early samples after a wrong start could move w to a region where f behaves differently.
///
/// Without the derivative of K, this is a recursive prediction-error method. If the weights are held, the sums over a
/// record Σ Yᵀ S⁻¹ ν and Σ Yᵀ S⁻¹ Y are the gradient of the innovations' likelihood and its information. The points of
/// held weights are 0.001 prior deviations apart, so that Y is a derivative. If a coupling changes by this spacing
/// while its joint moves at 1 rad/s, the speed of the coupled joint changes by 0.04 mrad/s. That is a hundredth of the
/// speed v_s over which friction changes sign (smoothing, 5 mrad/s). At a spacing of 0.03 it was a quarter of v_s; near
/// standstill, Y for the RAVEN-II's coupling C01 was then up to 1.7 times too large.
///
/// Sources: Wan and Nelson, "Dual extended Kalman filter methods", and Wan and van der Merwe, "The unscented Kalman
/// filter", in Haykin (ed.), "Kalman filtering and neural networks", 2001 (recurrent derivatives: 5.3); Ljung, IEEE
/// Trans. Autom. Control 24 (1979); used as in Haghighipanah et al., IROS 2015, section III-B.

#include <memory>

#include "estimators/filters/sr_ukf.h"
#include "estimators/identification/arm_family.h"
#include "estimators/process/noise.h"

namespace halyard {

/// A parameter θ of the arm as a function of a weight u ~ N(0, 1): nominal + scale u, or nominal exp(scale u) if its
/// sign is known.
struct Weight {
  std::string key;  ///< as for ArmFamily
  double nominal = 0;
  double scale = 1;  ///< in the parameter's unit; relative if logarithmic
  bool logarithmic = false;

  double value(double u) const;
  double slope(double u) const;  ///< dθ/du
};

/// A row of a log with the joint sensors' readings.
struct EncoderSample : Sample {
  Eigen::VectorXd joint_position;  ///< [n] rad | m; NaN: not measured
};

/// The innovation of one sample, and the derivative of the predicted reading ẑ with respect to the weights.
struct DualStep {
  Eigen::VectorXd nu;      ///< z - ẑ                [m]; m = 0: nothing was measured, or the filter has just started
  Eigen::MatrixXd S_root;  ///< cov(ν) given w       [m x m]
  Eigen::MatrixXd Y;       ///< dẑ/dw                [m x p]
};

struct DualUkfOptions {
  bool learn = true;         ///< false: the weights stay as they are
  double disturbances = 1;   ///< factor of the process noise of torques and joint forces (noise.h)
  double memory = 2;         ///< T_0, s
  double memory_growth = 2;  ///< τ, s
  /// time after a start, s; during it the weights do not change and update() returns steps without ν
  double settle = 0.5;
  double max_step = 0.01;  ///< s
  double restart_gap = 1;  ///< s
};

class DualUkf {
 public:
  /// The noise comes from the model's options for sr_ukf. Throws std::invalid_argument for a weight with an unknown
  /// key, and InputError for invalid noise options.
  DualUkf(const ArmModel& model, std::vector<Weight> weights, const DualUkfOptions& options = {});

  /// Sets the belief of the weights: mean [p] and a root of the covariance [p x p].
  void set_weights(const Eigen::VectorXd& w, const Eigen::MatrixXd& S_w);
  /// Begins a new record: the next sample is its first.
  void start_record() { started_ = false, time_known_ = false; }
  /// Throws std::invalid_argument if time does not increase, std::runtime_error if the state cannot be kept finite.
  DualStep update(const EncoderSample& sample);

  const Eigen::VectorXd& w() const { return weights_filter_.x(); }
  LaneMatrix::ConstView S_w() const { return weights_filter_.S(); }

 private:
  Eigen::VectorXd numbers(const Eigen::VectorXd& w) const;
  void forget_past();
  void remember(const EncoderSample& sample);
  void start(double time_s);
  void choose_substeps(double time_s);
  /// Divides P_w by λ of this span.
  void widen_weights(double span_s);
  /// E [p x p]: distances of the weights' points from w.
  Eigen::MatrixXd spread() const;
  /// Lets the slow rates follow those of the belief over a span, s.
  void follow_rates(double span_s);
  /// Predicts the belief and the weights' points to a time; returns the points' states X [n_states x points].
  Eigen::MatrixXd predict(double time_s, const Eigen::MatrixXd& E);
  /// Derivative by w [rows x p] of a quantity with one column for each of the weights' points.
  Eigen::MatrixXd per_weight(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& E) const;
  /// Rows of z that were measured in the sample.
  std::vector<int> measured(const EncoderSample& sample) const;
  /// Corrects the state, Ψ and, if `learns`, the weights with the same innovation.
  DualStep correct(const EncoderSample& sample, const Eigen::MatrixXd& X, const Eigen::MatrixXd& E, bool learns);
  void learn(const Innovation& innovation, const Eigen::MatrixXd& Y);

  ArmModel model_;
  std::vector<Weight> weights_;
  DualUkfOptions options_;
  ProcessModel structure_;  // of the nominal model
  ArmNoise noise_;
  Eigen::VectorXd deviation_;  // noise of all encoders [2n]
  ArmFamily center_, points_;
  SquareRootUkf state_filter_, weights_filter_;
  Eigen::MatrixXd Psi_;
  CommandHistory history_;
  HeldTorques held_;
  Eigen::VectorXd torque_, external_, latest_;  // held
  LaggedRates lagged_;
  std::unique_ptr<ProcessModel> stepping_;  // at the current weights; gives the number of sub-steps
  double stepping_time_ = 0;
  Eigen::VectorXd stepping_w_;
  bool points_are_set_ = false;  // the points of held weights need setting once only
  bool started_ = false, time_known_ = false;
  double time_ = 0, start_time_ = 0, learnt_ = 0;
};

}  // namespace halyard
