#include "estimators/filters/disturbance_filter.h"

#include <algorithm>
#include <limits>

#include "estimators/process/standstill.h"

namespace halyard {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// F' = F + d.
class UnknownForce : public UnknownConstant<UnknownForce> {
 public:
  std::string name() const override { return "joint_force"; }
  std::string summary() const override { return "a force on the joint that only a filter knows"; }
  EffectStage added_at() const override { return EffectStage::joint; }
  double factor() const override { return 1; }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].joint_force += c.z[0];
  }
};

const UnknownForce& unknown_force() {
  static const UnknownForce effect;
  return effect;
}

}  // namespace

UnknownLevels read_force_levels(OptionReader& options, const ArmModel& model) {
  const ArmParameters<double> arm = arm_with_effects(model);
  const Eigen::VectorXd gravity = largest_gravity_force(arm, model);
  UnknownLevels usual{Eigen::VectorXd(arm.n), Eigen::VectorXd(arm.n)};
  for (int k = 0; k < arm.n; ++k) {
    const double friction = arm.joint[k].joint_coulomb;
    usual.start(k) = std::max(gravity(k), friction);
    usual.wander(k) = std::max(2 * friction, gravity(k) / 4);
  }
  return read_unknown_levels(options, "force", usual);
}

ArmModel with_unknown_forces(const ArmModel& model, const UnknownLevels& levels) {
  ArmModel augmented = model;
  for (int k = 0; k < model.n(); ++k)
    if (model.nominal.joint[k].drive != Drive::none)
      augmented.effects.push_back({&unknown_force(), k, {levels.start(k)}});
  return augmented;
}

ArmFilterOptions with_force_wander(ArmFilterOptions options, const ProcessModel& process, const UnknownLevels& levels) {
  return with_wander(std::move(options), unknown_force(), process, levels.wander);
}

DisturbanceFilter::DisturbanceFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process,
                                     ArmFilterOptions options, const UnknownLevels& levels,
                                     std::unique_ptr<GaussianFilter> filter)
    : process_(std::move(process)),
      filter_(augmented, process_, with_force_wander(std::move(options), *process_, levels), std::move(filter)) {}

void DisturbanceFilter::reset(const Sample& first) {
  filter_.reset(first);
  time_ = first.time_s;
}

Innovation DisturbanceFilter::update(const Sample& sample) {
  const Innovation innovation = filter_.update(sample);
  time_ = sample.time_s;
  return innovation;
}

Estimate DisturbanceFilter::estimate() const {
  const int n = process_->n_joints();
  const Eigen::VectorXd& x = filter_.filter().x();
  const StateLayout& l = process_->layout();
  JointSignals<double> s[kMaxJoints];
  double z_dot[kMaxStates];
  unpack_state(process_->arm(), l, x.data(), s);
  process_->transmission().evaluate(time_, nullptr, x.data() + l.effect_states, s, z_dot);

  Estimate e = filter_.estimate();
  e.extra_outputs.setConstant(n, 3, kUnknown);
  const std::vector<std::optional<int>> states = states_of(unknown_force(), *process_);
  for (int k = 0; k < n; ++k) {
    if (states[k]) {
      e.extra_outputs(k, 0) = x(*states[k]);
      e.extra_outputs(k, 1) = filter_.filter().S().row(*states[k]).norm();
    }
    if (process_->arm().joint[k].drive == Drive::cable) e.extra_outputs(k, 2) = s[k].cable_force_joint;
  }
  return e;
}

}  // namespace halyard
