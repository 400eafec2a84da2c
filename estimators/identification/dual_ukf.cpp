#include "estimators/identification/dual_ukf.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/output/number_text.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongestStep = 0.02;       // of a weight by one sample, in prior deviations: beyond, it is taken
constexpr double kCaution = 2;              // for less exact by this factor, until the step is short
constexpr double kAlpha = 0.03;             // of the weights' sigma points: f must be stable at all of them
constexpr double kHeldSpread = 1e-3;        // of a held weight, in prior deviations: see dual_ukf.h
constexpr double kSubstepTime = 1;          // s between looks at how stiff the arm has become,
constexpr double kSubstepChange = 0.2;      // or a change of a weight by so much
constexpr double kJointFloor = 1e-5;        // rad, as that of the motors
constexpr double kJointFloorLength = 1e-6;  // m

std::vector<std::string> keys_of(const std::vector<Weight>& weights) {
  std::vector<std::string> keys;
  for (const Weight& w : weights) keys.push_back(w.key);
  return keys;
}

/// Pairs of sigma points; or, around held weights, one a weight and the center.
int count_points(std::size_t weights, bool learn) { return static_cast<int>(learn ? 2 * weights : weights + 1); }

NoiseLevels noise_levels(const ArmModel& model, const ProcessModel& process, double disturbances) {
  const auto found = model.estimators.find("sr_ukf");
  const EstimatorOptions none;
  OptionReader reader("sr_ukf", found == model.estimators.end() ? none : found->second);
  NoiseLevels levels = read_noise(reader, model, process);
  levels.torque *= disturbances;
  levels.joint_force *= disturbances;
  return levels;
}

Eigen::VectorXd encoder_deviation(const ArmNoise& noise, const ArmParameters<double>& arm) {
  Eigen::VectorXd deviation(2 * arm.n);
  deviation.head(arm.n) = noise.encoder();
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const double floor = j.type == JointType::revolute ? kJointFloor : kJointFloorLength;
    deviation(arm.n + k) = std::max(reading_deviation(j.joint_encoder_resolution, j.joint_encoder_noise), floor);
  }
  return deviation;
}

/// The arm with the weights that are believed.
class ArmOfBelief final : public DiscreteProcess {
 public:
  ArmOfBelief(const ArmFamily& arm, const ProcessModel& structure, const Step& step, int substeps)
      : arm_(arm), structure_(structure), step_(step), substeps_(substeps) {}
  void advance(Eigen::MatrixXd& X) const override { arm_.advance(step_, substeps_, X); }
  void advance_with_jacobian(Eigen::VectorXd&, Eigen::MatrixXd&) const override {
    throw std::logic_error("dual UKF: its filters take no Jacobian");
  }
  std::string name_of(int state) const override {
    return structure_.state_name(state) + " at " + with_digits(step_.time_s + step_.dt_s, 12) + " s";
  }

 private:
  const ArmFamily& arm_;
  const ProcessModel& structure_;
  Step step_;
  int substeps_;
};

/// z = ẑ + H (x - x̂).
class Linearised final : public MeasurementModel {
 public:
  Linearised(Eigen::VectorXd x, Eigen::VectorXd z, Eigen::MatrixXd H)
      : x_(std::move(x)), z_(std::move(z)), H_(std::move(H)) {}
  bool is_affine() const override { return true; }
  void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    z = z_ + H_ * (x - x_);
  }
  void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                 Eigen::Ref<Eigen::MatrixXd> H) const override {
    H = H_;
    read(x, z);
  }

 private:
  Eigen::VectorXd x_, z_;
  Eigen::MatrixXd H_;
};

/// K = P Hᵀ S_y⁻ᵀ S_y⁻¹.
Eigen::MatrixXd gain(const Eigen::MatrixXd& PH, const Eigen::MatrixXd& S_root) {
  const auto S_y = S_root.triangularView<Eigen::Lower>();
  const auto S_y_transposed = S_root.transpose().triangularView<Eigen::Upper>();
  return S_y_transposed.solve(S_y.solve(PH.transpose())).transpose();
}

}  // namespace

double Weight::value(double u) const { return logarithmic ? nominal * std::exp(scale * u) : nominal + scale * u; }
double Weight::slope(double u) const { return logarithmic ? scale * value(u) : scale; }

DualUkf::DualUkf(const ArmModel& model, std::vector<Weight> weights, const DualUkfOptions& options)
    : model_(model),
      weights_(std::move(weights)),
      options_(options),
      structure_(model_),
      noise_(model_, structure_, noise_levels(model_, structure_, options_.disturbances)),
      deviation_(encoder_deviation(noise_, structure_.arm())),
      center_(model_, structure_, keys_of(weights_), 1),
      points_(model_, structure_, keys_of(weights_), count_points(weights_.size(), options.learn)),
      state_filter_({.curvature_limit = 0.03}),
      history_(model_.n(), kHistorySpan) {
  // The reading's slope by q' becomes -d / 2 for a delay d above 0, and 1.5 |d| for one below.
  for (int k = 0; k < model_.n(); ++k)
    if (const double delay = std::abs(structure_.arm().joint[k].sensor_delay); delay > 0) lagged_.slope[k] = 1 / delay;
  const auto p = static_cast<Eigen::Index>(weights_.size());
  set_weights(Eigen::VectorXd::Zero(p), Eigen::MatrixXd::Identity(p, p));
}

void DualUkf::set_weights(const Eigen::VectorXd& w, const Eigen::MatrixXd& S_w) {
  weights_filter_.reset(w, S_w);
  center_.set(numbers(w));
  stepping_.reset();
  points_are_set_ = false;
}

Eigen::VectorXd DualUkf::numbers(const Eigen::VectorXd& w) const {
  Eigen::VectorXd theta(w.size());
  for (Eigen::Index i = 0; i < w.size(); ++i) theta(i) = weights_[i].value(w(i));
  return theta;
}

void DualUkf::remember(const EncoderSample& sample) {
  const int n = model_.n();
  for (int k = 0; k < n; ++k) {
    held_.take(k, sample.time_s, sample.motor_torque(k));
    if (std::isfinite(sample.motor_torque(k))) torque_(k) = sample.motor_torque(k);
    if (sample.joint_torque.size() > 0 && std::isfinite(sample.joint_torque(k))) external_(k) = sample.joint_torque(k);
    if (std::isfinite(sample.motor_position(k))) latest_(k) = sample.motor_position(k);
    if (std::isfinite(sample.joint_position(k))) latest_(n + k) = sample.joint_position(k);
  }
  history_.push(sample.time_s, torque_.data());
  time_ = sample.time_s;
}

void DualUkf::start(double time_s) {
  const int n = model_.n();
  const StateLayout& l = structure_.layout();
  const ArmParameters<double>& arm = structure_.arm();
  for (int k = 0; k < n; ++k)
    if (arm.joint[k].drive != Drive::none && std::isnan(latest_(k))) return;
  const Eigen::VectorXd home = model_.home();
  Eigen::VectorXd angle = unstretched_motors(arm, home);
  for (int k = 0; k < n; ++k)
    if (arm.joint[k].drive != Drive::none) angle(k) = latest_(k);
  // What the sensors err by depends on the state slowly: one correction is enough.
  const Eigen::VectorXd guess = unstretched_joints(arm, angle, home);
  Eigen::MatrixXd H;
  const Eigen::VectorXd read = center_.readings(time_s, structure_.state_at_rest(angle, guess), H);
  for (int k = 0; k < n; ++k)
    if (arm.joint[k].drive != Drive::none) angle(k) += latest_(k) - read(k);
  Eigen::VectorXd x = structure_.state_at_rest(angle, unstretched_joints(arm, angle, home));
  for (int k = 0; k < n; ++k)
    if (!std::isnan(latest_(n + k))) x(l.position[k]) = guess(k) + latest_(n + k) - read(n + k);
  Eigen::MatrixXd S = noise_.initial_root(x, kInfinity);
  // A record may begin in motion.
  for (int k = 0; k < n; ++k) {
    const double rate = std::max(model_.joints[k].upper - model_.joints[k].lower, S(l.rate[k], l.rate[k]));
    S(l.rate[k], l.rate[k]) = rate;
    if (l.motor_rate[k])
      S(*l.motor_rate[k], *l.motor_rate[k]) = rate * std::abs(arm.joint[k].pulley_radius / arm.joint[k].motor_travel());
  }
  state_filter_.reset(x, S);
  for (double& slow : lagged_.slow) slow = 0;
  Psi_.setZero(structure_.n_states(), static_cast<Eigen::Index>(weights_.size()));
  started_ = true;
  start_time_ = time_s;
}

Eigen::MatrixXd DualUkf::spread() const {
  const auto p = static_cast<Eigen::Index>(weights_.size());
  if (!options_.learn) return kHeldSpread * Eigen::MatrixXd::Identity(p, p);
  return kAlpha * std::sqrt(static_cast<double>(p)) * S_w();
}

void DualUkf::choose_substeps(double time_s) {
  if (stepping_ && std::abs(time_s - stepping_time_) < kSubstepTime &&
      ((w() - stepping_w_).array().abs() < kSubstepChange).all())
    return;
  ArmModel believed = model_;
  const Eigen::VectorXd theta = numbers(w());
  for (Eigen::Index i = 0; i < theta.size(); ++i) find_number(believed.nominal, weights_[i].key).set(theta(i));
  stepping_ = std::make_unique<ProcessModel>(believed);
  stepping_time_ = time_s;
  stepping_w_ = w();
}

void DualUkf::learn(const Innovation& innovation, const Eigen::MatrixXd& Y) {
  const Eigen::VectorXd before = w();
  const Eigen::MatrixXd S_before = S_w();
  const Linearised readings(before, Eigen::VectorXd::Zero(innovation.nu.size()), Y);
  for (double caution = 1;; caution *= kCaution) {
    weights_filter_.update(readings, innovation.nu, caution * innovation.S_root, kInfinity);
    if ((w() - before).cwiseAbs().maxCoeff() <= kLongestStep) return;
    weights_filter_.reset(before, S_before);
  }
}

void DualUkf::forget_past() {
  const int n = model_.n();
  torque_ = external_ = Eigen::VectorXd::Zero(n);
  held_ = {};
  latest_ = Eigen::VectorXd::Constant(2 * n, std::numeric_limits<double>::quiet_NaN());
  history_ = CommandHistory(n, kHistorySpan);
}

void DualUkf::widen_weights(double span_s) {
  const double forgetting = std::exp(-span_s / (options_.memory * std::exp(learnt_ / options_.memory_growth)));
  weights_filter_.reset(w(), S_w() / std::sqrt(forgetting));
  learnt_ += span_s;
}

void DualUkf::follow_rates(double span_s) {
  for (int k = 0; k < model_.n(); ++k) {
    const double rate = state_filter_.x()(structure_.layout().rate[k]);
    lagged_.slow[k] = rate + (lagged_.slow[k] - rate) * std::exp(-span_s * lagged_.slope[k]);
  }
}

Eigen::MatrixXd DualUkf::predict(double time_s, const Eigen::MatrixXd& E) {
  const auto p = static_cast<Eigen::Index>(weights_.size());
  const Eigen::Index points = points_.members();
  Eigen::MatrixXd dw = Eigen::MatrixXd::Zero(p, points);
  dw.leftCols(p) = E;
  if (options_.learn) dw.rightCols(p) = -E;
  Eigen::MatrixXd X = (Psi_ * dw).colwise() + state_filter_.x(), theta(p, points);
  for (Eigen::Index i = 0; i < points; ++i) theta.col(i) = numbers(w() + dw.col(i));
  if (options_.learn || !points_are_set_) points_.set(theta);
  points_are_set_ = true;

  const double span = time_s - time_;
  const int pieces = steps_over(span, options_.max_step);
  Step step;
  step.dt_s = span / pieces;
  step.motor_torque = torque_.data();
  step.external_force = external_.data();
  step.history = &history_;
  step.held = &held_;
  const int substeps = stepping_->substeps(step.dt_s);
  for (int i = 0; i < pieces; ++i) {
    step.time_s = time_ + i * step.dt_s;
    points_.advance(step, substeps, X);
    state_filter_.predict(ArmOfBelief(center_, structure_, step, substeps),
                          noise_.process_root(step, state_filter_.x()));
  }
  follow_rates(span);
  return X;
}

Eigen::MatrixXd DualUkf::per_weight(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& E) const {
  const Eigen::Index p = E.rows();
  const Eigen::MatrixXd moved = options_.learn ? Eigen::MatrixXd(0.5 * (columns.leftCols(p) - columns.rightCols(p)))
                                               : Eigen::MatrixXd(columns.leftCols(p).colwise() - columns.col(p));
  return E.transpose().partialPivLu().solve(moved.transpose()).transpose();
}

std::vector<int> DualUkf::measured(const EncoderSample& sample) const {
  const int n = model_.n();
  std::vector<int> rows;
  for (int k = 0; k < n; ++k)
    if (structure_.arm().joint[k].drive != Drive::none && std::isfinite(sample.motor_position(k))) rows.push_back(k);
  for (int k = 0; k < n; ++k)
    if (std::isfinite(sample.joint_position(k))) rows.push_back(n + k);
  return rows;
}

DualStep DualUkf::correct(const EncoderSample& sample, const Eigen::MatrixXd& X, const Eigen::MatrixXd& E,
                          bool learns) {
  const std::vector<int> rows = measured(sample);
  if (rows.empty()) return {};
  Eigen::VectorXd z(2 * model_.n());
  z << sample.motor_position, sample.joint_position;
  Eigen::MatrixXd H;
  const Eigen::VectorXd x = state_filter_.x();
  const Eigen::VectorXd predicted = center_.readings(sample.time_s, x, H, lagged_);
  const Eigen::MatrixXd Y = per_weight(points_.readings(sample.time_s, X, lagged_), E)(rows, Eigen::all);
  H = H(rows, Eigen::all).eval();
  const Eigen::MatrixXd HS = H * state_filter_.S(), PH = state_filter_.S() * HS.transpose();
  const Innovation innovation = state_filter_.update(Linearised(x, predicted(rows), H), z(rows),
                                                     Eigen::VectorXd(deviation_(rows)).asDiagonal(), kInfinity);
  Psi_ -= gain(PH, innovation.S_root) * Y;
  if (learns) {
    learn(innovation, Y);
    center_.set(numbers(w()));
  }
  return {innovation.nu, innovation.S_root, Y};
}

DualStep DualUkf::update(const EncoderSample& sample) {
  if (!time_known_) forget_past();
  else if (!(sample.time_s > time_))
    throw std::invalid_argument("filter: time does not increase at " + with_digits(sample.time_s, 12) + " s");
  if (sample.time_s - time_ > options_.restart_gap) {
    started_ = false;
    latest_.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  if (!started_) {
    remember(sample);
    time_known_ = true;
    start(sample.time_s);
    return {};
  }

  const bool settled = sample.time_s - start_time_ > options_.settle;
  const bool learns = options_.learn && settled;
  if (learns) widen_weights(sample.time_s - time_);
  choose_substeps(time_);
  const Eigen::MatrixXd E = spread();
  const Eigen::MatrixXd X = predict(sample.time_s, E);
  Psi_ = per_weight(X, E);
  const DualStep step = correct(sample, X, E, learns);
  remember(sample);
  return settled ? step : DualStep{};
}

}  // namespace halyard
