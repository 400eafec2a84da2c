#pragma once

#include <filesystem>
#include <string>

namespace halyard {

struct PlanCommandOptions {
  std::filesystem::path model, scenario;
  std::string separate;       ///< "EFFECT@JOINT,EFFECT@JOINT"; empty: no motion is proposed
  bool joint_sensor = true;   ///< false: plan for a log without joint sensors
  std::filesystem::path out;  ///< folder of plan.html, plan.json and scenario.xml; empty: none
};

/// halyard diagnose --plan: predicts which effects a diagnosis of this arm in this motion would detect, and proposes a
/// motion that distinguishes two of them. The simulation uses the model alone, without the scenario's effects and
/// changed parameters.
void run_plan(const PlanCommandOptions& options);

}  // namespace halyard
