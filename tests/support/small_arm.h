#pragma once
/// A model file that uses every element of the schema, and what reading a broken one says.

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "model/model_file.h"
#include "tests/support/message_of.h"

namespace halyard {

inline constexpr double kDegree = std::numbers::pi / 180;
inline const std::filesystem::path kExamples = std::filesystem::path(HALYARD_SOURCE_DIR) / "examples" / "raven2";

/// A small arm that uses every element of the schema; the tests break one line of it at a time.
inline const std::string kArm = R"(<arm name="small">
<gravity>0 0 -9.81</gravity>
<payload point="0 0 300 mm"/>
<tolerances length="0.02" coupling="0.03" torque_scale="0.01"/>
<joint name="swing" type="revolute" drive="cable">
<dh alpha="90 deg" a="0.2" theta="0.3" d="100 mm"/>
<link mass="0.5" com="0.1 0 0" inertia="1e-3 2e-3 2.5e-3 1e-4 0 0"/>
<motor inertia="2e-5" coulomb="5e-3" viscous="1e-5" smoothing="0.4" gear_ratio="12" capstan_radius="5.5 mm"/>
<cable law="exponential" stiffness="720e3" damping="4000" tension="51" pulley_radius="0.063"/>
<friction coulomb="0.5" viscous="0.005" smoothing="0.01"/>
<encoders motor_counts="4000" joint_resolution="0.01 deg" motor_offset="0.1" joint_offset="-1 deg"/>
<controller kp="0.02" kd="6e-4" torque_limit="0.11"/>
<range lower="-90 deg" upper="90 deg" home="10 deg"/>
<tolerances stiffness="0.3" com="2e-3" inertia="0.1" smoothing="0.5"/>
</joint>
<joint name="slide" type="prismatic" drive="rigid">
<frame xyz="0 0 0.1" rpy="10 20 30 deg"/>
<link mass="0.4" com="0 0 0" inertia="0 0 0 0 0 0"/>
<motor inertia="0" coulomb="0" viscous="0" gear_ratio="1" capstan_radius="1" torque_scale="1.1" torque_bias="-3"/>
<rigid pulley_radius="1"/>
<coupling joint="1" coefficient="0.0078"/>
<friction coulomb="20" viscous="200"/>
<range lower="0" upper="0.5" home="0.25"/>
</joint>
<joint name="wrist" type="revolute" drive="none">
<frame xyz="0 0 0" rpy="0 0 0"/>
<link mass="0.1" com="0.05 0 0" inertia="1e-4 1e-4 1e-4 0 0 0"/>
<friction coulomb="0" viscous="0.01"/>
<range lower="-1" upper="1" home="0"/>
</joint>
<effects>
<effect name="backlash" joint="1" half_gap="0.35 mm"/>
<effect name="payload"/>
</effects>
<columns>
<column name="motor_position_1" from="spindle &lt;deg&gt;" unit="deg" sign="-1" scale="2" offset="0.5" wrap="360"/>
</columns>
<estimator name="sr_ukf" alpha="1e-3" notes="as in the paper"/>
</arm>
)";

inline std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kArm;
  const auto at = text.find(from);
  if (at == text.npos || text.find(from, at + 1) != text.npos) {
    ADD_FAILURE() << "the test's own text does not have exactly once: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

inline std::string message_for(const std::string& xml) {
  return message_of([&] { parse_model(xml, "arm.xml"); });
}

}  // namespace halyard
