#include "diagnosis/prediction/filtered_effect.h"

#include "diagnosis/search_space.h"

namespace halyard {
namespace {

/// What the filter leaves of something periodic.
struct Attenuation {
  std::size_t order = 0;  ///< index of the parameter that gives the number of periods
  double sigma_s = 0;     ///< 0: nothing is filtered

  template <class T>
  T of(const T* p, const T& rate) const {
    const T turned = p[order] * rate * sigma_s;
    return exp(T(-0.5 * turned * turned));
  }
};

class FilteredEffect : public EffectOf<FilteredEffect> {
 public:
  FilteredEffect(const Effect& effect, Attenuation torque, Attenuation reading)
      : effect_(effect), torque_(torque), reading_(reading) {}

  std::string name() const override { return effect_.name(); }
  std::string summary() const override { return effect_.summary(); }
  EffectScope scope() const override { return effect_.scope(); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return effect_.applies(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    return effect_.parameters(arm, joint);
  }
  int n_states() const override { return effect_.n_states(); }
  std::vector<double> state_scale(const ArmParameters<double>& arm, EffectPlace joint, const double* p) const override {
    return effect_.state_scale(arm, joint, p);
  }
  unsigned stages() const override { return effect_.stages(); }
  int rank(EffectStage stage) const override { return effect_.rank(stage); }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace joint, const T* p) const {
    effect_.change_parameters(arm, joint, p);
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::command, c, s);
  }
  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::stretch, c, s);
  }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::cable_force, c, s);
  }
  template <class T>
  void on_motor(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (torque_.sigma_s == 0) return effect_.act(EffectStage::motor, c, s);
    JointSignals<T>& own = s[*c.joint];
    const T others = own.motor_torque;
    own.motor_torque = T(0.0);
    effect_.act(EffectStage::motor, c, s);
    own.motor_torque *= torque_.of(c.p, own.motor_rate);
    own.motor_torque += others;
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::joint, c, s);
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (reading_.sigma_s == 0) return effect_.act(EffectStage::sensors, c, s);
    JointSignals<T>& own = s[*c.joint];
    const T others = own.joint_error;
    own.joint_error = T(0.0);
    effect_.act(EffectStage::sensors, c, s);
    own.joint_error *= reading_.of(c.p, own.joint_rate);
    own.joint_error += others;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    effect_.rates(c, s, z_dot);
  }

 private:
  const Effect& effect_;
  Attenuation torque_, reading_;
};

}  // namespace

FilteredEffects::FilteredEffects(const std::vector<PlacedEffect>& effects, const ArmParameters<double>& arm,
                                 double sigma_s, double joint_sigma_s) {
  for (const PlacedEffect& e : effects) {
    const SearchSpace space = search_space(*e.effect, arm, e.joint);
    const auto attenuation = [](const std::optional<std::size_t>& order, double sigma) {
      return order ? Attenuation{*order, sigma} : Attenuation{};
    };
    const Attenuation torque = attenuation(space.order_of_motor_torque, sigma_s),
                      reading = attenuation(space.order_of_joint_position, joint_sigma_s);
    const bool is_attenuated = torque.sigma_s > 0 || reading.sigma_s > 0;
    if (is_attenuated) owned_.push_back(std::make_unique<FilteredEffect>(*e.effect, torque, reading));
    seen_.push_back(is_attenuated ? owned_.back().get() : e.effect);
  }
}

}  // namespace halyard
