#include "estimators/filters/arm_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "estimators/process/arm_models.h"
#include "estimators/process/static_equilibrium.h"
#include "model/output/number_text.h"
#include "model/statistics/distributions.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUsualSpeed = 1;    // ranges per second
constexpr double kUnknownRange = 1;  // rad | m
constexpr double kUsualRate = 1e3;   // Hz; at this rate and below, the history never asks for more memory
constexpr int kMostHalvings = 5;     // of a step that the exponential step's guard refuses

}  // namespace

ArmFilterOptions read_arm_filter_options(OptionReader& options, const ArmModel& model, const ProcessModel& process) {
  ArmFilterOptions o;
  o.noise = read_noise(options, model, process);
  o.max_step = options.number("max_step", o.max_step, 1e-6, kInfinity);
  o.restart_gap = options.number("restart_gap", o.restart_gap, 1e-3, kInfinity);
  o.gate = options.number("gate", o.gate, 0.5, 1);
  return o;
}

void set_joint_estimate(const StateLayout& l, const Eigen::VectorXd& x, const Eigen::Ref<const Eigen::MatrixXd>& S,
                        Estimate& e) {
  e.joint_position.resize(l.n_joints);
  e.joint_velocity.resize(l.n_joints);
  e.joint_position_std.resize(l.n_joints);
  for (int k = 0; k < l.n_joints; ++k) {
    e.joint_position(k) = x(l.position[k]);
    e.joint_velocity(k) = x(l.rate[k]);
    e.joint_position_std(k) = S.row(l.position[k]).norm();
  }
}

ArmFilter::ArmFilter(const ArmModel& model, std::shared_ptr<const ProcessModel> process,
                     const ArmFilterOptions& options, std::unique_ptr<GaussianFilter> filter)
    : model_(model),
      process_(std::move(process)),
      options_(options),
      noise_(model_, *process_, options.noise),
      exponential_(*process_),
      filter_(std::move(filter)),
      history_(model.n(), kHistorySpan),
      last_command_(-kInfinity) {
  history_.reserve(static_cast<std::size_t>(2.1 * kHistorySpan * kUsualRate));
  for (int k = 0; k < model.n(); ++k)
    if (process_->arm().joint[k].drive != Drive::none) motors_.push_back(k);
}

void ArmFilter::reset(const Sample& first) {
  const int n = process_->n_joints();
  track_ = {};
  track_.time_s = first.time_s;
  track_.readings = {motors_, n};
  track_.judged_at = Eigen::VectorXd::Constant(n, first.time_s);
  track_.torque = track_.external = Eigen::VectorXd::Zero(n);
  track_.refused_since = kInfinity;
  history_.clear();
  last_command_ = -kInfinity;
  repaired_before_ = filter_->repaired();
  noise_.reset(Eigen::VectorXd::Ones(n));
  const Eigen::VectorXd home = model_.home();
  const Eigen::VectorXd x = process_->state_at_rest(unstretched_motors(process_->arm(), home), home);
  Eigen::MatrixXd S = noise_.initial_root(x, kInfinity);
  widen(1, 0, S);  // until all motors have been read
  filter_->reset(x, S);
  start(first);
}

void ArmFilter::remember(const Sample& sample) {
  for (int k = 0; k < process_->n_joints(); ++k) {
    track_.held.take(k, sample.time_s, sample.motor_torque(k));
    if (std::isfinite(sample.motor_torque(k))) track_.torque(k) = sample.motor_torque(k);
    if (sample.joint_torque.size() > 0 && std::isfinite(sample.joint_torque(k)))
      track_.external(k) = sample.joint_torque(k);
  }
  if (sample.time_s > last_command_) {
    history_.push(sample.time_s, track_.torque.data());
    last_command_ = sample.time_s;
  }
  track_.time_s = sample.time_s;
}

Eigen::VectorXd ArmFilter::undriven_positions() const {
  Eigen::VectorXd q = model_.home();
  for (int k = 0; k < q.size(); ++k)
    if (track_.begun && process_->arm().joint[k].drive == Drive::none)
      q(k) = filter_->x()(process_->layout().position[k]);
  return q;
}

void ArmFilter::start(const Sample& sample) {
  track_.readings.take(sample);
  remember(sample);
  if (!track_.readings.are_complete()) return;
  // At the start of a record the arm rests, so that a reading does not age.
  const double age = track_.begun ? track_.readings.age(sample.time_s) : 0;
  if (age > options_.restart_gap) return;
  const Eigen::VectorXd q_undriven = undriven_positions();
  Eigen::VectorXd angle = track_.readings.angles();
  // The readings' error may depend on the angle, slowly: one correction is enough.
  Eigen::VectorXd x = process_->state_at_rest(angle, unstretched_joints(process_->arm(), angle, q_undriven));
  angle(motors_) -= (process_->motor_readings(sample.time_s, x) - angle)(motors_);
  const Eigen::VectorXd z = Eigen::VectorXd::Zero(process_->layout().n_effect_states);
  const Eigen::VectorXd q = static_equilibrium(*process_, sample.time_s, angle, track_.external, z,
                                               unstretched_joints(process_->arm(), angle, q_undriven));
  x = process_->state_at_rest(angle, q);
  // After a gap the arm need not rest. A speed that no joint has says that one of the two readings is wrong.
  const auto rates =
      track_.speed_is_due ? track_.readings.rates(process_->arm(), model_, angle) : std::optional<MeanRates>();
  if (rates) set_rates(*rates, x);
  track_.speed_is_due = track_.begun && !rates && !motors_.empty();
  Eigen::MatrixXd S = start_root(x, angle, q, rates ? rates->shortest_s : kInfinity);
  if (track_.begun ? !rates || rates->longest_s > options_.max_step : options_.in_motion)
    widen(kUsualSpeed, process_->layout().positions, S);
  else if (track_.begun) widen_undriven(kUsualSpeed, process_->layout().positions, S);
  if (age > 0) widen(kUsualSpeed * age, 0, S);
  filter_->reset(x, S);
  exponential_.forget();
  track_.begun = track_.started = true;
  track_.start_time = sample.time_s;
  track_.readings.start();
  track_.judged_at.setConstant(sample.time_s);
  track_.refused_since = kInfinity;
}

void ArmFilter::set_rates(const MeanRates& rates, Eigen::VectorXd& x) const {
  const StateLayout& l = process_->layout();
  for (int k = 0; k < l.n_joints; ++k) {
    x(l.rate[k]) = rates.joint(k);
    if (const auto motor_rate = l.motor_rate[k]) x(*motor_rate) = rates.motor(k);
  }
}

void ArmFilter::widen(double share, int first, Eigen::MatrixXd& S) const {
  const StateLayout& l = process_->layout();
  for (int k = 0; k < l.n_joints; ++k) {
    if (process_->arm().joint[k].drive == Drive::none) continue;
    const double range = model_.joints[k].upper - model_.joints[k].lower;
    const int column = first + l.motor_angle[k].value_or(l.position[k]);
    double& joint = S(first + l.position[k], column);
    joint = std::max(joint, share * (range > 0 ? range : kUnknownRange));
    for (int i = 0; i < l.n_joints; ++i) {
      const JointParameters<double>& j = process_->arm().joint[i];
      if (l.motor_angle[i]) S(first + *l.motor_angle[i], column) = joint * path_per_joint(j, k) / j.motor_travel();
    }
  }
  widen_undriven(share, first, S);
}

void ArmFilter::widen_undriven(double share, int first, Eigen::MatrixXd& S) const {
  const StateLayout& l = process_->layout();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(l.n_joints);
  for (int k = 0; k < l.n_joints; ++k) {
    if (process_->arm().joint[k].drive != Drive::none) continue;
    const double range = model_.joints[k].upper - model_.joints[k].lower;
    auto column = S.col(first + l.position[k]);
    const double joint = std::max(column(first + l.position[k]), share * (range > 0 ? range : kUnknownRange));
    const Eigen::VectorXd path = unstretched_joints(process_->arm(), none, Eigen::VectorXd::Unit(l.n_joints, k));
    for (int i = 0; i < l.n_joints; ++i) column(first + l.position[i]) = joint * path(i);
  }
}

Eigen::MatrixXd ArmFilter::start_root(const Eigen::VectorXd& x, const Eigen::VectorXd& angle, const Eigen::VectorXd& q,
                                      double dt_s) const {
  const StateLayout& l = process_->layout();
  Eigen::MatrixXd S = noise_.initial_root(x, dt_s);
  for (const int i : options_.settled) {
    const int state = l.effect_states + i;
    const Eigen::VectorXd z = S(state, state) * Eigen::VectorXd::Unit(l.n_effect_states, i);
    const Eigen::VectorXd moved = static_equilibrium(*process_, track_.time_s, angle, track_.external, z, q) - q;
    for (int k = 0; k < l.n_joints; ++k) S(l.position[k], state) = moved(k);
  }
  return S;
}

void ArmFilter::predict(double to_time_s) {
  const double span = to_time_s - track_.time_s;
  const int pieces = steps_over(span, options_.max_step);
  Step step;
  step.dt_s = span / pieces;
  step.motor_torque = track_.torque.data();
  step.external_force = track_.external.data();
  step.history = &history_;
  step.held = &track_.held;
  // Parts of a refused step are no shorter than sub-steps, or half of one.
  const double parts = std::ceil(std::log2(process_->substeps_needed(step.dt_s)));
  const int halvings = static_cast<int>(std::min<double>(parts, kMostHalvings));
  for (int i = 0; i < pieces; ++i) {
    step.time_s = track_.time_s + i * step.dt_s;
    predict_over(step, halvings);
  }
}

void ArmFilter::predict_over(Step step, int halvings) {
  if (options_.exponential) exponential_.linearise(step, filter_->x());
  const bool accepted =
      options_.exponential && exponential_.start(filter_->root(), noise_.impulses(step, exponential_.mobility()));
  if (options_.exponential && !accepted && exponential_.is_finite() && halvings > 0) {
    step.dt_s /= 2;
    predict_over(step, halvings - 1);
    step.time_s += step.dt_s;
    return predict_over(step, halvings - 1);
  }
  ExponentialStep* const exponential = accepted ? &exponential_ : nullptr;
  const ArmProcess process(*process_, step, exponential);
  const Eigen::MatrixXd& Q_root = noise_.process_root(step, filter_->x(), exponential);
  if (predictions_) x_0_ = filter_->x();
  filter_->predict(process, Q_root);
  if (predictions_) filter_->record(process, x_0_, predictions_->append());
}

double ArmFilter::gate_threshold(int m) const {
  return options_.gate < 1 ? chi_square_quantile(m, options_.gate) : kInfinity;
}

Innovation ArmFilter::correct(const Sample& sample) {
  read_.clear();
  for (const int k : motors_)
    if (std::isfinite(sample.motor_position(k))) read_.push_back(k);
  if (read_.empty()) {
    track_.refused_since += sample.time_s - track_.time_s;
    return {};
  }
  const auto m = static_cast<Eigen::Index>(read_.size());
  ReadingVector z(m);
  ReadingMatrix R_root = ReadingMatrix::Zero(m, m);
  ReadingVector since(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const int k = read_[static_cast<std::size_t>(i)];
    z(i) = sample.motor_position(k);
    since(i) = sample.time_s - track_.judged_at(k);
    track_.judged_at(k) = sample.time_s;
    R_root(i, i) = noise_.encoder()(k);
  }
  Innovation innovation =
      filter_->update(MotorReadings(*process_, sample.time_s, read_), z, R_root, gate_threshold(static_cast<int>(m)));
  noise_.adapt(read_, innovation, since);
  track_.refused_since = innovation.accepted ? kInfinity : std::min(track_.refused_since, sample.time_s);
  return innovation;
}

Innovation ArmFilter::update(const Sample& sample) {
  if (!(sample.time_s > track_.time_s))
    throw std::invalid_argument("filter: time does not increase at " + with_digits(sample.time_s, 12) + " s");
  const bool loses_track = sample.time_s - track_.time_s > options_.restart_gap || is_locked_out(sample);
  if (loses_track) lose_track();
  Innovation innovation;
  if (!track_.started || (track_.speed_is_due && track_.readings.are_new(sample))) {
    start(sample);
  } else {
    predict(sample.time_s);
    innovation = take(sample);
  }
  innovation.time_s = sample.time_s;
  ++track_.report.steps;
  return innovation;
}

bool ArmFilter::is_locked_out(const Sample& sample) const {
  return sample.time_s - track_.refused_since > options_.restart_gap &&
         std::ranges::any_of(motors_, [&](int k) { return std::isfinite(sample.motor_position(k)); });
}

void ArmFilter::lose_track() {
  track_.started = track_.speed_is_due = false;
  track_.readings.forget();
  track_.refused_since = kInfinity;
  if (!track_.begun) return;
  const StateLayout& l = process_->layout();
  Eigen::VectorXd x = filter_->x();
  x.segment(l.positions, l.positions).setZero();
  Eigen::MatrixXd S = noise_.initial_root(x, kInfinity);
  widen(1, 0, S);
  filter_->reset(x, S);
}

Innovation ArmFilter::take(const Sample& sample) {
  track_.speed_is_due = track_.speed_is_due && sample.time_s - track_.start_time <= options_.max_step;
  Innovation innovation;
  if (track_.speed_is_due) track_.readings.take(sample);
  else innovation = correct(sample);
  if (!innovation.accepted) ++track_.report.gated;
  remember(sample);
  return innovation;
}

void ArmFilter::repeat(const Sample& sample, const Predictions& predictions, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) filter_->predict_again(predictions[i]);
  take(sample);
  ++track_.report.steps;
}

void ArmFilter::save(Snapshot& snapshot) const {
  snapshot.track = track_;
  snapshot.x = filter_->x();
  snapshot.adapted = noise_.adapted();
  snapshot.S = filter_->S();
  exponential_.save(snapshot.kept);
}

void ArmFilter::restore(const Snapshot& snapshot) {
  track_ = snapshot.track;
  noise_.reset(snapshot.adapted);
  exponential_.restore(snapshot.kept);
  filter_->reset(snapshot.x, snapshot.S);
}

Innovation ArmFilter::correct_with(const MeasurementModel& measurement, const ReadingVector& z,
                                   const ReadingMatrix& R_root) {
  Innovation innovation = filter_->update(measurement, z, R_root, gate_threshold(static_cast<int>(z.size())));
  innovation.time_s = track_.time_s;
  if (!innovation.accepted) ++track_.report.gated;
  return innovation;
}

Estimate ArmFilter::estimate() const {
  Estimate e;
  set_joint_estimate(process_->layout(), filter_->x(), filter_->S(), e);
  return e;
}

EstimatorReport ArmFilter::report() const {
  EstimatorReport r = track_.report;
  r.repaired_factors += filter_->repaired() - repaired_before_;
  return r;
}

}  // namespace halyard
