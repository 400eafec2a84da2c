#include "plant/integrators/step_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "tests/support/plant_states.h"

namespace halyard {
namespace {

TEST(StepMatrix, SolvesTheSystemOfAStep) {
  const ArmParameters<double> arm = nominal_raven2().nominal;
  ArmPlant plant(arm, {placed("hysteresis", arm, 1)}, Engine::halyard);
  const Eigen::Index size = plant.layout().size();
  StepMatrix matrix(plant.layout());
  std::mt19937_64 random(8);
  for (const double gamma_h : {1e-6, 2.5e-4, 1e-2}) {
    const Eigen::VectorXd y = random_state(plant, random), r = Eigen::VectorXd::Random(size);
    Eigen::VectorXd y_dot(size), g = r;
    Eigen::MatrixXd J(size, size);
    plant.jacobian(0, y.data(), y_dot.data(), J);
    matrix.factor(J, gamma_h);
    matrix.solve(g.data());
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(size, size) / gamma_h - J;
    // A backward stable solution: some ten roundings of |A| |g| in each row.
    const Eigen::VectorXd bound = 1e-14 * (A.cwiseAbs() * g.cwiseAbs() + r.cwiseAbs());
    EXPECT_TRUE(((A * g - r).array().abs() <= bound.array()).all()) << gamma_h;
  }
}

}  // namespace
}  // namespace halyard
