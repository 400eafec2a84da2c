#pragma once
/// Faults of a whole arm that its numbers, each within its own bound, do not show.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// The first joint, 0-based, that moves without inertia at these positions [n] while the joints inboard of it are free:
/// M(q) with the rotors' inertia is not positive definite there. None: every joint has an inertia.
std::optional<int> joint_without_inertia(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

/// The first number that lies outside its field's bound after a change, as a sentence: "the coulomb of <friction> of
/// joint 2 becomes -0.475, expected at least 0". Empty: none. What rounding leaves of a number that is changed to 0
/// counts as 0.
std::string number_outside_bound(const ArmParameters<double>& before, const ArmParameters<double>& after);

struct EffectFault {
  std::size_t effect;  ///< index
  std::string what;
};

/// What is wrong with the arm before and after one effect; empty: nothing.
using FaultOfChange =
    std::function<std::string(const ArmParameters<double>& before, const ArmParameters<double>& after)>;

/// The first of the effects, in their order, whose change of the arm has a fault.
std::optional<EffectFault> first_fault(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects,
                                       const FaultOfChange& fault);

}  // namespace halyard
