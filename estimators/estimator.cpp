#include "estimators/estimator.h"

#include <Eigen/Core>

namespace halyard {

double Innovation::nis() const {
  if (nu.size() == 0) return 0;
  return S_root.triangularView<Eigen::Lower>().solve(nu).squaredNorm();
}

}  // namespace halyard
