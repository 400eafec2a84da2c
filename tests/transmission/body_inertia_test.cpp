#include "transmission/body_inertia.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/limits.h"

namespace halyard {
namespace {

/// inertia: xx, yy, zz, xy, xz, yz.
Eigen::Vector3d moments_of(const std::array<double, 6>& inertia) {
  JointParameters<double> joint;
  std::ranges::copy(inertia, joint.inertia);
  return principal_moments(joint);
}

TEST(PrincipalMoments, DoNotDependOnTheAxes) {
  // Moments 2, 3, 4 about the axes z, (x + y) / sqrt(2), (x - y) / sqrt(2).
  const Eigen::Vector3d about_z = moments_of({3.5, 3.5, 2, -0.5, 0, 0});
  // The same body with its axes renamed: x, y, z become y, z, x, and z, x, y.
  const Eigen::Vector3d about_x = moments_of({2, 3.5, 3.5, 0, 0, -0.5}),
                        about_y = moments_of({3.5, 2, 3.5, 0, -0.5, 0});
  for (int i = 0; i < 3; ++i)
    for (const Eigen::Vector3d& moments : {about_x, about_y, about_z}) EXPECT_NEAR(moments(i), 2 + i, 32 * kEps);
}

TEST(Inertia, OfABodyFulfilsTheTriangleInequality) {
  EXPECT_EQ(find_inertia_fault({1, 2, 3}), InertiaFault::none);  // a plate
  EXPECT_EQ(find_inertia_fault({1, 2, 3.1}), InertiaFault::triangle_inequality);
  EXPECT_EQ(find_inertia_fault({-0.1, 2, 2}), InertiaFault::negative_moment);
  EXPECT_EQ(find_inertia_fault({0, 0, 0}), InertiaFault::none);  // a point
}

TEST(Inertia, IsJudgedAlikeInEveryUnitAndForgivesRounding) {
  constexpr double kRounding = 1e-12;  // of moments of the order of 1
  for (const double unit : {1e-9, 1.0, 1e9}) {
    EXPECT_EQ(find_inertia_fault(unit * Eigen::Vector3d(1, 2, 3 + kRounding)), InertiaFault::none) << unit;
    EXPECT_EQ(find_inertia_fault(unit * Eigen::Vector3d(-kRounding, 2, 2)), InertiaFault::none) << unit;
    EXPECT_EQ(find_inertia_fault(unit * Eigen::Vector3d(1, 2, 3.1)), InertiaFault::triangle_inequality) << unit;
    EXPECT_EQ(find_inertia_fault(unit * Eigen::Vector3d(-0.1, 2, 2)), InertiaFault::negative_moment) << unit;
  }
}

}  // namespace
}  // namespace halyard
