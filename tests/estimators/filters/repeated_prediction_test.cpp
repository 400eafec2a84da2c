/// A prediction that is kept as a linear map, and repeated from other beliefs.

#include <gtest/gtest.h>

#include "estimators/filters/ekf.h"
#include "estimators/filters/sr_ukf.h"
#include "tests/support/linear_gaussian.h"

namespace halyard {
namespace {

TEST(RepeatedPrediction, IsTheKalmanFiltersFromAnyBelief) {
  const LinearGaussian p(1);
  ExtendedKalmanFilter ekf;
  SquareRootUkf wide({.alpha = 1});
  for (GaussianFilter* filter : {static_cast<GaussianFilter*>(&ekf), static_cast<GaussianFilter*>(&wide)}) {
    filter->reset(p.x_0, initial_root());
    filter->predict(LinearProcess(p.F), p.Q_root);
    LinearPrediction prediction;
    filter->record(LinearProcess(p.F), p.x_0, prediction);
    const Eigen::Vector4d elsewhere(-3, 2, 0.5, 7);
    Eigen::Matrix4d root;
    root << 2, 0, 0, 0, 0.3, 1, 0, 0, -0.2, 0.1, 3, 0, 0.4, -0.6, 0.2, 0.5;
    for (const auto& [x, S] : {std::pair<Eigen::VectorXd, Eigen::MatrixXd>(p.x_0, initial_root()), {elsewhere, root}}) {
      filter->reset(x, S);
      filter->predict_again(prediction);
      const Eigen::MatrixXd P = p.F * S * S.transpose() * p.F.transpose() + p.Q_root * p.Q_root.transpose();
      // Ten roundings of numbers up to 10.
      EXPECT_LT((filter->x() - p.F * x).norm(), 1e-13);
      EXPECT_LT((filter->S() * filter->S().transpose() - P).norm(), 1e-13);
    }
  }
}

}  // namespace
}  // namespace halyard
