#pragma once
/// How an arm comes to the start of a record. What happened before is not known. From what the motors do at the first
/// sample the most plausible past follows:
///
///   let down   the arm is integrated from unstretched cables with the motors held (dynamic relaxation with kinetic
///              damping): its speed is set to zero at intervals that grow, so that it comes to rest without a swing.
///              What the cables remember of loading (hysteresis, slack, a dead zone) is then as after a slow start
///   run in     of a record that starts in motion (start_of_motion.h), as after a hole of a log: for kRunIn with the
///              accelerations that the motors have at the first sample, the joints as fast as they. Stretches,
///              frictions and loops are then those of this motion
///
/// The pasts of a hypothesis' effects add to the states that this gives.

#include <Eigen/Core>

#include "diagnosis/motion/chebyshev.h"
#include "diagnosis/motion/motion_kernel.h"
#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Where the motors are held as the arm is let down. first: the record's first sample.
DrivenInput held_before(const Record& record, const DrivenInput& first);

/// How the joints move at the first sample if they follow the motors and no cable stretches; empty: at rest.
struct UnstretchedMotion {
  Eigen::VectorXd rate, acceleration;  ///< [n]
};
UnstretchedMotion unstretched_motion(const Hypothesis& h, const StartOfMotion& motion);

/// Takes x from unstretched cables with the motors held to the start of the record. rate, acceleration: of the joints
/// at the first sample, [n], if the record starts in motion.
void bring_to_start(const Transmission<Lanes>& transmission, const RungeKuttaChebyshev& scheme, const Record& record,
                    const DrivenInput& first, const CommandHistory& history, const Lanes* rate,
                    const Lanes* acceleration, DrivenState<Lanes>& x);

}  // namespace halyard
