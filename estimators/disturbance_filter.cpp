#include "estimators/disturbance_filter.h"

#include <algorithm>
#include <limits>

#include "estimators/standstill.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// F' = F + d, d' = 0. Its parameter is σ_d.
class UnknownForce : public EffectOf<UnknownForce> {
 public:
  std::string name() const override { return "joint_force"; }
  std::string summary() const override { return "a force on the joint that only a filter knows"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, int) const override { return {}; }
  int n_states() const override { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>&, int, const double* p) const override { return {p[0]}; }

  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[c.joint].joint_force += c.z[0];
  }
  template <class T>
  void state_rate(const EffectContext<T>&, const JointSignals<T>*, T* z_dot) const {
    z_dot[0] = T(0.0);
  }
};

const UnknownForce& unknown_force() {
  static const UnknownForce effect;
  return effect;
}

/// Index of d in the state, [n]; -1: the joint has none.
std::vector<int> force_states(const ProcessModel& process) {
  std::vector<int> states(process.n_joints(), -1);
  int next = process.layout().effect_states;
  for (const auto& e : process.transmission().effects()) {
    if (e.effect == &unknown_force()) states[e.joint] = next;
    next += e.effect->n_states();
  }
  return states;
}

}  // namespace

UnknownForceLevels read_force_levels(OptionReader& options, const ArmModel& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ArmParameters<double> arm = Transmission<double>(model.nominal, model.effects).arm();
  const Eigen::VectorXd gravity = largest_gravity_force(arm, model);
  UnknownForceLevels levels{Eigen::VectorXd(arm.n), Eigen::VectorXd(arm.n)};
  for (int k = 0; k < arm.n; ++k) {
    const double friction = arm.joint[k].joint_coulomb;
    levels.start(k) = std::max(gravity(k), friction);
    levels.wander(k) = std::max(2 * friction, gravity(k) / 4);
  }
  levels.start = options.per_joint("force_start", levels.start, 0, kInfinity);
  levels.wander = options.per_joint("force_wander", levels.wander, 0, kInfinity);
  return levels;
}

ArmModel with_unknown_forces(const ArmModel& model, const UnknownForceLevels& levels) {
  ArmModel augmented = model;
  for (int k = 0; k < model.n(); ++k)
    if (model.nominal.joint[k].drive != Drive::none)
      augmented.effects.push_back({&unknown_force(), k, {levels.start(k)}});
  return augmented;
}

ArmFilterOptions with_force_wander(ArmFilterOptions options, const ProcessModel& process,
                                   const UnknownForceLevels& levels) {
  const std::vector<int> states = force_states(process);
  for (int k = 0; k < process.n_joints(); ++k)
    if (states[k] >= 0) options.noise.wander(states[k] - process.layout().effect_states) = levels.wander(k);
  return options;
}

DisturbanceFilter::DisturbanceFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process,
                                     ArmFilterOptions options, const UnknownForceLevels& levels,
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
  e.further.setConstant(n, 3, kNan);
  const std::vector<int> states = force_states(*process_);
  for (int k = 0; k < n; ++k) {
    if (states[k] >= 0) {
      e.further(k, 0) = x(states[k]);
      e.further(k, 1) = filter_.filter().S().row(states[k]).norm();
    }
    if (process_->arm().joint[k].drive == Drive::cable) e.further(k, 2) = s[k].cable_force_joint;
  }
  return e;
}

}  // namespace halyard
