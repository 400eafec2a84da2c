#pragma once
/// Effects at a joint whose forces depend on one signal each, and on time. Their derivatives are few, so that filters
/// need not ask for those in all directions of the state (estimators/process/plain/effect_terms.h).

#include "transmission/effect.h"

namespace halyard {

enum class Signal { motor_angle, motor_rate, joint_position, joint_rate };

/// What an effect promises that derives from this class besides EffectOf. It has no states, and of its own joint
///
///   motor         it adds to s.motor_torque a function of one signal
///   joint         it adds to s.joint_force a function of one signal
///   stretch       it replaces s.stretch by a function b(x) of itself, and s.stretch_rate by the rate of b
///   cable force   it adds to both cable forces alike a function of s.stretch
///
/// It may act at several of these places. Each function may change in time. Those at motor and joint are
/// smooth, as friction is: near speed zero they change over the smoothing speeds of the joint. b may have kinks.
class OneSignalEffect {
 public:
  virtual ~OneSignalEffect() = default;
  /// On which signal the force at motor or joint depends.
  virtual Signal signal_at(EffectStage) const { return Signal::motor_rate; }
  /// True if b may have kinks.
  virtual bool has_kinks() const { return false; }
};

}  // namespace halyard
