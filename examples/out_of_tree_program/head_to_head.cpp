// head_to_head [SCENARIO.xml]: a program of your own. It simulates a scenario, runs two estimators over the log, and
// says which of them is closer to the truth, with a 95 % interval.
//
// What it shows: the three calls that most studies consist of (read, simulate, compare), and how errors are reported:
// bad input is an InputError, which says where, what, and what to do.
#include <cstdio>
#include <exception>

#include "evaluation/comparison/compare.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/scenario.h"
#include "plant/simulate.h"

namespace {

void run(const char* file) {
  halyard::Scenario scenario = halyard::read_scenario(file);
  scenario.duration_s = 2;
  const halyard::ArmModel believed = halyard::read_model(scenario.model);
  const halyard::SimulationResult data = halyard::simulate(scenario);

  const halyard::Comparison c =
      halyard::compare_estimators(believed, {"kinematics", "sr_ukf"}, data.measured, data.truth);
  for (int k = 0; k < c.n_joints(); ++k) {
    const halyard::PairedRatio& ratio = c.paired[1][0][k];
    std::printf("joint %d: RMS error of kinematics %.4f %s, of sr_ukf %.3f times that (95 %%: %.3f to %.3f)%s\n", k + 1,
                c.units[k].shown_per_si * c.errors[0][k].rms, c.units[k].shown.c_str(), ratio.ratio, ratio.lower,
                ratio.upper, ratio.better() ? ": better" : "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : HALYARD_DATA "/raven2/experiment_a.xml");
    return 0;
  } catch (const halyard::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
