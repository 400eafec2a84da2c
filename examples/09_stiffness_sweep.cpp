/// 9. How soft may a cable be? The stiffness and damping of cable 2 from a quarter to four times the paper's.
///
/// Look for: the error of kinematics is inverse to the stiffness; a filter that knows the stiffness does not care, and
/// one that believes the paper's number is as far off as the number is.
/// `halyard sweep` does this over grids of parameters, in parallel, with a report: raven2/stiffness_sweep.xml.

#include "arm_example.h"
#include "estimators/built_in.h"

int main() {
  using namespace halyard;
  const ArmModel paper = raven2();
  fmt::print("cable 2, times the paper's: RMS error of joint 2 by kinematics, by a filter that knows, that does not\n");
  std::vector<double> naive;
  for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    ArmModel arm = paper;
    arm.nominal.joint[1].stiffness *= factor;
    arm.nominal.joint[1].damping *= factor;
    const SimulationResult run = simulate(on_sines(arm, 1.5));
    naive.push_back(rms_error(*make_kinematics(arm, {}), run)(1));
    fmt::print("{:5.2f}  {}  {}  {}\n", factor, in_units(arm, 1, naive.back()),
               in_units(arm, 1, rms_error(*make_sr_ukf(arm, {}), run)(1)),
               in_units(arm, 1, rms_error(*make_sr_ukf(paper, {}), run)(1)));
  }
  fmt::print("a softer cable is worse for kinematics: {}\n",
             std::is_sorted(naive.rbegin(), naive.rend()) ? "yes" : "no");
}
