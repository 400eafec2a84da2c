#pragma once
/// What a joint has and no sensor shows, for filters that find it: a constant, one more state s of the joint, which a
/// filter lets wander.
///
///   s' = w,   w ~ N(0, ρ² δ(t))         s(0) ~ N(0, σ²)
///
///   σ     how large it may be at the start     [n]  unit of s
///   ρ     how far it wanders                   [n]  unit of s per √s
///
/// It is an effect of the model like others, but in no library: nothing but a filter can use it. Its parameter is σ.

#include <optional>
#include <string>
#include <vector>

#include "estimators/filters/arm_filter.h"
#include "transmission/effect.h"

namespace halyard {

/// An effect of one constant; Derived says what it is and where it acts.
template <class Derived>
class UnknownConstant : public EffectOf<Derived> {
 public:
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, int) const final { return {}; }
  int n_states() const final { return 1; }
  std::vector<double> state_scale(const ArmParameters<double>&, int, const double* p) const final { return {p[0]}; }

  template <class T>
  void state_rate(const EffectContext<T>&, const JointSignals<T>*, T* z_dot) const {
    z_dot[0] = T(0.0);
  }
};

struct UnknownLevels {
  Eigen::VectorXd start, wander;  ///< σ, ρ
};

/// `usual`, overridden by the options NAME_start and NAME_wander (per joint).
UnknownLevels read_unknown_levels(OptionReader& options, const std::string& name, const UnknownLevels& usual);

/// Index of the constant in the state, [n]; none of a joint without it.
std::vector<std::optional<int>> states_of(const Effect& constant, const ProcessModel& process);

/// The options with the constant's ρ in the noise.
ArmFilterOptions with_wander(ArmFilterOptions options, const Effect& constant, const ProcessModel& process,
                             const Eigen::VectorXd& wander);

}  // namespace halyard
