#include "diagnosis/prediction/filtered_effect.h"

#include "diagnosis/search_space.h"

namespace halyard {
namespace {

class FilteredEffect : public EffectOf<FilteredEffect> {
 public:
  FilteredEffect(const Effect& effect, std::size_t order, double sigma_s)
      : effect_(effect), order_(order), sigma_(sigma_s) {}

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
    JointSignals<T>& own = s[*c.joint];
    const T others = own.motor_torque;
    own.motor_torque = T(0.0);
    effect_.act(EffectStage::motor, c, s);
    const T turned = c.p[order_] * own.motor_rate * sigma_;
    own.motor_torque *= exp(T(-0.5 * turned * turned));
    own.motor_torque += others;
  }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::joint, c, s);
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    effect_.act(EffectStage::sensors, c, s);
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    effect_.rates(c, s, z_dot);
  }

 private:
  const Effect& effect_;
  std::size_t order_;
  double sigma_;
};

}  // namespace

FilteredEffects::FilteredEffects(const std::vector<PlacedEffect>& effects, const ArmParameters<double>& arm,
                                 double sigma_s) {
  for (const PlacedEffect& e : effects) {
    const auto order = search_space(*e.effect, arm, e.joint).order_of_motor_torque;
    const bool is_attenuated = sigma_s > 0 && order;
    if (is_attenuated) owned_.push_back(std::make_unique<FilteredEffect>(*e.effect, *order, sigma_s));
    seen_.push_back(is_attenuated ? owned_.back().get() : e.effect);
  }
}

}  // namespace halyard
