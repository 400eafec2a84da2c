#pragma once
/// Standstill poses at which the arm's equations are stiffest: at home and at the ends of the joints' ranges, unloaded
/// and with each cable under its motor's torque limit in either direction.

#include <Eigen/Core>
#include <vector>

#include "model/arm_model.h"
#include "transmission/transmission.h"

namespace halyard {

struct StandstillPose {
  Eigen::VectorXd motor_angle;     ///< [n] rad
  Eigen::VectorXd joint_position;  ///< [n] rad | m
};

/// Home, each joint alone at each end of its range, all joints at their lower ends, and all at their upper ends; [n].
std::vector<Eigen::VectorXd> range_poses(const ArmModel& model);

/// Joint forces that hold the arm against gravity in pose q [n], N m | N.
Eigen::VectorXd gravity_force(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

/// The largest force that gravity puts on each joint over its range [n], N m | N.
Eigen::VectorXd largest_gravity_force(const ArmParameters<double>& arm, const ArmModel& model);

/// The poses above. A motor without torque limit is assumed to load its cable with the rest tension and gravity.
std::vector<StandstillPose> standstill_poses(const Transmission<double>& transmission, const ArmModel& model);

}  // namespace halyard
