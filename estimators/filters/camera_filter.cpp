#include "estimators/filters/camera_filter.h"

#include <cmath>
#include <limits>

#include "transmission/coupling.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-9;  // s, of times that are sums

/// x becomes x - b.
class UnknownOffset : public UnknownConstant<UnknownOffset> {
 public:
  std::string name() const override { return "cable_offset"; }
  std::string summary() const override { return "an offset of the cable's stretch that only a filter knows"; }
  EffectStage added_at() const override { return EffectStage::stretch; }
  double factor() const override { return -1; }

  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].stretch -= c.z[0];
  }
};

const UnknownOffset& unknown_offset() {
  static const UnknownOffset effect;
  return effect;
}

/// The joints stand where the offsets let them: those are settled. In a record that begins in motion an offset would
/// take up what the speed is wrong by, and may stretch a cable beyond all forces.
ArmFilterOptions with_offsets(ArmFilterOptions options, const ProcessModel& process, const Eigen::VectorXd& wander) {
  options.in_motion = true;
  options = with_wander(std::move(options), unknown_offset(), process, wander);
  for (const std::optional<int>& state : states_of(unknown_offset(), process))
    if (state) options.settled.push_back(*state - process.layout().effect_states);
  return options;
}

/// Where the marker will be `ahead_s` later, p(q + ahead_s q').
class MarkerPosition final : public MeasurementModel {
 public:
  MarkerPosition(const ProcessModel& model, double ahead_s) : model_(model), ahead_s_(ahead_s) {}
  bool is_affine() const override { return false; }
  void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    const StateLayout& l = model_.layout();
    double q[kMaxJoints];
    for (int k = 0; k < l.n_joints; ++k) q[k] = x(l.position[k]) + ahead_s_ * x(l.rate[k]);
    position_of(model_.arm(), chain_pose(model_.arm(), q), model_.arm().payload_point, z.data());
  }
  void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                 Eigen::Ref<Eigen::MatrixXd> H) const override {
    const ArmParameters<Dual>& arm = model_.dual_transmission().arm();
    const StateLayout& l = model_.layout();
    const std::vector<int> at(l.position, l.position + arm.n), rates(l.rate, l.rate + arm.n);
    Eigen::MatrixXd of_joints(3, arm.n);
    const auto position_at = [&](const Dual* q, Dual* out) {
      position_of(arm, chain_pose(arm, q), arm.payload_point, out);
    };
    const Eigen::VectorXd q = x(at) + ahead_s_ * x(rates);
    jacobian(position_at, q, z, of_joints);
    H.setZero();
    H(Eigen::all, at) = of_joints;
    H(Eigen::all, rates) = ahead_s_ * of_joints;
  }

 private:
  const ProcessModel& model_;
  double ahead_s_;
};

}  // namespace

CameraOptions read_camera_options(OptionReader& options, const ArmModel& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kShare = 0.01;  // of the cable's travel
  const ArmParameters<double> arm = arm_with_effects(model);
  Eigen::VectorXd offset(arm.n);
  for (int k = 0; k < arm.n; ++k)
    offset(k) = kShare * std::abs(arm.joint[k].pulley_radius) * (model.joints[k].upper - model.joints[k].lower);
  CameraOptions camera;
  camera.latency_s = options.number("camera_latency", camera.latency_s, 0, 10);
  camera.noise_m = options.number("camera_noise", camera.noise_m, 1e-9, kInfinity);
  camera.offset = read_unknown_levels(options, "offset", {offset, offset});
  return camera;
}

ArmModel with_unknown_offsets(const ArmModel& model, const CameraOptions& camera) {
  ArmModel augmented = model;
  for (int k = 0; k < model.n(); ++k)
    if (model.nominal.joint[k].drive == Drive::cable)
      augmented.effects.push_back({&unknown_offset(), k, {camera.offset.start(k)}});
  return augmented;
}

CameraFilter::CameraFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process,
                           ArmFilterOptions options, const CameraOptions& camera,
                           std::unique_ptr<GaussianFilter> filter)
    : process_(std::move(process)),
      camera_(camera),
      filter_(augmented, process_, with_offsets(std::move(options), *process_, camera.offset.wander),
              std::move(filter)) {
  filter_.record_into(predictions_);
}

void CameraFilter::reset(const Sample& first) {
  filter_.reset(first);
  predictions_.clear();
  remember(first, 0);
}

Innovation CameraFilter::update(const Sample& sample) {
  const std::size_t before = predictions_.size();
  const Innovation innovation = filter_.update(sample);
  remember(sample, predictions_.size() - before);
  if (sample.marker.size() == 3 && sample.marker.allFinite()) take_marker(sample);
  return innovation;
}

void CameraFilter::remember(const Sample& sample, std::size_t predictions) {
  if (predictions == 0) {  // a start: what was before has no part in it
    past_.clear();
    predictions_.clear();
  }
  Past& past = past_.append();
  past.sample = sample;
  past.predictions = predictions;
  filter_.save(past.after);
  while (past_.size() > 1 && past_[1].sample.time_s <= sample.time_s - camera_.latency_s + kRounding) {
    predictions_.remove_front(past_[1].predictions);
    past_.remove_front();
  }
}

void CameraFilter::take_marker(const Sample& sample) {
  const double ahead = sample.time_s - camera_.latency_s - past_.front().sample.time_s;
  // Of a time that the filter does not remember, or when it had not yet started.
  if (ahead < -kRounding || !past_.front().after.track.started) return;
  filter_.restore(past_.front().after);
  filter_.correct_with(MarkerPosition(*process_, std::max(ahead, 0.0)), sample.marker,
                       camera_.noise_m * Eigen::Matrix3d::Identity());
  filter_.save(past_.front().after);
  std::size_t next = 0;
  for (std::size_t i = 1; i < past_.size(); ++i) {
    filter_.repeat(past_[i].sample, predictions_, next, past_[i].predictions);
    filter_.save(past_[i].after);
    next += past_[i].predictions;
  }
}

Estimate CameraFilter::estimate() const {
  Estimate e = filter_.estimate();
  const std::vector<std::optional<int>> states = states_of(unknown_offset(), *process_);
  e.extra_outputs.setConstant(process_->n_joints(), 2, kNan);
  for (int k = 0; k < process_->n_joints(); ++k) {
    if (!states[k]) continue;
    e.extra_outputs(k, 0) = filter_.filter().x()(*states[k]);
    e.extra_outputs(k, 1) = filter_.filter().S().row(*states[k]).norm();
  }
  return e;
}

}  // namespace halyard
