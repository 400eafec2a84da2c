#pragma once
/// All parameters in the equations of a cable-driven serial arm, over a scalar type T.
///
/// Joint k moves link k about (revolute) or along (prismatic) the z axis of its own frame. Units are SI; "rad | m"
/// means rad at a revolute and m at a prismatic joint. The motor's parameters refer to the motor shaft. (The paper's
/// Table I prints inertia and friction of the motors at the gearbox output. Its values are gear_ratio times the values
/// here.)

#include "transmission/scalar.h"

namespace halyard {

inline constexpr int kMaxJoints = 7;

enum class JointType { revolute, prismatic };

/// What moves a joint: an elastic cable from a motor, a rigid transmission from a motor (the cable
/// does not stretch), or nothing.
enum class Drive { cable, rigid, none };

/// How a cable's tension depends on its stretch; see cable_law.h.
enum class CableLaw { paper, exponential, linear };

/// What a log's motor torque is: the controller's command, or a reading of the torque at the shaft, or of the motor's
/// current. Between a reading and the rotor nothing can be limited.
enum class TorqueSource { commanded, measured };

template <class T>
struct JointParameters {
  JointType type = JointType::revolute;
  Drive drive = Drive::cable;
  CableLaw law = CableLaw::paper;

  // Rigid link. Joint frame at q = 0 in the parent's frame: x_parent = R x + p.
  double frame_R[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double frame_p[3] = {0, 0, 0};
  T mass = 0.0;                         ///< kg
  T com[3] = {T(0.0), T(0.0), T(0.0)};  ///< centre of mass, own frame, m
  /// Inertia about the centre of mass, own axes: xx, yy, zz, xy, xz, yz entries, kg m².
  T inertia[6] = {T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)};

  // Motor and gear.
  T rotor_inertia = 0.0;    ///< kg m²
  T motor_coulomb = 0.0;    ///< N m
  T motor_viscous = 0.0;    ///< N m s/rad
  T motor_smoothing = 0.5;  ///< v_s of tanh(v / v_s), rad/s
  T gear_ratio = 1.0;       ///< motor turns per capstan turn
  T capstan_radius = 1.0;   ///< r_m, m
  T torque_scale = 1.0;     ///< torque at the shaft per commanded torque
  T torque_bias = 0.0;      ///< N m, added after the scale
  TorqueSource torque_source = TorqueSource::commanded;

  // Cable.
  T pulley_radius = 1.0;  ///< r_l, m | 1
  /// coupling[j]: motion of this joint's cable per unit of motion of joint j, expressed as motion of this joint (C_ji
  /// of the paper). It is 1 if j is this joint.
  T coupling[kMaxJoints] = {T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)};
  T stiffness = 0.0;  ///< k_e of each run, N/m
  T damping = 0.0;    ///< b_e of each run, N s/m
  T tension = 0.0;    ///< T_0 of each run at rest, N

  // Joint friction.
  T joint_coulomb = 0.0;     ///< N m | N
  T joint_viscous = 0.0;     ///< N m s/rad | N s/m
  T joint_smoothing = 5e-3;  ///< v_s, rad/s | m/s

  // Sensors: reading = truth + offset + noise, rounded to the resolution (0: not rounded).
  T motor_encoder_offset = 0.0;         ///< rad
  T joint_encoder_offset = 0.0;         ///< rad | m
  double motor_encoder_resolution = 0;  ///< rad
  double joint_encoder_resolution = 0;  ///< rad | m
  double motor_encoder_noise = 0;       ///< standard deviation of white noise, rad
  double joint_encoder_noise = 0;       ///< rad | m
  /// False: the zero differs from log to log, as with an incremental encoder that counts from zero at power-on.
  bool motor_zero_known = true;
  bool joint_zero_known = true;

  // Sums over the effects `delay`, s. A model without effects has none.
  T command_delay = 0.0;
  T sensor_delay = 0.0;

  /// Cable travel per motor angle, r_m / N, m/rad.
  HALYARD_INLINE T motor_travel() const { return capstan_radius / gear_ratio; }
};

template <class T>
struct ArmParameters {
  int n = 0;                                  ///< joints, 1..kMaxJoints
  T gravity[3] = {T(-9.81), T(0.0), T(0.0)};  ///< in the base frame, m/s²
  double payload_point[3] = {0, 0, 0};        ///< in the last link's frame, m
  /// The base axis that is most nearly parallel to the model's gravity. gravity_tilt sets it, so that a second tilt is
  /// about the same axes; -1: not set.
  int vertical_axis = -1;
  JointParameters<T> joint[kMaxJoints];
};

/// The number of joints: arm.n, or `known` if the caller has checked that it is arm.n. A number that is known at
/// compile time lets the compiler unroll the loops over joints. Functions that have this parameter pass it on.
template <int known = 0, class T>
HALYARD_INLINE int joint_count(const ArmParameters<T>& arm) {
  static_assert(known <= kMaxJoints);
  return known > 0 ? known : arm.n;
}

/// The same arm over another scalar type, all lanes equal, all derivatives zero.
template <class T>
ArmParameters<T> lift(const ArmParameters<double>& arm);

/// Packs arms of the same structure into lanes: lane i holds arms[i]. arms: [kLaneWidth].
ArmParameters<Lanes> pack(const ArmParameters<double>* arms);

}  // namespace halyard
