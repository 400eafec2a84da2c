#include "bench/performance/page.h"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <fstream>

#include "estimators/lanes/lane_kernels.h"

namespace halyard {
namespace {

constexpr double kEqualError = 1e-8;  // rad | m

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string today() {
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

std::string cell(double ratio) { return std::isnan(ratio) ? " - |" : fmt::format(" {:.3g} |", ratio); }

/// Work at equal error, relative to Simbody's RungeKuttaMerson.
std::string ratio_table(const std::vector<Panel>& panels) {
  const std::vector<std::string> names = compared_integrators();
  std::string text = "| stiffness | smoothing |", rule = "|---|---|";
  for (const std::string& name : names) text += " " + name + " |", rule += "---|";
  text += "\n" + rule + "\n";
  for (const Panel& panel : panels) {
    double reference = std::nan("");
    for (const WorkPrecision& r : panel.results)
      if (r.integrator == "simbody_rkm") reference = work_at(r, kEqualError);
    text += fmt::format("| x{} | x{} |", panel.which.stiffness, panel.which.smoothing);
    for (const WorkPrecision& r : panel.results) text += cell(work_at(r, kEqualError) / reference);
    text += "\n";
  }
  return text;
}

/// In how many cases each integrator needs the least work.
std::string winners(const std::vector<Panel>& panels) {
  const std::vector<std::string> names = compared_integrators();
  std::vector<int> wins(names.size(), 0);
  for (const Panel& panel : panels) {
    std::size_t best = names.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < names.size(); ++k)
      if (const double work = work_at(panel.results[k], kEqualError); work < least) least = work, best = k;
    if (best < names.size()) ++wins[best];
  }
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (wins[k] > 0)
      text += fmt::format("{}`{}` in {} of {}", text.empty() ? "" : ", ", names[k], wins[k], panels.size());
  return text;
}

std::string estimator_table(const std::vector<StepTime>& times) {
  std::string text = "| estimator | mean, µs | median, µs | 99 %, µs |\n|---|---|---|---|\n";
  for (const StepTime& t : times)
    text += fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} |\n", t.variant, t.mean_us, t.median_us, t.p99_us);
  return text;
}

/// Of `ekf` and `sr_ukf` in turn, for 1 to 7 joints.
std::string chain_table(const std::vector<StepTime>& times) {
  std::string text =
      "| joints | states | sigma points | ekf, median µs | mean | sr_ukf, median µs | mean | median, to 3 joints | "
      "n³, to 3 joints |\n|---|---|---|---|---|---|---|---|---|\n";
  const auto ratio = [&](std::size_t joints) { return times[2 * joints - 1].median_us / times[5].median_us; };
  for (std::size_t n = 1; 2 * n <= times.size(); ++n)
    text += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", n, 4 * n, 8 * n + 1,
                        times[2 * n - 2].median_us, times[2 * n - 2].mean_us, times[2 * n - 1].median_us,
                        times[2 * n - 1].mean_us, ratio(n), std::pow(double(n) / 3, 3));
  return text;
}

std::string plant_table(const std::vector<PlantSpeed>& speeds) {
  std::string text = "| case | own chain | Simbody | error, own chain | error, Simbody |\n|---|---|---|---|---|\n";
  for (const PlantSpeed& s : speeds)
    text += fmt::format("| {} | {:.0f} | {:.1f} | {:.1e} | {:.1e} |\n", s.name, s.own_chain, s.simbody, s.own_error,
                        s.simbody_error);
  return text;
}

std::string variant_table(const std::vector<StepTime>& times) {
  std::string text = "| step | median, µs | 99 %, µs | ratio |\n|---|---|---|---|\n";
  for (std::size_t i = 0; i < times.size(); ++i) {
    text += fmt::format("| {} | {:.1f} | {:.1f} |", times[i].variant, times[i].median_us, times[i].p99_us);
    text += i % 2 == 1 ? fmt::format(" {:.2f} |\n", times[i].median_us / times[i - 1].median_us) : " |\n";
  }
  return text;
}

std::string introduction() {
  return fmt::format(R"(# Performance

`build/bench/halyard_performance` wrote this page; it takes one to three minutes. Processor: {}; date: {}; vector
kernels: {}. All times of a table come from one run, and the filters took turns. Times of other machines differ; ratios
differ less. Other programs that ran on the machine at the same time make the 99 % column larger.
`HALYARD_INSTRUCTION_SET=avx2` or `generic` measures narrower kernels.

)",
                     processor(), today(), lane_kernels()[0].name);
}

std::string estimators_section(const Measured& m) {
  return fmt::format(R"(## An update of the estimators

RAVEN-II, samples at 1 kHz, sines of all joints for two seconds, seen by a camera at 30 Hz. An update includes the
calls of `revise` that follow it. The three effects are friction of motor 1, torque ripple of motor 2 and backlash of
joint 3.

{}
The mean is that of 100 steps, the middle one of such means. Most steps cost the median. The mean is larger, because
some steps need more:

- Where friction changes, and at least every 10 ms, a step has a Jacobian and φ functions of its own. Others keep
  those of an earlier one ([exponential_step.h](../estimators/process/exponential_step.h)).
- 2 % of the steps are refused by the guard and taken in two to four parts, in long arms in more. In 4 % the answer to
  the noise needs sub-steps, because friction is not linear over its reach
  ([arm_impulses.h](../estimators/process/plain/arm_impulses.h)).
- An effect whose forces depend on one signal each ([one_signal.h](../transmission/effects/one_signal.h)) costs little
  more than its own evaluation at both ends of a step, for its slopes and its curvature. Near a kink, such as the edge
  of a backlash, and with effects of other kinds, `ekf` finds the Jacobian at both ends and `sr_ukf` evaluates both
  points of each pair of sigma points at both ends.

Arms of 1 to 7 joints. Each has the first joints of the longest one, whose last links are light: there the guard
refuses more steps. The order of the algorithm is n³: products and roots of n x n matrices.

{}
)",
                     estimator_table(m.estimators), chain_table(m.chains));
}

std::string variants_section(const Measured& m) {
  return fmt::format(R"(## Variants of a step

The ratio compares the second row of each pair with the first. The first two pairs are whole updates with the
exponential step and with sub-steps; the third is prediction and correction, the noise of the step given, with sigma
points side by side and one by one.

{}
)",
                     variant_table(m.variants));
}

std::string plant_section(const Measured& m) {
  return fmt::format(R"(## Speed of a simulation

Times real time, RAVEN-II under control at 1 kHz, default options. Stiff: stiffness and damping of link 1's cable
x100. Sharp: smoothing speeds of all friction x0.1. Under noise: torques vary by a tenth of the motors' Coulomb
friction from sample to sample. The error is the largest difference of a joint's position from `bdf` with tolerances
of 1e-11, in rad or m.

{}
)",
                     plant_table(m.plant));
}

std::string integrators_section(const Measured& m) {
  return fmt::format(R"(## Integrators of the plant

The stiffness and damping of link 1's cable, and the smoothing speeds of friction, are multiplied by the factors of
each panel. Moving: sines of all joints. At rest: the arm is held under a noise of the torques that friction carries.
Each curve goes from a tolerance of 1e-4 to 1e-8. `rosenbrock` to `explicit_rk` run on halyard's own chain, the others
on Simbody.

![Work and precision of the integrators while the arm moves](images/work_precision_moving.svg)

![Work and precision of the integrators at rest](images/work_precision_resting.svg)

Processor time at an error of {:g} rad or m, relative to Simbody's RungeKuttaMerson (`simbody_rkm`); "-": an integrator
does not reach this error within {} s a run. Moving:

{}
At rest:

{}
Least time while moving: {}. At rest: {}.

**Which integrator for the stiff cable of link 1?** `rosenbrock`. It has the exact Jacobian of all forces and solves
linear systems only, so that the accuracy limits its steps and not the stiffness of cable or friction. The explicit
methods take shorter steps as the cable becomes stiffer: `explicit_rk` needs up to three times as long as `rosenbrock`
at x1, and four to ten times at x100. `imex_link1` removes the limit that the cable sets, but not that of friction:
where friction is sharp (x0.02), it takes two to three times as long as `imex`. On Simbody's chain, `simbody_rkm` is
faster than `dirk` up to x10 while the arm moves, unless friction is sharp; `dirk` is faster at x100, and always at
rest.
)",
                     kEqualError, kLongestRun, ratio_table(m.moving), ratio_table(m.resting), winners(m.moving),
                     winners(m.resting));
}

}  // namespace

std::string page(const Measured& m) {
  return introduction() + estimators_section(m) + variants_section(m) + plant_section(m) + integrators_section(m);
}

}  // namespace halyard
