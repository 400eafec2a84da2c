#pragma once
/// Inside plant/: the only header that includes Simbody. Include it from files that are compiled as C++17 and with
/// -UNDEBUG; plant/CMakeLists.txt lists these files, docs/architecture.md gives the reason.

#include <Simbody.h>

#include <Eigen/Core>

#include "plant/drive_train.h"

namespace halyard {

/// The chain as a Simbody System whose State holds all of y: q, u, and z as auxiliary variables.
struct SimbodyArm {
  SimbodyArm(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects);

  /// Copies y into the state. Realized results stay valid if nothing changed.
  void set_state(double time_s, const double* y);
  /// M + M_rotors at the state's q.
  const Eigen::MatrixXd& total_mass(const SimTK::State& s) const;

  DriveTrain drive;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::Gravity gravity;
  SimTK::State state;

 private:
  mutable SimTK::Matrix M_;
  mutable Eigen::MatrixXd total_;
};

}  // namespace halyard
