#pragma once
/// The dual unscented Kalman filter: one filter for the state given the weights, one for the weights given the state.
/// Weights are numbers of the arm that are not known well.
///
///   x_k = f(x_k-1, w) + v,   z_k = h(x_k, w) + n                the state's filter, sr_ukf.h
///   w_k = w_k-1 + r_k,       z_k = h(f(x_k-1(w), w), w) + e_k     the weights' filter
///
///   x    state as StateLayout orders it                          [n_states]
///   w    weights, each of prior deviation 1                      [p]
///   z    readings of motor and joint encoders                    [2n], those of a sample that are there: [m]
///   r    cov r_k = (1/λ - 1) P_w: weights forget with λ = exp(-dt / T), T = T_0 exp(t / τ), so that what was learnt
///        from a bad start fades and what is learnt later stays
///   e    cov e_k = S_k, what the state's filter says of its innovation
///
/// x_k-1 depends on w: a filter that has believed in w ever since has another state. Over 1 ms a coupling moves nothing
/// that could be measured; it is the state carried along that tells of it. So the weights' sigma points
/// ω_±i = w ± α √p S_w,i start each at a state of its own, and Ψ = dx/dw goes on by what the state's filter corrects:
///
///   X_±i = f(x + Ψ (ω_±i - w), ω_±i),   y_±i = h(X_±i, ω_±i)
///   Ψ' = cross(X, ω) P_w⁻¹,   Y = cross(y, ω) P_w⁻¹                  [n_states x p], [m x p]
///   Ψ = Ψ' - K Y,   cov(z) = Y P_w Yᵀ + S_k
///
/// A sample that would move a weight by more than 0.02 at once is taken for less exact until it does not: early ones,
/// from a wrong start, are not to be trusted to where f is another function. α = 0.03.
///
/// With the derivative of K left out, that is a recursive prediction-error method; held weights give, summed over a
/// record, the gradient Σ Yᵀ S⁻¹ ν of the innovations' likelihood and its information Σ Yᵀ S⁻¹ Y. Their points are
/// 0.001 prior deviations apart, so that Y is a derivative: a joint at 1 rad/s then moves the one coupled to it by
/// 0.04 mrad/s, a hundredth of the speed at which friction turns round (smoothing, 5 mrad/s). At 0.03 it was a quarter,
/// and Y of the RAVEN-II's C01 came out up to 1.7 times too large wherever its joint dwelt.
///
/// Sources: Wan and Nelson, "Dual extended Kalman filter methods", and Wan and van der Merwe, "The unscented Kalman
/// filter", in Haykin (ed.), "Kalman filtering and neural networks", 2001 (recurrent derivatives: 5.3); Ljung, IEEE
/// Trans. Autom. Control 24 (1979); used as in Haghighipanah et al., IROS 2015, section III-B.

#include <memory>

#include "estimators/filters/sr_ukf.h"
#include "estimators/identification/arm_family.h"
#include "estimators/process/noise.h"

namespace halyard {

/// A number θ of the arm by a weight u ~ N(0, 1): nominal + scale u, or nominal exp(scale u) if its sign is known.
struct Weight {
  std::string key;  ///< as ArmFamily takes it
  double nominal = 0;
  double scale = 1;  ///< of the number's unit; relative if logarithmic
  bool logarithmic = false;

  double value(double u) const;
  double slope(double u) const;  ///< dθ/du
};

/// A row of a log with the joints' sensors.
struct EncoderSample : Sample {
  Eigen::VectorXd joint_position;  ///< [n] rad | m; NaN: not measured
};

/// What one sample said.
struct DualStep {
  Eigen::VectorXd nu;      ///< z - ẑ                [m]; m = 0: nothing was measured, or the filter has just started
  Eigen::MatrixXd S_root;  ///< cov(ν) given w       [m x m]
  Eigen::MatrixXd Y;       ///< dẑ/dw                [m x p]
};

struct DualUkfOptions {
  bool learn = true;         ///< false: the weights are held
  double memory = 2;         ///< T_0, s
  double memory_growth = 2;  ///< τ, s
  double settle = 0.5;       ///< s after a start from which nothing is learnt, and steps are returned without ν
  double max_step = 0.01;    ///< s
  double restart_gap = 1;    ///< s
};

class DualUkf {
 public:
  /// Noise as the model's options of sr_ukf say. Throws std::invalid_argument for a weight of an unknown key, and
  /// InputError for noise options that cannot be meant.
  DualUkf(const ArmModel& model, std::vector<Weight> weights, const DualUkfOptions& options = {});

  /// A belief of the weights: mean, and a root of their covariance.
  void set_weights(const Eigen::VectorXd& w, const Eigen::MatrixXd& S_w);
  /// A new record: the next sample is its first.
  void start_record() { started_ = false, time_known_ = false; }
  /// Throws std::invalid_argument if time does not increase, std::runtime_error if the state cannot be kept finite.
  DualStep update(const EncoderSample& sample);

  const Eigen::VectorXd& w() const { return weights_filter_.x(); }
  const Eigen::MatrixXd& S_w() const { return weights_filter_.S(); }

 private:
  Eigen::VectorXd numbers(const Eigen::VectorXd& w) const;
  void forget_past();
  void remember(const EncoderSample& sample);
  void start(double time_s);
  void choose_substeps(double time_s);
  /// P_w / λ of this span.
  void widen_weights(double span_s);
  /// E [p x p]: how far the weights' points lie from w.
  Eigen::MatrixXd spread() const;
  /// Moves belief and weights' points to a time; X [n_states x points] of the latter.
  Eigen::MatrixXd predict(double time_s, const Eigen::MatrixXd& E);
  /// Derivative by w of what stands in a column for each of the weights' points, [rows x p].
  Eigen::MatrixXd per_weight(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& E) const;
  /// Rows of z that the sample has.
  std::vector<int> measured(const EncoderSample& sample) const;
  /// Corrects the state, Ψ, and the weights, if they learn, by the same innovation.
  DualStep correct(const EncoderSample& sample, const Eigen::MatrixXd& X, const Eigen::MatrixXd& E, bool learns);
  void learn(const Innovation& innovation, const Eigen::MatrixXd& Y);

  ArmModel model_;
  std::vector<Weight> weights_;
  DualUkfOptions options_;
  ProcessModel structure_;  // of the nominal model
  ArmNoise noise_;
  Eigen::VectorXd deviation_;  // of all encoders [2n]
  ArmFamily center_, points_;
  SquareRootUkf state_filter_, weights_filter_;
  Eigen::MatrixXd Psi_;
  CommandHistory history_;
  Eigen::VectorXd torque_, external_, latest_;  // held
  std::unique_ptr<ProcessModel> stepping_;      // of the weights, to choose sub-steps by
  double stepping_time_ = 0;
  Eigen::VectorXd stepping_w_;
  bool points_are_set_ = false;  // held weights' points stay
  bool started_ = false, time_known_ = false;
  double time_ = 0, start_time_ = 0, learnt_ = 0;
};

}  // namespace halyard
