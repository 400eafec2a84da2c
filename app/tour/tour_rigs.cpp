#include "app/tour/tour_rigs.h"

#include <algorithm>

namespace halyard {

const std::vector<Rig>& measured_rigs() {
  static const std::vector<Rig> rigs = {
      {"raven2_motor_log", "RAVEN-II, joints 1 to 3", "raven2_motor_log", "raven2.xml", {"run_joints123.csv"}, ""},
      {"davinci_tool",
       "da Vinci Si tool, jaw",
       "davinci_tool",
       "davinci_tool.xml",
       {"run_L4_00.csv", "run_L4_05.csv"},
       "run_L4_25.csv"},
      {"kuka_kr300_axis1", "KUKA KR300, axis 1", "kuka_kr300", "axis1.xml", {"traj_A_axis1.csv"}, "traj_B_axis1.csv"},
      {"kuka_kr300_axis2", "KUKA KR300, axis 2", "kuka_kr300", "axis2.xml", {"traj_A_axis2.csv"}, "traj_B_axis2.csv"},
      {"kuka_kr300_axis3", "KUKA KR300, axis 3", "kuka_kr300", "axis3.xml", {"traj_A_axis3.csv"}, "traj_B_axis3.csv"},
      {"emps", "EMPS, ball-screw axis", "emps", "emps.xml", {"data_emps.csv"}, "data_emps_pulses.csv"},
  };
  return rigs;
}

bool is_at_hand(const Rig& rig, const std::filesystem::path& recordings) {
  const auto exists = [&](const std::string& file) {
    std::error_code error;
    return std::filesystem::exists(recordings / rig.folder / file, error);
  };
  return std::ranges::all_of(rig.training, exists) && (rig.holdout.empty() || exists(rig.holdout));
}

}  // namespace halyard
