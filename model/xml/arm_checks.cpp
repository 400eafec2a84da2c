#include "model/xml/arm_checks.h"

#include "model/rigid_chain.h"
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

}  // namespace halyard
