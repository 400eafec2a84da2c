/// The kernels of plant_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each plant_<set>.cpp includes it exactly once.

#include "plant/lanes/chain_body.h"
#include "plant/lanes/drive_body.h"
#include "plant/lanes/plain_drive.h"
#include "plant/lanes/plant_kernels.h"

namespace halyard {
namespace {

/// Calls f<n>() for arms of three joints, those of the RAVEN-II, where the compiler then unrolls the loops over joints,
/// and f<0>() for others, to save compile time. See joint_count().
template <class F>
HALYARD_INLINE void with_known_joints(const ArmParameters<double>& arm, const F& f) {
  if (arm.n == 3) f.template operator()<3>();
  else f.template operator()<0>();
}

bool takes_plain(const DriveModel& drive, DriveTerms terms) { return drive.plain && terms == DriveTerms::all; }

void rates(const DriveModel& drive, DriveTerms terms, const PlantInstant& at, double* joint_force, double* z_dot) {
  with_known_joints(
      drive.transmission.arm(), [&]<int known>() __attribute__((always_inline)) {
        if (takes_plain(drive, terms)) plain_rates<known>(drive, at, joint_force, z_dot);
        else term_rates<known>(drive, terms, DriveState<double>{at.time, at.q, at.v, at.z}, joint_force, z_dot);
      });
}

void slopes(const DriveModel& drive, DriveTerms terms, const PlantInstant& at, double* joint_force, double* z_dot,
            double* slopes, int stride) {
  with_known_joints(
      drive.transmission.arm(), [&]<int known>() __attribute__((always_inline)) {
        if (takes_plain(drive, terms)) plain_slopes<known>(drive, at, joint_force, z_dot, slopes, stride);
        else term_slopes<known>(drive, terms, at, joint_force, z_dot, slopes, stride);
      });
}

void signals(const DriveModel& drive, const PlantInstant& at, JointSignals<double>* s) {
  with_known_joints(
      drive.transmission.arm(), [&]<int known>() __attribute__((always_inline)) {
        double shaft_torque[kMaxJoints], effect_rate[kMaxAuxiliaryStates];
        evaluate_drive<known>(drive, DriveState<double>{at.time, at.q, at.v, at.z}, s, shaft_torque, effect_rate);
        drive.transmission.sensor_errors<known>(at.time, at.z + drive.layout.effect_states, s);
      });
}

void accelerate(const ArmParameters<double>& arm, const double* q, const double* v, double* force) {
  with_known_joints(
      arm, [&]<int known>() __attribute__((always_inline)) {
        double M[kMaxJoints][kMaxJoints];
        factor_and_accelerate<known>(arm, q, v, force, M);
      });
}

void accelerate_with_slopes(const ArmParameters<double>& arm, const double* q, const double* v, double* force,
                            double* slopes, int stride, int columns) {
  with_known_joints(
      arm, [&]<int known>() __attribute__((always_inline)) {
        accelerate_with_slopes_of<known>(arm, q, v, force, slopes, stride, columns);
      });
}

constexpr PlantKernels own_kernels() { return {rates, slopes, signals, accelerate, accelerate_with_slopes}; }

}  // namespace
}  // namespace halyard
