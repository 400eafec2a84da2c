#include "transmission/body_inertia.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/limits.h"

namespace halyard {
namespace {

TEST(PrincipalMoments, DoNotDependOnTheAxes) {
  JointParameters<double> joint;
  // Moments 2, 3, 4 about the axes z, (x + y) / sqrt(2), (x - y) / sqrt(2).
  const double tensor[] = {3.5, 3.5, 2, -0.5, 0, 0};
  std::copy(std::begin(tensor), std::end(tensor), joint.inertia);
  const Eigen::Vector3d about_z = principal_moments(joint);
  // The same body with its axes renamed: x, y, z become y, z, x, and z, x, y.
  const double once[] = {2, 3.5, 3.5, 0, 0, -0.5}, twice[] = {3.5, 2, 3.5, 0, -0.5, 0};
  std::copy(std::begin(once), std::end(once), joint.inertia);
  const Eigen::Vector3d about_x = principal_moments(joint);
  std::copy(std::begin(twice), std::end(twice), joint.inertia);
  const Eigen::Vector3d about_y = principal_moments(joint);
  for (int i = 0; i < 3; ++i)
    for (const Eigen::Vector3d& moments : {about_x, about_y, about_z}) EXPECT_NEAR(moments(i), 2 + i, 32 * kEps);
}

TEST(Inertia, OfABodyFulfilsTheTriangleInequality) {
  EXPECT_EQ(judge_inertia({1, 2, 3}), Inertia::of_a_body);  // a plate
  EXPECT_EQ(judge_inertia({1, 2, 3.1}), Inertia::too_long);
  EXPECT_EQ(judge_inertia({-0.1, 2, 2}), Inertia::negative);
  EXPECT_EQ(judge_inertia({0, 0, 0}), Inertia::of_a_body);  // a point
}

}  // namespace
}  // namespace halyard
