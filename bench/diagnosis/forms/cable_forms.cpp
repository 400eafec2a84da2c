#include "bench/diagnosis/forms/unregistered.h"
#include "transmission/effects/typical_size.h"

/// Cables of other forms than the library's.

namespace halyard::blind {
namespace {

/// Hysteresis of four parallel elements that yield one after another, instead of one of Bouc-Wen type:
///   g' = g + 2 k_e ρ/4 Σ (z_i - x),   z_i' = x' (1 - |z_i / z_y,i|⁴) where x' z_i > 0,   z_i' = x' elsewhere
/// Source: Iwan, J. Appl. Mech. 33 (1966); as Maxwell-slip Al-Bender, Lampaert, Swevers, IEEE Trans. Automatic Control
/// 50 (2005). The fourth power rounds the yield point, so that the equations stay smooth.
class MaxwellSlip : public EffectOf<MaxwellSlip> {
 public:
  std::string name() const override { return "maxwell_slip"; }
  std::string summary() const override { return "a cable of parallel elements that yield one after another"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double stretch = typical_stretch(arm.joint[*joint]);
    return {{"share", "1", 0, 0.4, 0, 0.95},
            {"yield_stretch", "m", 0.2 * stretch, 0.2 * stretch, 1e-3 * stretch, 10 * stretch}};
  }
  int n_states() const override { return kElements; }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    T slipped = 0.0;
    for (int i = 0; i < kElements; ++i) slipped += c.z[i] - s[*c.joint].stretch;
    const T change = T(2.0 / kElements) * c.arm.joint[*c.joint].stiffness * c.p[0] * slipped;
    s[*c.joint].cable_force_motor += change;
    s[*c.joint].cable_force_joint += change;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    constexpr double kYield[kElements] = {0.3, 0.7, 1.2, 1.8};
    const T rate = s[*c.joint].stretch_rate;
    for (int i = 0; i < kElements; ++i) {
      const T u = c.z[i] / (T(kYield[i]) * c.p[1]);
      z_dot[i] = rate * (T(1.0) - select(rate * u > T(0.0), T(u * u * u * u), T(0.0)));
    }
  }

 private:
  static constexpr int kElements = 4;
};

/// Hysteresis of Bouc-Wen type whose loop is slimmer in unloading and whose knee is sharper than the library's:
///   g' = g + 2 k_e ρ (z - x),   z' = x' - (β |x'| z |z| + γ x' z²) / z_y²,   β = 0.7, γ = 0.3
/// The library has the exponent n = 1 and β = γ. Source: Wen, J. Eng. Mech. 102 (1976); Ismail, Ikhouane, Rodellar,
/// Arch. Comput. Methods Eng. 16 (2009), Eq. 2 with n = 2.
class BoucWen : public EffectOf<BoucWen> {
 public:
  std::string name() const override { return "bouc_wen"; }
  std::string summary() const override { return "a loop of the cable's force with a sharp knee"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double stretch = typical_stretch(arm.joint[*joint]);
    return {{"share", "1", 0, 0.4, 0, 0.95},
            {"yield_stretch", "m", 0.1 * stretch, 0.1 * stretch, 1e-3 * stretch, 10 * stretch}};
  }
  int n_states() const override { return 1; }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T change = T(2.0) * c.arm.joint[*c.joint].stiffness * c.p[0] * (c.z[0] - s[*c.joint].stretch);
    s[*c.joint].cable_force_motor += change;
    s[*c.joint].cable_force_joint += change;
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    constexpr double kBeta = 0.7, kGamma = 0.3;
    const T rate = s[*c.joint].stretch_rate, u = c.z[0] / c.p[1];
    z_dot[0] = rate - T(kBeta) * abs(rate) * u * abs(u) - T(kGamma) * rate * u * u;
  }
};

/// Backlash with round edges:
///   x_eff = ε (ln(1 + exp((x - h) / ε)) - ln(1 + exp((-x - h) / ε))),   ε = 0.2 h
/// Source: the smooth dead zone of Merzouki, Davila, Fridman, Cadiou, Control Engineering Practice 15 (2007), here with
/// softplus functions.
class RoundBacklash : public EffectOf<RoundBacklash> {
 public:
  std::string name() const override { return "round_backlash"; }
  std::string summary() const override { return "a dead zone with round edges"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  int rank(EffectStage) const override { return 1; }  // as backlash
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double radius = arm.joint[*joint].capstan_radius;
    return {{"half_gap", "m", 0, 0.03 * radius, 0, radius}};
  }
  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    const T h = max(c.p[0], T(1e-9)), edge = T(0.2) * h, x = s[*c.joint].stretch;
    const T forward = (x - h) / edge, backward = (-x - h) / edge;
    s[*c.joint].stretch = edge * (softplus(forward) - softplus(backward));
    s[*c.joint].stretch_rate *= step(forward) + step(backward);
  }

 private:
  template <class T>
  static T softplus(const T& u) {
    return max(u, T(0.0)) + log(T(T(1.0) + exp(T(-abs(u)))));
  }
  /// Its derivative.
  template <class T>
  static T step(const T& u) {
    return T(1.0) / (T(1.0) + exp(T(-max(T(-40.0), min(T(40.0), u)))));
  }
};

/// A cable that stiffens with the square of its stretch:
///   g' = g + 2 k_e κ x |x| / x_t
/// Source: the quadratic force law of antagonistic tendons, Migliore, Brown, DeWeerth, ICRA 2005.
class QuadraticStiffening : public EffectOf<QuadraticStiffening> {
 public:
  std::string name() const override { return "quadratic_stiffening"; }
  std::string summary() const override { return "a cable that stiffens with the square of its stretch"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::cable_force); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"stiffening", "1", 0, 2, 0, 30}};
  }
  template <class T>
  void on_cable_force(const EffectContext<T>& c, JointSignals<T>* s) const {
    const JointParameters<T>& j = c.arm.joint[*c.joint];
    // x_t: the stretch at which the tension of rest has doubled.
    const T x = s[*c.joint].stretch, change = T(2.0) * j.stiffness * c.p[0] * x * abs(x) * j.stiffness / j.tension;
    s[*c.joint].cable_force_motor += change;
    s[*c.joint].cable_force_joint += change;
  }
};

/// Creep with two time constants:
///   x_eff = x - z_1 - z_2,   z_i' = (c/2 g / (2 k_e) - z_i) / T_i,   T_2 = 6 T_1
/// Source: a chain of Kelvin elements, Findley, Lai, Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials
/// (1976).
class TwoRateCreep : public EffectOf<TwoRateCreep> {
 public:
  std::string name() const override { return "two_rate_creep"; }
  std::string summary() const override { return "a cable that creeps with two time constants"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"compliance", "1", 0, 1, 0, 20}, {"time", "s", 0.8, 0.8, 0.1, 10}};
  }
  int n_states() const override { return 2; }
  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].stretch -= c.z[0] + c.z[1];
  }
  template <class T>
  void state_rate(const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) const {
    const T end = T(0.25) * c.p[0] * s[*c.joint].cable_force_joint / c.arm.joint[*c.joint].stiffness;
    z_dot[0] = (end - c.z[0]) / c.p[1];
    z_dot[1] = (end - c.z[1]) / (T(6.0) * c.p[1]);
  }
};

/// A slip of the cable on its capstan that is fast at first and settles, instead of a smooth step:
///   x_eff = x - s (1 - exp(-(t - t_0) / 0.15 s)) from t_0 on
/// Source: a belt slips from the edge of its contact on, and the slower the less tension is left to carry; Johnson,
/// Contact Mechanics (1985), section 8.1.
class GradualSlip : public EffectOf<GradualSlip>, public RefinesSearch {
 public:
  std::string name() const override { return "gradual_slip"; }
  std::string summary() const override { return "a lasting slip of the cable that settles over half a second"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::stretch); }
  bool applies(const ArmParameters<double>& arm, int joint) const override { return has_cable(arm, joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace joint) const override {
    const double radius = arm.joint[*joint].capstan_radius;
    return {{"slip", "m", 0, 0.05 * radius, -2 * radius, 2 * radius}, {"time", "s", 1, 1, -1e10, 1e10}};
  }
  void refine_search(SearchSpace& space, const ArmParameters<double>&, EffectPlace) const override {
    space["time"].range = SearchRange::record_time;
  }
  template <class T>
  void on_stretch(const EffectContext<T>& c, JointSignals<T>* s) const {
    constexpr double kSettles = 0.15;  // s
    const T after = T(c.time) - c.p[1];
    const T left = select(after > T(0.0), exp(T(-max(T(0.0), after) / T(kSettles))), T(1.0));
    s[*c.joint].stretch -= c.p[0] * (T(1.0) - left);
    s[*c.joint].stretch_rate -= select(after > T(0.0), T(c.p[0] / T(kSettles) * left), T(0.0));
  }
};

}  // namespace

void add_cable_forms(OwnedEffects& to) {
  to.push_back({std::make_unique<MaxwellSlip>(), "hysteresis"});
  to.push_back({std::make_unique<BoucWen>(), "hysteresis"});
  to.push_back({std::make_unique<RoundBacklash>(), "backlash"});
  to.push_back({std::make_unique<QuadraticStiffening>(), "stiffness"});
  to.push_back({std::make_unique<TwoRateCreep>(), "creep"});
  to.push_back({std::make_unique<GradualSlip>(), "cable_slip"});
}

}  // namespace halyard::blind
