/// effect_table.tsv lists the sizes and bounds of all effects for an arm of round numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "transmission/effects/library.h"

namespace halyard {
namespace {

JointParameters<double> joint_of_round_numbers(JointType type, Drive drive) {
  JointParameters<double> j;
  j.type = type;
  j.drive = drive;
  j.mass = 2;
  j.com[2] = 0.1;
  j.rotor_inertia = 1e-5;
  j.motor_coulomb = 1e-2;
  j.motor_viscous = 1e-4;
  j.motor_smoothing = 0.2;
  j.gear_ratio = 10;
  j.capstan_radius = 0.01;
  j.pulley_radius = type == JointType::revolute ? 0.05 : 1;
  j.stiffness = 1e4;
  j.damping = 100;
  j.tension = 20;
  j.joint_coulomb = 0.3;
  j.joint_viscous = 0.03;
  return j;
}

ArmParameters<double> arm_of_round_numbers() {
  ArmParameters<double> arm;
  arm.n = 4;
  arm.joint[0] = joint_of_round_numbers(JointType::revolute, Drive::cable);
  arm.joint[1] = joint_of_round_numbers(JointType::prismatic, Drive::cable);
  arm.joint[2] = joint_of_round_numbers(JointType::revolute, Drive::rigid);
  arm.joint[3] = joint_of_round_numbers(JointType::revolute, Drive::none);
  for (int k = 0; k < arm.n; ++k) arm.joint[k].coupling[k] = 1;
  return arm;
}

/// A line for each parameter of each built-in effect at each place.
std::vector<std::string> table_of(const ArmParameters<double>& arm) {
  std::vector<std::string> lines = {"effect\tjoint\tparameter\tunit\tneutral\ttypical\tlower\tupper"};
  for (const auto& effect : built_in_effects())
    for (const EffectPlace joint : effect_places(*effect, arm))
      for (const EffectParameter& p : effect->parameters(arm, joint)) {
        std::ostringstream line;
        line << effect->name() << '\t' << (joint ? std::to_string(*joint + 1) : "arm") << '\t' << p.name << '\t'
             << p.unit;
        for (const double value : {p.neutral, p.typical, p.lower, p.upper}) line << '\t' << value;
        lines.push_back(line.str());
      }
  return lines;
}

TEST(EffectTable, ListsTheSizesAndBoundsOfAllEffects) {
  std::ifstream file(std::string(HALYARD_SOURCE_DIR) + "/tests/transmission/effect_table.tsv");
  std::vector<std::string> listed;
  for (std::string line; std::getline(file, line);) listed.push_back(line);
  const std::vector<std::string> lines = table_of(arm_of_round_numbers());
  if (listed == lines) return;
  const std::string present = testing::TempDir() + "effect_table.tsv";
  std::ofstream out(present);
  for (const std::string& line : lines) out << line << '\n';
  const auto [in_list, in_library] = std::mismatch(listed.begin(), listed.end(), lines.begin(), lines.end());
  FAIL() << "line " << in_list - listed.begin() + 1 << "\n  listed:  " << (in_list != listed.end() ? *in_list : "")
         << "\n  library: " << (in_library != lines.end() ? *in_library : "")
         << "\nIf this is meant, replace the table by " << present;
}

}  // namespace
}  // namespace halyard
