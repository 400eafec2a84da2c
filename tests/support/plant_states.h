#pragma once
/// States of the simulated arm for tests of the plant.

#include <Eigen/Core>
#include <random>
#include <string>

#include "model/model_file.h"
#include "plant/arm_plant.h"

namespace halyard {

inline ArmModel nominal_raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

inline PlacedEffect placed(const std::string& name, const ArmParameters<double>& arm, EffectPlace joint) {
  return place_effect(*find_effect(name), arm, joint);
}

/// Any state with cables that are stretched by about a millimetre.
inline Eigen::VectorXd random_state(const ArmPlant& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const PlantLayout& l = plant.layout();
  const ArmParameters<double>& arm = plant.drive().arm();
  Eigen::VectorXd y(l.size()), q(l.n), path(l.n);
  for (int i = 0; i < l.size(); ++i) y(i) = unit(random);
  if (l.n > 2) y(2) = 0.4 + 0.1 * y(2);
  cable_path(arm, y.data(), path.data());
  for (int k = 0; k < l.n; ++k) {  // a millimetre of stretch, motors at speed
    if (!l.motor_angle[k]) continue;
    y(2 * l.n + *l.motor_angle[k]) = (path(k) + 1e-3 * unit(random)) / arm.joint[k].motor_travel();
    y(2 * l.n + *l.motor_rate[k]) = 30 * unit(random);
  }
  for (int i = 0; i < l.n_effect_states; ++i) y(2 * l.n + l.effect_states + i) *= 1e-4;
  return y;
}

}  // namespace halyard
