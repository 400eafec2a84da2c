#pragma once
/// Accuracy of the parameters of one joint in a model.

namespace halyard {

/// Expected deviations relative to the model's values. 1 means that nothing is known; 0 means that the number is exact.
struct Tolerances {
  double length = 0.005;  ///< radii, ratios, lengths
  double mass = 0.05;     ///< masses of links, inertias of rotors
  /// coordinates of centres of mass, relative to the rms distance of the link's mass from its joint
  double com = 0.005;
  double inertia = 0.05;    ///< inertias of links: one factor for all moments of a link
  double stiffness = 0.10;  ///< stiffness and damping of cables
  double friction = 0.20;   ///< Coulomb and viscous
  double smoothing = 0;     ///< smoothing speeds of friction
  double coupling = 0.02;
  /// scale of a motor's torque; use 1 if the log's torque is a current or a voltage of unknown scale
  double torque_scale = 0.005;
};

/// Calls visit(name, member) for each, named and in the order as in a model file.
template <class Visit>
void for_each_tolerance(const Visit& visit) {
  visit("length", &Tolerances::length);
  visit("mass", &Tolerances::mass);
  visit("com", &Tolerances::com);
  visit("inertia", &Tolerances::inertia);
  visit("stiffness", &Tolerances::stiffness);
  visit("friction", &Tolerances::friction);
  visit("smoothing", &Tolerances::smoothing);
  visit("coupling", &Tolerances::coupling);
  visit("torque_scale", &Tolerances::torque_scale);
}

}  // namespace halyard
