#include "plant/equilibrium.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "model/input_error.h"
#include "model/output/number_text.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// The forces that the cables must carry, [n]; 0 at joints without one.
Eigen::VectorXd cable_forces_needed(ArmPlant& plant, double time_s, const Eigen::VectorXd& y) {
  const ArmParameters<double>& arm = plant.drive().arm();
  const int n = arm.n;
  JointSignals<double> s[kMaxJoints];
  plant.drive().signals(time_s, y.data(), y.data() + n, y.data() + 2 * n, s);
  const Eigen::VectorXd q = y.head(n);
  Eigen::MatrixXd reaction = path_matrix(arm).transpose();  // Γ = Rᵀ g
  Eigen::VectorXd g(n), force(n);
  for (int k = 0; k < n; ++k) g(k) = s[k].cable_force_joint, force(k) = s[k].joint_force;
  Eigen::VectorXd needed = plant.holding_force(q) - (force - reaction * g);
  for (int k = 0; k < n; ++k) {
    if (arm.joint[k].drive == Drive::cable) continue;
    reaction.row(k).setZero();
    reaction.col(k).setZero();
    reaction(k, k) = 1;
    needed(k) = 0;
  }
  return reaction.fullPivLu().solve(needed);
}

constexpr double kFarthest = 1;  ///< stretch of a cable, m

/// Whether the missing force changes its sign between -reach and reach. False if it is not finite at an end.
template <class Missing>
bool holds_within(const Missing& missing, double reach) {
  const double low = missing(-reach), high = missing(reach);
  return std::isfinite(low) && std::isfinite(high) && std::min(low, high) <= 0 && std::max(low, high) >= 0;
}

}  // namespace

Eigen::VectorXd resting_state(ArmPlant& plant, double time_s, const Eigen::VectorXd& q) {
  const ArmParameters<double>& arm = plant.drive().arm();
  const PlantLayout& l = plant.layout();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(l.size());
  y.head(l.n) = q;
  const Eigen::VectorXd unstretched = unstretched_motors(arm, q);
  for (int k = 0; k < l.n; ++k)
    if (arm.joint[k].drive == Drive::cable) y(2 * l.n + *l.motor_angle[k]) = unstretched(k);

  const Eigen::VectorXd needed = cable_forces_needed(plant, time_s, y);
  for (int k = 0; k < l.n; ++k) {
    if (arm.joint[k].drive != Drive::cable) continue;
    double& angle = y(2 * l.n + *l.motor_angle[k]);
    const auto missing = [&](double stretch) {
      angle = unstretched(k) + stretch / arm.joint[k].motor_travel();
      JointSignals<double> s[kMaxJoints];
      plant.drive().signals(time_s, y.data(), y.data() + l.n, y.data() + 2 * l.n, s);
      return s[k].cable_force_joint - needed(k);
    };
    double reach = 1e-6;
    while (reach < kFarthest && !holds_within(missing, reach)) reach = std::min(2 * reach, kFarthest);
    if (!holds_within(missing, reach))
      throw InputError("joint " + std::to_string(k + 1) + ": no stretch of its cable up to 1 m gives the " +
                       with_digits(needed(k), 6) + " N that hold the arm; give it more stiffness or tension");
    std::uintmax_t iterations = 200;
    const boost::math::tools::eps_tolerance<double> to_rounding;
    const auto bracket = boost::math::tools::toms748_solve(missing, -reach, reach, to_rounding, iterations);
    const double low = std::abs(missing(bracket.first)), high = std::abs(missing(bracket.second));
    missing(low < high ? bracket.first : bracket.second);
  }
  return y;
}

}  // namespace halyard
