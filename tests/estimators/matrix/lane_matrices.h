#pragma once
/// Matrices in lanes.

#include "estimators/matrix/lane_matrix.h"

namespace halyard {

inline LaneMatrix in_lanes(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  LaneMatrix lanes;
  lanes.set_zero(static_cast<int>(A.rows()), static_cast<int>(A.cols()));
  lanes.view() = A;
  return lanes;
}

}  // namespace halyard
