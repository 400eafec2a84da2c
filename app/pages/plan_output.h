#pragma once
/// Output of a plan: lines on the terminal, plan.json, plan.html.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/studies/motion_proposal.h"
#include "model/output/output_files.h"

namespace halyard {

struct Plan {
  ArmModel model;
  std::string scenario;  ///< file of the scenario, as given
  bool joint_sensor = true;
  Log log;  ///< of the given motion
  std::vector<DetectionLimit> limits;
  bool names_nothing = false;
  std::optional<SeparatingMotion> separating;
};

/// The table and the benefit of the proposed motion, for the terminal.
std::string plan_text(const Plan& plan);
std::string plan_json(const Plan& plan);

/// Adds plan.html, plan.json and, if a motion is proposed, scenario.xml into the folder.
void write_plan(OutputFiles& files, const std::filesystem::path& folder, const Plan& plan);

}  // namespace halyard
