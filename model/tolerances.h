#pragma once
/// How well a model knows the numbers of one joint.

namespace halyard {

/// Relative deviations from the stated numbers that are to be expected; 1: nothing is known.
struct Tolerances {
  double length = 0.005;    ///< radii, ratios, lengths
  double mass = 0.05;       ///< masses and inertias, of rotors too
  double stiffness = 0.10;  ///< stiffness and damping of cables
  double friction = 0.20;   ///< Coulomb and viscous
  double coupling = 0.02;
  double torque_scale = 0.005;  ///< of a motor: 1 where a log's torque is a current or a voltage of unknown scale
};

}  // namespace halyard
