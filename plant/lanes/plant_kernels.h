#pragma once
/// The equations of the plant, with their derivatives. There is one copy per instruction set
/// (transmission/lanes/instruction_set.h); results of two sets differ by rounding.
///
///   F = joint_force(y), z' = z_dot(y)       drive train
///   (M(q) + M_rotors) a + h(q, q') = F      rigid chain (model/rigid_chain.h)
///
/// The files plant_<set>.cpp instantiate the templates of this folder in an unnamed namespace, and all functions that
/// these call are forced inline: otherwise the linker could use a function compiled for a wider set where it cannot
/// run.

#include <vector>

#include "plant/lanes/drive_model.h"

namespace halyard {

struct PlantKernels {
  /// Sets joint_force [n] and z_dot [n_z].
  void (*rates)(const DriveModel& drive, DriveTerms terms, const PlantInstant& at, double* joint_force, double* z_dot);
  /// The same, and the slopes of both: rows joint_force and z_dot, columns q, v, z without the meters; column-major, a
  /// column begins `stride` after the one before.
  void (*slopes)(const DriveModel& drive, DriveTerms terms, const PlantInstant& at, double* joint_force, double* z_dot,
                 double* slopes, int stride);
  /// Signals of all joints [n], sensor errors included.
  void (*signals)(const DriveModel& drive, const PlantInstant& at, JointSignals<double>* s);

  /// Replaces the forces F [n] by the accelerations a.
  void (*accelerate)(const ArmParameters<double>& arm, const double* q, const double* v, double* force);
  /// The same; and the first n rows of `slopes` [columns], those of F, by those of a.
  void (*accelerate_with_slopes)(const ArmParameters<double>& arm, const double* q, const double* v, double* force,
                                 double* slopes, int stride, int columns);
};

/// The kernels that this processor can run, the widest first; the last is the generic one.
const std::vector<PlantKernels>& plant_kernels();

}  // namespace halyard
