#pragma once
/// The paper's experiments as tables, sentences and a page.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/report/page.h"
#include "evaluation/experiments/raven_experiments.h"
#include "model/output/output_files.h"

namespace halyard {

/// In the form of the paper's Table IV: errors in this simulation beside errors measured on the robot, one row per
/// estimator.
report::Table mean_error_table(const std::vector<Experiment>& experiments);

/// In the form of the paper's Table III: errors for each experiment and joint, and the filter's improvement over
/// kinematics, beside those entries of Table III that are known.
report::Table experiment_table(const std::vector<Experiment>& experiments);

/// A sentence that says whether the filter's improvements have the same order as on the robot, joint 1 < joint 2 <
/// joint 3, in the mean and in each experiment.
std::string order_of_gains(const std::vector<Experiment>& experiments);

/// A sentence on joint 1's peak error, which the paper's filter made worse in each experiment.
std::string peaks_of_joint_one(const std::vector<Experiment>& experiments);

/// "0.70, 0.37, 1.7 times": for each joint, the error of kinematics here divided by that on the robot.
std::string share_of_published(const std::vector<Experiment>& experiments);

report::Page experiments_page(const std::vector<Experiment>& experiments, const std::optional<EffectStudy>& study);

/// Adds report.html, experiments.json and experiments.csv into the folder, and effects.csv if there is a study.
void write_experiments(OutputFiles& files, const std::filesystem::path& folder,
                       const std::vector<Experiment>& experiments,
                       const std::optional<EffectStudy>& study = std::nullopt);

}  // namespace halyard
