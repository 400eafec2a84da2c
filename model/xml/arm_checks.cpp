#include "model/xml/arm_checks.h"

#include <cmath>
#include <type_traits>

#include "model/output/number_text.h"
#include "model/rigid_chain.h"
#include "transmission/arm_fields.h"
#include "transmission/coupling.h"

namespace halyard {

std::optional<int> joint_without_inertia(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  constexpr double kRounding = 1e-12;  // of a pivot, which is what is left of its diagonal entry
  double M[kMaxJoints][kMaxJoints], diagonal[kMaxJoints];
  mass_matrix(arm, chain_pose(arm, q.data()), M);
  add_rotor_mass(arm, M);
  for (int k = 0; k < arm.n; ++k) diagonal[k] = M[k][k];
  ldl_factor(arm.n, M);
  for (int k = 0; k < arm.n; ++k)
    if (!(1 / M[k][k] > kRounding * diagonal[k])) return k;
  return std::nullopt;
}

std::string number_outside_bound(const ArmParameters<double>& before, const ArmParameters<double>& after) {
  constexpr double kRounding = 1e-9;
  std::string fault;
  for (int k = 0; k < after.n; ++k) {
    const auto judge = [&](const ArmField& field, const auto& was, const auto& is) {
      if constexpr (std::is_same_v<decltype(is), const double&>) {
        if (!fault.empty() || is == was || field.bound == Bound::none || !field.exists_at(after.joint[k].drive)) return;
        const bool positive = field.bound == Bound::positive;
        if (positive ? is > 0 : is >= -kRounding * std::abs(was)) return;
        fault = "the " + std::string(field.name) + " of <" + std::string(field.part_at(after.joint[k].drive)) +
                "> of joint " + std::to_string(k + 1) + " becomes " + with_digits(is, 6) + ", expected " +
                (positive ? "a number greater than 0" : "at least 0");
      }
    };
    for_each_joint_field(judge, before.joint[k], after.joint[k]);
  }
  return fault;
}

std::optional<EffectFault> first_fault(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects,
                                       const FaultOfChange& fault) {
  ArmParameters<double> before = nominal;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    ArmParameters<double> after = before;
    effects[i].effect->change_parameters(after, effects[i].joint, effects[i].p);
    if (std::string what = fault(before, after); !what.empty()) return EffectFault{i, std::move(what)};
    before = after;
  }
  return std::nullopt;
}

}  // namespace halyard
