#pragma once

#include <filesystem>
#include <string>

namespace halyard {

struct PlanCommandOptions {
  std::filesystem::path model, scenario;
  std::string separate;       ///< "EFFECT@JOINT,EFFECT@JOINT"; empty: no motion is proposed
  bool joint_sensor = true;   ///< false: the joints will have no sensor
  std::filesystem::path out;  ///< folder of plan.html, plan.json and scenario.xml; empty: none
};

/// halyard diagnose --plan: which effects a diagnosis of this arm in this motion would detect, and a motion that tells
/// two of them apart. The simulation uses the model alone, without the scenario's effects and changed parameters.
void run_plan(const PlanCommandOptions& options);

}  // namespace halyard
