#include "diagnosis/prediction/motion_key.h"

#include "diagnosis/prediction/shared_lanes.h"
#include "transmission/arm_fields.h"

namespace halyard {

std::vector<double> motion_key(const Hypothesis& h, const Record& record) {
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  std::vector<double> key = past_states(h, record);
  const auto append = [&](const auto& entry) { key.push_back(static_cast<double>(entry)); };
  for_each_arm_field([&](const ArmField&, const auto& value) { for_each_entry(append, value); }, arm);
  for (int k = 0; k < arm.n; ++k) {
    const auto append_if_it_moves = [&](const ArmField& field, const auto& value) {
      // A joint without a motor moves as its own sensor says.
      const bool of_moving_sensor = field.influence == Influence::sensor_reading && arm.joint[k].drive == Drive::none;
      if (field.influence == Influence::motion || of_moving_sensor) for_each_entry(append, value);
    };
    for_each_joint_field(append_if_it_moves, arm.joint[k]);
  }
  constexpr unsigned kMotor = static_cast<unsigned>(EffectStage::command) | static_cast<unsigned>(EffectStage::motor);
  for (const PlacedEffect& e : h.effects)
    if ((e.effect->stages() & ~kMotor) != 0 || e.effect->n_states() > 0)
      key.insert(key.end(), e.p, e.p + kMaxEffectParameters);
  return key;
}

}  // namespace halyard
