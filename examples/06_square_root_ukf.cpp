/// 6. The square-root unscented Kalman filter: from motor torques and motor angles to the joints.
///
///   process model   the arm with elastic cables, 12 states          (Eqs. 4 to 8)
///   measurement     motor angles
///
/// It knows how far the torque has to stretch the cables, which kinematics cannot.
///
/// Look for: truth, estimate and naive estimate side by side, and the standard deviation that the filter claims. The
/// plant is Simbody with an implicit integrator, the filter its own equations: they share the cables, not the code of
/// the chain.

#include "arm_example.h"
#include "estimators/built_in.h"

int main() {
  using namespace halyard;
  const ArmModel arm = raven2();
  const SimulationResult run = simulate(on_sines(arm, 3));
  const auto filter = make_sr_ukf(arm, {}), kinematics = make_kinematics(arm, {});

  fmt::print("joint 2, {:>5} {:>15} {:>15} {:>15} {:>14}\n", "t, s", "truth", "filter", "kinematics", "std");
  filter->reset(sample_of(run.measured, 0));
  kinematics->reset(sample_of(run.measured, 0));
  for (std::size_t i = 1; i < run.measured.size(); ++i) {
    filter->update(sample_of(run.measured, i));
    kinematics->update(sample_of(run.measured, i));
    if (i % 500) continue;
    fmt::print("         {:5.1f} {:>15} {:>15} {:>15} {:>14}\n", run.measured.time[i],
               in_units(arm, 1, run.truth.joint_position[1][i]), in_units(arm, 1, filter->estimate().joint_position(1)),
               in_units(arm, 1, kinematics->estimate().joint_position(1)),
               in_units(arm, 1, filter->estimate().joint_position_std(1)));
  }

  const Eigen::VectorXd ours = rms_error(*filter, run), naive = rms_error(*kinematics, run);
  std::string closer;
  for (int k = 0; k < 3; ++k) {
    fmt::print("joint {} RMS error: filter {}, kinematics {}\n", k + 1, in_units(arm, k, ours(k)),
               in_units(arm, k, naive(k)));
    if (ours(k) < naive(k)) closer += fmt::format(" {}", k + 1);
  }
  fmt::print("the filter is closer than kinematics at joints:{}\n", closer);
}
