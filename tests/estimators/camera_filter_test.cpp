// A camera at the tool: what a simulated one writes, and what a filter makes of it.
#include "estimators/filters/camera_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimators/built_in.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/log_sample.h"
#include "model/input_error.h"
#include "plant/arm_plant.h"
#include "plant/simulate.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

Eigen::Vector3d marker_at(const ArmModel& model, const Eigen::VectorXd& q) {
  Eigen::Vector3d z;
  position_of(model.nominal, chain_pose(model.nominal, q.data()), model.nominal.payload_point, z.data());
  return z;
}

/// The RAVEN-II on slow sines under a camera.
Scenario scenario(double duration_s, const Camera& camera) {
  Scenario s;
  s.robot = raven2();
  s.assumed = s.robot;
  s.duration_s = duration_s;
  s.fade_in_s = 0.5;
  for (int k = 0; k < 3; ++k) {
    JointTrajectory t;
    t.kind = JointTrajectory::Kind::sines;
    t.center = s.robot.home()(k);
    t.sines = {{k < 2 ? 0.3 : 0.03, 0.3 + 0.05 * k, 0}};
    s.trajectory.push_back(t);
  }
  s.camera = camera;
  return s;
}

Eigen::Vector3d joints_at(const Log& log, std::size_t i) {
  return {log.joint_position[0][i], log.joint_position[1][i], log.joint_position[2][i]};
}

/// RMS errors of the joints from 1 s on.
Eigen::Vector3d errors(Estimator& estimator, const SimulationResult& simulated, bool with_marker = true) {
  const Log& log = simulated.measured;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    Sample s = sample_of(log, i);
    if (!with_marker) s.marker.resize(0);
    if (i == 0) estimator.reset(s);
    else estimator.update(s);
    if (log.time[i] < 1) continue;
    sum += (estimator.estimate().joint_position - joints_at(simulated.truth, i)).cwiseAbs2();
    ++count;
  }
  return (sum / count).cwiseSqrt();
}

TEST(Camera, SeesThePointOfTheLastLinkWhereSimbodyHasIt) {
  const ArmModel model = raven2();
  ArmPlant plant(model.nominal);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d q(3 * any(random), 3 * any(random), any(random));
    EXPECT_LT((plant.position_of(model.nominal.payload_point, q) - marker_at(model, q)).norm(), 1e-14);
  }
}

TEST(Camera, WritesFramesAtItsRateOfWhatWasALatencyAgo) {
  const Scenario s = scenario(2, {.rate_hz = 25, .latency_s = 0.0405, .noise_m = 0, .dropout = 0});
  const SimulationResult result = simulate(s);
  int frames = 0;
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    if (std::isnan(result.measured.marker[0][i])) continue;
    EXPECT_EQ(i % 40, 0u);
    ++frames;
    const Eigen::Vector3d seen(result.measured.marker[0][i], result.measured.marker[1][i],
                               result.measured.marker[2][i]);
    const Eigen::Vector3d q = 0.5 * (joints_at(result.truth, i - 41) + joints_at(result.truth, i - 40));
    EXPECT_LT((seen - marker_at(s.robot, q)).norm(), 1e-12) << i;
  }
  EXPECT_EQ(frames, 49);  // of 51, the first two exposed before the record
}

TEST(Camera, ErrsAndDropsFramesAsItIsToldAndLeavesOtherNoiseAlone) {
  Scenario s = scenario(2, {.rate_hz = 500, .latency_s = 0, .noise_m = 1e-3, .dropout = 0.3});
  s.noise.motor_torque = {1e-3, 1e-3, 1e-3};
  const SimulationResult result = simulate(s);
  double frames = 0, squares = 0;
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    if (std::isnan(result.measured.marker[0][i])) continue;
    const Eigen::Vector3d seen(result.measured.marker[0][i], result.measured.marker[1][i],
                               result.measured.marker[2][i]);
    ++frames;
    squares += (seen - marker_at(s.robot, joints_at(result.truth, i))).squaredNorm();
  }
  EXPECT_NEAR(frames, 700, 4 * std::sqrt(1001 * 0.3 * 0.7));             // binomial, four deviations
  EXPECT_NEAR(squares / frames, 3e-6, 4 * 3e-6 * std::sqrt(2 / 2100.));  // χ² of 3 · 700
  s.camera.reset();
  EXPECT_EQ(simulate(s).measured.motor_position, result.measured.motor_position);
}

TEST(CameraFilter, RemovesTheBiasOfARatioThatMotorsCannotTell) {
  Scenario s = scenario(3, {});
  add_effect(s.robot, "capstan_ratio", 1, {1.03});
  const SimulationResult log = simulate(s);
  const auto seeing = make_camera_sr_ukf(raven2(), {}), blind = make_sr_ukf(raven2(), {});
  const Eigen::Vector3d with = errors(*seeing, log), without = errors(*blind, log);
  EXPECT_LT(with(1), 0.5 * without(1));
}

// Without frames motors alone have to tell the offsets, which they hardly do.
TEST(CameraFilter, SaysHowLittleItKnowsWhereNothingIsSeen) {
  const SimulationResult log = simulate(scenario(1.5, {}));
  const auto seeing = make_camera_sr_ukf(raven2(), {}), blind = make_camera_sr_ukf(raven2(), {});
  errors(*seeing, log);
  const Eigen::Vector3d error = errors(*blind, log, false);
  for (int k = 0; k < 3; ++k) {
    const double std = blind->estimate().joint_position_std(k);
    EXPECT_LT(error(k), std) << "joint " << k + 1;
    EXPECT_GT(std, 2 * seeing->estimate().joint_position_std(k)) << "joint " << k + 1;
  }
}

TEST(CameraFilter, TakesAFrameWhereItBelongs) {
  const SimulationResult log = simulate(scenario(2, {.rate_hz = 30, .latency_s = 0.1, .noise_m = 1e-5, .dropout = 0}));
  const EstimatorOptions late = {{"camera_latency", "0.1"}, {"camera_noise", "1e-5"}};
  const EstimatorOptions prompt = {{"camera_latency", "0"}, {"camera_noise", "1e-5"}};
  const auto right = make_camera_sr_ukf(raven2(), late), wrong = make_camera_sr_ukf(raven2(), prompt);
  const Eigen::Vector3d at_its_time = errors(*right, log), on_arrival = errors(*wrong, log);
  for (int k = 0; k < 3; ++k) EXPECT_LT(at_its_time(k), 0.02 * on_arrival(k)) << "joint " << k + 1;
}

// The first frames after a gap were exposed within it: back there the filter would have to predict over the gap.
TEST(CameraFilter, AFrameOfAGapDoesNotUndoTheNewStart) {
  const Camera camera{.rate_hz = 100, .latency_s = 0.1, .noise_m = 1e-4, .dropout = 0};
  const SimulationResult log = simulate(scenario(1.5, camera));
  const auto filter =
      make_camera_sr_ukf(raven2(), {{"camera_latency", "0.1"}, {"gate", "0.9999"}, {"restart_gap", "0.2"}});
  filter->reset(sample_of(log.measured, 0));
  for (std::size_t i = 1; i <= 1300; ++i)
    if (i < 700 || i >= 1200) filter->update(sample_of(log.measured, i));
  const Eigen::Vector3d error = filter->estimate().joint_position - joints_at(log.truth, 1300);
  EXPECT_LT(error.norm(), 5e-3);
}

/// Loses a root at every prediction.
class LosesRoots final : public SquareRootUkf {
 public:
  void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) override {
    SquareRootUkf::predict(process, Q_root);
    ++repaired_;
  }
};

TEST(CameraFilter, CountsARepairOnceHoweverOftenAStepIsTakenAnew) {
  // Each frame repeats the samples since its exposure.
  const Camera camera{.rate_hz = 100, .latency_s = 0.0205, .noise_m = 1e-4, .dropout = 0};
  const SimulationResult log = simulate(scenario(0.3, camera));
  const EstimatorOptions given = {{"camera_latency", "0.0205"}};
  OptionReader options("camera_sr_ukf", given);
  const CameraOptions seen = read_camera_options(options, raven2());
  const ArmModel model = with_unknown_offsets(raven2(), seen);
  const auto process = std::make_shared<const ProcessModel>(model);
  ArmFilterOptions of_filter = read_arm_filter_options(options, model, *process);
  of_filter.exponential = false;  // which cuts other steps too
  CameraFilter filter(model, process, of_filter, seen, std::make_unique<LosesRoots>());
  for (int again = 0; again < 2; ++again) {
    filter.reset(sample_of(log.measured, 0));
    long predictions = 0, frames = 0;
    for (std::size_t i = 1; i < log.measured.size(); ++i) {
      const Sample s = sample_of(log.measured, i);
      filter.update(s);
      ++predictions;
      if (s.marker.size() > 0 && s.time_s > 0.0205) ++frames;
    }
    EXPECT_GT(frames, 20);
    EXPECT_EQ(filter.report().steps, predictions);
    EXPECT_EQ(filter.report().repaired_factors, predictions);
  }
}

TEST(CameraFilter, WrongOptionsAreRefused) {
  const auto refusal = [](const EstimatorOptions& options) -> std::string {
    try {
      make_camera_sr_ukf(raven2(), options);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({{"camera_latency", "50 ms"}}),
            "estimator camera_sr_ukf: option camera_latency = '50 ms': expected a number from 0 to 10; correct it, or "
            "leave the option out");
  EXPECT_TRUE(refusal({{"camera", "1"}})
                  .starts_with("estimator camera_sr_ukf: unknown option 'camera'; known are camera_latency, "
                               "camera_noise, offset_start, "));
  EXPECT_EQ(refusal({{"camera_noise", "1e-3"}, {"offset_wander", "1e-3 1e-3 0"}}), "accepted");
}

}  // namespace
}  // namespace halyard
