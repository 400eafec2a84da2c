#pragma once
/// Places where the arm stands still and where its equations are at their stiffest: unloaded, and with each cable
/// under the torque limit of its motor either way, at home and at the ends of the joints' ranges.

#include <Eigen/Core>
#include <vector>

#include "model/arm_model.h"
#include "transmission/transmission.h"

namespace halyard {

struct StandstillPose {
  Eigen::VectorXd motor_angle;     ///< [n] rad
  Eigen::VectorXd joint_position;  ///< [n] rad | m
};

/// Home, each joint at each end of its range, all at their lower and all at their upper ends; [n] each.
std::vector<Eigen::VectorXd> range_poses(const ArmModel& model);

/// Joint forces that hold the arm against gravity in pose q [n], N m | N.
Eigen::VectorXd gravity_force(const ArmParameters<double>& arm, const Eigen::VectorXd& q);

/// The largest force that gravity puts on each joint over its range [n], N m | N.
Eigen::VectorXd largest_gravity_force(const ArmParameters<double>& arm, const ArmModel& model);

/// A motor without torque limit is taken to load its cable with the rest tension and what gravity takes.
std::vector<StandstillPose> standstill_poses(const Transmission<double>& transmission, const ArmModel& model);

}  // namespace halyard
