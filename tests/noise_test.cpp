/// Process and measurement noise of the filters.

#include "estimators/noise.h"

#include <gtest/gtest.h>

#include "estimators/built_in.h"
#include "tests/arm_runs.h"

namespace halyard {
namespace {

NoiseLevels levels_of(const ArmModel& model, const ProcessModel& process, const EstimatorOptions& options = {}) {
  OptionReader reader("the test", options);
  return read_noise(reader, model, process);
}

/// Moving at a speed at which no friction is near its reversal.
Eigen::VectorXd moving(const ArmModel& model, const ProcessModel& process) {
  const Eigen::VectorXd q = model.home(), v = Eigen::Vector3d(0.5, -0.5, 0.05);
  const Eigen::VectorXd angle = unstretched_motors(process.arm(), q), rate = unstretched_motors(process.arm(), v);
  Eigen::VectorXd x = process.state_at_rest(angle, q);
  for (int k = 0; k < 3; ++k) {
    x(process.layout().rate[k]) = v(k);
    x(process.layout().motor_rate[k]) = rate(k);
  }
  return x;
}

TEST(ProcessNoise, IsWhatAForceHeldOverTheStepDoes) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const NoiseLevels levels = levels_of(model, process);
  const double dt = 1e-3, held = std::sqrt(2 * levels.correlation_time / dt);
  const Eigen::VectorXd x = moving(model, process);
  ArmNoise noise(model, process, levels);
  const Eigen::MatrixXd Q_root = noise.process_root({0, dt}, x);
  for (int source = 0; source < 6; ++source) {
    Eigen::VectorXd torque = Eigen::VectorXd::Zero(3), force = Eigen::VectorXd::Zero(3);
    Eigen::VectorXd free = x, forced = x;
    process.advance({0, dt, torque.data(), force.data()}, free.data());
    (source < 3 ? torque(source) : force(source - 3)) =
        held * (source < 3 ? levels.torque(source) : levels.joint_force(source - 3));
    process.advance({0, dt, torque.data(), force.data()}, forced.data());
    const Eigen::VectorXd moved = forced - free;
    EXPECT_LT((Q_root.col(source) - moved).norm(), 0.02 * moved.norm()) << "source " << source;
    // The joint's own displacement by it, which the stiff damper of joint 3 halves.
    const int position = process.layout().position[source % 3];
    if (source >= 3) {
      EXPECT_NEAR(Q_root(position, source) / moved(position), 1, 0.02) << "source " << source;
    }
  }
}

TEST(ProcessNoise, OfTwoHalfStepsIsThatOfOne) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  ArmNoise noise(model, process, levels_of(model, process));
  const Eigen::VectorXd x = moving(model, process);
  const Eigen::MatrixXd whole = noise.process_root({0, 2e-4}, x), half = noise.process_root({0, 1e-4}, x);
  Eigen::MatrixXd F(12, 12);
  Eigen::VectorXd middle = x;
  const Eigen::VectorXd torque = Eigen::VectorXd::Zero(3);
  process.advance_with_jacobian({0, 1e-4, torque.data()}, middle.data(), F);
  const Eigen::MatrixXd Q = whole * whole.transpose();
  const Eigen::MatrixXd two = F * half * half.transpose() * F.transpose() + half * half.transpose();
  for (const auto& rates : {process.layout().rate, process.layout().motor_rate})
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(two(rates[k], rates[k]) / Q(rates[k], rates[k]), 1, 0.02);
}

/// Mean of νᵀS⁻¹ν per motor from 0.5 s on.
double mean_nis(Estimator& estimator, const ArmRun& run) {
  estimator.reset(run.samples[0]);
  double sum = 0, count = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const Innovation innovation = estimator.update(run.samples[i]);
    if (run.samples[i].time_s >= 0.5) sum += innovation.nis() / 3, count += 1;
  }
  return sum / count;
}

TEST(ProcessNoise, AdaptsToAModelThatIsWrong) {
  const ArmRun run = run_arm(raven2(), 3);
  ArmModel wrong = raven2();
  for (JointParameters<double>& j : wrong.nominal.joint) j.motor_coulomb *= 0.7;
  const auto fixed = make_ekf(wrong, {}), adapting = make_ekf(wrong, {{"adaptation_time", "0.2"}});
  EXPECT_GT(mean_nis(*fixed, run), 1.5);
  EXPECT_NEAR(mean_nis(*adapting, run), 1, 0.3);
  const double again = mean_nis(*adapting, run);
  EXPECT_EQ(mean_nis(*adapting, run), again);   // reset forgets
}

}  // namespace
}  // namespace halyard
