#include "diagnosis/prediction/motion_key.h"

#include <algorithm>

#include "diagnosis/prediction/shared_lanes.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

constexpr unsigned kMotor = static_cast<unsigned>(EffectStage::command) | static_cast<unsigned>(EffectStage::motor);

bool acts_beyond_the_motor(const PlacedEffect& e) { return (e.effect->stages() & ~kMotor) != 0; }

/// True if states that may follow the torque of a motor act elsewhere, too.
bool moves_the_joint_by_torque(const PlacedEffect& e) {
  return e.effect->n_states() > 0 && (e.effect->stages() & kMotor) != 0 && acts_beyond_the_motor(e);
}

}  // namespace

std::vector<double> motion_key(const Hypothesis& h, const Record& record) {
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  std::vector<double> key = past_states(h, record);
  const bool with_torques = std::ranges::any_of(h.effects, moves_the_joint_by_torque);
  const auto append = [&](const auto& entry) { key.push_back(static_cast<double>(entry)); };
  for_each_arm_field([&](const ArmField&, const auto& value) { for_each_entry(append, value); }, arm);
  for (int k = 0; k < arm.n; ++k) {
    const auto append_if_it_moves = [&](const ArmField& field, const auto& value) {
      // A joint without a motor moves as its own sensor says.
      const bool of_moving_sensor = field.influence == Influence::sensor_reading && arm.joint[k].drive == Drive::none;
      if (with_torques || field.influence == Influence::motion || of_moving_sensor) for_each_entry(append, value);
    };
    for_each_joint_field(append_if_it_moves, arm.joint[k]);
  }
  for (const PlacedEffect& e : h.effects)
    if (with_torques || acts_beyond_the_motor(e) || e.effect->n_states() > 0)
      key.insert(key.end(), e.p, e.p + kMaxEffectParameters);
  return key;
}

}  // namespace halyard
