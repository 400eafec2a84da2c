#include "diagnosis/rehearsal/motion_range.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "transmission/coupling.h"

namespace halyard {

MotionRange motion_range(const std::vector<Record>& records, const ArmParameters<double>& arm) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  MotionRange range{{records.front().start, records.back().time(records.back().size - 1)},
                    std::vector<MotionRange::Range>(arm.n, {kInfinite, -kInfinite}),
                    std::vector<double>(arm.n, 0)};
  const UnstretchedJoints joints(arm);
  Eigen::VectorXd offset(arm.n), of_motors(arm.n), q(arm.n);
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    offset(k) = j.drive == Drive::none ? j.joint_encoder_offset : j.motor_encoder_offset;
  }
  for (const Record& r : records)
    for (std::size_t i = 0; i < r.size; ++i) {
      for (int k = 0; k < arm.n; ++k) of_motors(k) = r.motor_angle[k][i] - offset(k);
      joints.solve(of_motors, of_motors, q);
      for (int k = 0; k < arm.n; ++k)
        range.joint[k] = {std::min(range.joint[k].from, q(k)), std::max(range.joint[k].to, q(k))};
      for (int k = 0; k < arm.n; ++k) of_motors(k) = r.motor_rate[k][i];
      joints.solve(of_motors, of_motors, q);
      for (int k = 0; k < arm.n; ++k) range.fastest[k] = std::max(range.fastest[k], std::abs(q(k)));
    }
  return range;
}

}  // namespace halyard
