#pragma once
/// The paper's experiments A (high tension), B (low tension) and C (payload) on the simulated RAVEN-II, beside what the
/// paper measured on the robot.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/compare.h"
#include "app/report/page.h"

namespace halyard {

/// Mean absolute errors that were measured on the robot: Table IV of Haghighipanah, Li, Miyasaka, Hannaford, IROS 2015,
/// and what came after it.
struct PublishedErrors {
  const char* source;
  std::array<double, 3> error;   ///< joint 1 deg, joint 2 deg, joint 3 mm
};
/// The paper's kinematics first.
const std::vector<PublishedErrors>& published_errors();

struct Experiment {
  std::string name;          ///< of the scenario
  Comparison comparison;
};

/// Simulates experiment_a.xml, experiment_b.xml and experiment_c.xml of the folder in parallel and runs the built-in
/// estimators with raven2.xml over each. progress(stage, fraction of the stage) may be called from any thread.
/// Throws InputError if the model has not three joints, and as read_scenario, simulate and compare_estimators do.
std::vector<Experiment> compute_experiments(
    const std::filesystem::path& raven2_folder,
    const std::function<void(const std::string&, double)>& progress = {});

/// Mean of the mean absolute errors of a joint over the experiments, SI.
double mean_error(const std::vector<Experiment>& experiments, std::size_t run, int k);

/// What was simulated here beside what was measured on the robot, one row an estimator.
report::Table mean_error_table(const std::vector<Experiment>& experiments);

/// "1/91, 1/34, 1/13": the kinematics estimator's errors here over those of the robot, by joint.
std::string share_of_published(const std::vector<Experiment>& experiments);

/// Writes report.html, experiments.json and experiments.csv into the folder.
void write_experiments(const std::filesystem::path& folder, const std::vector<Experiment>& experiments);

}  // namespace halyard
