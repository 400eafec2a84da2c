/// 5. The naive estimate: joint positions straight from motor angles, as the robot's own software does it.
///
///   q̂ = R⁻¹ (r_m / N) q_m                      Eq. 8 inverted
///
/// Look for: its error is small here, because the simulated arm has nothing but elasticity. It is not noise: at each
/// instant it is the stretch of the cables, R (q̂ - q) = x.

#include "arm_example.h"
#include "estimators/filters/kinematics.h"
#include "transmission/coupling.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  const SimulationResult run = simulate(on_sines(arm, 3));
  KinematicsEstimator kinematics(arm);
  const Eigen::MatrixXd R = path_matrix(arm.nominal);

  Eigen::VectorXd peak = Eigen::VectorXd::Zero(3);
  double unexplained = 0;
  kinematics.reset(sample_of(run.measured, 0));
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    kinematics.update(sample_of(run.measured, i));
    Eigen::VectorXd q(3), x(3);
    for (int k = 0; k < 3; ++k) q(k) = run.truth.joint_position[k][i];
    const Eigen::VectorXd error = kinematics.estimate().joint_position - q;
    for (int k = 0; k < 3; ++k)
      x(k) = arm.nominal.joint[k].motor_travel() * run.truth.motor_position[k][i] - R.row(k).dot(q);
    peak = peak.cwiseMax(error.cwiseAbs());
    unexplained = std::max(unexplained, (R * error - x).cwiseAbs().maxCoeff());
  }
  const Eigen::VectorXd rms = rms_error(kinematics, run);
  for (int k = 0; k < 3; ++k)
    fmt::print("joint {}: error of kinematics {} RMS, {} peak\n", k + 1, in_units(arm, k, rms(k)),
               in_units(arm, k, peak(k)));
  // Half a count of the motor's encoder, 2π / 4000 / 2, at the cable.
  const double half_count = std::numbers::pi / 4000 * arm.nominal.joint[0].motor_travel();
  fmt::print("largest error beyond the stretch {:.2e} m, half a count is {:.2e} m\n", unexplained, half_count);
  fmt::print("it is the cables' stretch: {}\n", unexplained < 1.01 * half_count ? "yes" : "no");
}
