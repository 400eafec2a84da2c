#include "model/statistics/distributions.h"

#include <gtest/gtest.h>

namespace halyard {
namespace {

TEST(Quantiles, AreThoseOfTheTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.95996, 5e-6);
  EXPECT_NEAR(chi_square_quantile(10, 0.95), 18.3070, 5e-5);
  EXPECT_NEAR(t_quantile(10, 0.025), 2.2281, 5e-5);
  EXPECT_NEAR(t_quantile(1, 0.05), 6.3138, 5e-5);
}

TEST(Quantiles, OfTheBetaDistributionFollowAClosedForm) {
  // P(X > x) = (1 - x)^b for a = 1.
  EXPECT_NEAR(beta_quantile(1, 3, 0.001), 0.9, 1e-12);
}

TEST(Quantiles, StudentsTailReturnsTheLevelOfItsQuantile) {
  EXPECT_NEAR(t_upper_tail(7, t_quantile(7, 0.01)), 0.01, 1e-12);
}

}  // namespace
}  // namespace halyard
