#pragma once
/// An unknown constant of a joint that no sensor measures. A filter estimates it as one more state s of the joint,
/// modelled as a random walk:
///
///   s' = w,   w ~ N(0, ρ² δ(t))         s(0) ~ N(0, σ²)
///
///   σ     standard deviation at the start      [n]  unit of s
///   ρ     intensity of the random walk         [n]  unit of s per √second
///
/// The constant is an effect of the model that is not in the library of effects, so that only filters can use it. The
/// effect's parameter is σ.

#include <optional>
#include <string>
#include <vector>

#include "estimators/filters/arm_filter.h"
#include "transmission/effect.h"

namespace halyard {

/// An effect with one constant; Derived defines what the constant is, and as a ConstantTerm where it acts.
template <class Derived>
class UnknownConstant : public EffectOf<Derived>, public ConstantTerm {
 public:
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const final { return {}; }
  int n_states() const final { return 1; }
  unsigned stages() const final { return static_cast<unsigned>(added_at()); }
  std::vector<double> state_scale(const ArmParameters<double>&, EffectPlace, const double* p) const final {
    return {p[0]};
  }

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

/// Index of the constant in the state, [n]; none for a joint without it.
std::vector<std::optional<int>> states_of(const Effect& constant, const ProcessModel& process);

/// Adds the constant's ρ to the noise of the options.
ArmFilterOptions with_wander(ArmFilterOptions options, const Effect& constant, const ProcessModel& process,
                             const Eigen::VectorXd& wander);

}  // namespace halyard
