/// 1. Coupling: one motor moves several joints.
///
///   r_m q_m / N = R q,  R = diag(r_l) C        what the cables' paths demand (Eq. 8)
///   Γ = Rᵀ g                                   what the cables' forces do to the joints
///
/// Cable 2 runs past joint 1, cable 3 past both. So motor 1 alone moves joint 1, and joints 2 and 3 must give way, or
/// their cables would stretch.
///
/// Look for: the outboard joints move when motor 1 turns; and what the motors put in arrives at the joints to the last
/// digit, but only with the reaction on the inboard joints, which the printed Eq. 7 leaves out.

#include "arm_example.h"
#include "transmission/coupling.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  const int n = arm.n();

  for (int motor = 0; motor < n; ++motor) {
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(n);
    turn(motor) = 2 * std::numbers::pi * arm.nominal.joint[motor].gear_ratio;
    const Eigen::VectorXd q = unstretched_joints(arm.nominal, turn, Eigen::VectorXd::Zero(n));
    fmt::print("one capstan turn of motor {} moves", motor + 1);
    for (int k = 0; k < n; ++k) fmt::print("  joint {} {}", k + 1, in_units(arm, k, q(k)));
    fmt::print("\n");
  }

  const double rate[] = {0.5, -0.4, 0.1}, g[] = {20, 15, 4};  // joint rates, cable forces in N
  double path_rate[3], force[3];
  cable_path(arm.nominal, rate, path_rate);
  joint_reaction(arm.nominal, g, force);
  double from_motors = 0, at_joints = 0, printed = 0;
  for (int k = 0; k < n; ++k) {
    from_motors += g[k] * path_rate[k];
    at_joints += force[k] * rate[k];
    printed += g[k] * arm.nominal.joint[k].pulley_radius * rate[k];
  }
  fmt::print("power from the cables {:.6f} W, at the joints {:.6f} W, without the reaction {:.6f} W\n", from_motors,
             at_joints, printed);
  // Three products of three terms of about 1 W: a dozen roundings.
  fmt::print("power balances: {}\n", std::abs(from_motors - at_joints) < 1e-14 ? "yes" : "no");
}
