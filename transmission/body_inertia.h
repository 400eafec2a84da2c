#pragma once
/// Whether six numbers are the inertia of a body.

#include <Eigen/Core>

#include "transmission/arm_parameters.h"

namespace halyard {

/// Principal moments of a link, kg m², ascending.
Eigen::Vector3d principal_moments(const JointParameters<double>& joint);

enum class InertiaFault {
  none,
  negative_moment,      ///< a principal moment is below 0
  triangle_inequality,  ///< a principal moment is above the sum of the other two, which no distribution of mass has
};
InertiaFault find_inertia_fault(const Eigen::Vector3d& principal_moments);

}  // namespace halyard
