#pragma once
/// Whether six numbers are the inertia of a body.

#include <Eigen/Core>

#include "transmission/arm_parameters.h"

namespace halyard {

/// Principal moments of a link, kg m², ascending.
Eigen::Vector3d principal_moments(const JointParameters<double>& joint);

enum class Inertia {
  of_a_body,
  negative,  ///< a principal moment is below 0
  too_long,  ///< a principal moment is above the sum of the other two, which no distribution of mass has
};
Inertia judge_inertia(const Eigen::Vector3d& principal_moments);

}  // namespace halyard
