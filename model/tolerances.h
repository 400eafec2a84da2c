#pragma once
/// Accuracy of the parameters of one joint in a model.

namespace halyard {

/// Expected relative deviations from the model's values; 1: nothing is known.
struct Tolerances {
  double length = 0.005;    ///< radii, ratios, lengths
  double mass = 0.05;       ///< masses and inertias, including those of rotors
  double stiffness = 0.10;  ///< stiffness and damping of cables
  double friction = 0.20;   ///< Coulomb and viscous
  double coupling = 0.02;
  /// scale of a motor's torque; use 1 if the log's torque is a current or a voltage of unknown scale
  double torque_scale = 0.005;
};

}  // namespace halyard
