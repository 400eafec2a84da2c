/// 3. Gravity stretches the cables: the motors hold, and the joints sag.
///
///   Rᵀ g = h(q)            the cables hold the arm
///   g = 2 k_e x            and stretch for it
///   sag = q - R⁻¹ (r_m / N) q_m
///
/// Look for: the stretch of each cable, told at its joint, over the whole range of the arm. It is at most 0.04 deg,
/// 0.23 deg and 0.22 mm - far below the errors of 1.3 deg, 2.6 deg and 2.5 mm that the paper measured on the robot. So
/// elasticity alone does not explain that robot: this is where the search for further effects begins.

#include "arm_example.h"
#include "plant/equilibrium.h"
#include "transmission/coupling.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  ArmPlant plant(arm.nominal);
  const PlantLayout& at = plant.layout();

  // What the cable's stretch is worth at its own joint.
  const auto stretch = [&](const Eigen::VectorXd& q) {
    const Eigen::VectorXd y = resting_state(plant, 0, q);
    Eigen::VectorXd x = -path_matrix(arm.nominal) * q;
    for (int k = 0; k < 3; ++k) {
      const JointParameters<double>& j = arm.nominal.joint[k];
      x(k) = (x(k) + j.motor_travel() * y(2 * at.n + *at.motor_angle[k])) / j.pulley_radius;
    }
    return x;
  };

  const Eigen::VectorXd home = arm.home(), x_home = stretch(home), force = plant.holding_force(home);
  for (int k = 0; k < 3; ++k) {
    fmt::print("joint {} at home: held by {:.3f} {}, stretch {}\n", k + 1, force(k), k < 2 ? "N m" : "N",
               in_units(arm, k, x_home(k)));
  }

  Eigen::VectorXd worst = Eigen::VectorXd::Zero(3);
  constexpr int kSteps = 6;
  for (int a = 0; a <= kSteps; ++a)
    for (int b = 0; b <= kSteps; ++b)
      for (int c = 0; c <= kSteps; ++c) {
        Eigen::VectorXd q(3);
        const int step[] = {a, b, c};
        for (int k = 0; k < 3; ++k)
          q(k) = arm.joints[k].lower + (arm.joints[k].upper - arm.joints[k].lower) * step[k] / kSteps;
        worst = worst.cwiseMax(stretch(q).cwiseAbs());
      }
  fmt::print("largest stretch: {:.2f} deg, {:.2f} deg, {:.2f} mm\n", worst(0) * 180 / std::numbers::pi,
             worst(1) * 180 / std::numbers::pi, worst(2) * 1e3);
}
