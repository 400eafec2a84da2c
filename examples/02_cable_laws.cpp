/// 2. Three laws of a cable: the force g of its two runs over the stretch x.
///
///   paper        g = k_e (e^x - e^-x)                     x in metres: linear, no tension, never slack
///   exponential  runs T_0 e^(±a x), a = k_e / T_0         stiffens
///   linear       runs T_0 ± k_e x, none below zero        half as stiff once a run is slack
///
/// All have the slope 2 k_e at rest. Cable 2 of the arm at low tension: k_e = 88 kN/m, T_0 = 17.7 N.
///
/// Look for: the same force near rest; at T_0 / k_e the linear law's backward run goes slack, and from there on g grows
/// half as fast; the exponential law runs away upward; the paper's law knows none of it.

#include "arm_example.h"
#include "transmission/cable_law.h"

int main() {
  using namespace halyard;
  JointParameters<double> cable = raven2().nominal.joint[1];
  cable.tension = 17.7;

  fmt::print("{:>9} {:>9} {:>12} {:>9} {:>24} {:>24}\n", "x, mm", "paper, N", "exponential", "linear",
             "exponential's runs", "linear's runs");
  RunTensions<double> runs{};
  for (const double x_mm : {0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4}) {
    const double x = x_mm * 1e-3;
    cable.law = CableLaw::paper;
    const double paper = cable_force(cable, x, 0.0);
    cable.law = CableLaw::exponential;
    const RunTensions<double> exponential = run_tensions(cable, x, 0.0);
    cable.law = CableLaw::linear;
    runs = run_tensions(cable, x, 0.0);
    fmt::print("{:9.2f} {:9.2f} {:12.2f} {:9.2f} {:12.2f} {:11.2f} {:12.2f} {:11.2f}\n", x_mm, paper,
               exponential.forward - exponential.backward, runs.forward - runs.backward, exponential.forward,
               exponential.backward, runs.forward, runs.backward);
  }
  fmt::print("slack beyond {:.3f} mm: the backward run carries {:.1f} N\n", cable.tension / cable.stiffness * 1e3,
             runs.backward);
}
