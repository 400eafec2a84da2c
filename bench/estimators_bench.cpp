#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"
#include "estimators/built_in.h"
#include "estimators/filters/arm_filter.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/process/arm_models.h"

namespace halyard {
namespace {

using Make = std::unique_ptr<Estimator> (*)(const ArmModel&, const EstimatorOptions&);

/// Under a camera at 30 Hz.
void estimator_step(benchmark::State& state, Make make) {
  const ArmModel model = raven2();
  static const std::vector<Sample> samples = [&] {
    Scenario scenario = sines(model, 2);
    scenario.camera = Camera{};
    return samples_of(simulate(scenario).measured);
  }();
  const std::unique_ptr<Estimator> estimator = make(model, {});
  std::size_t next = samples.size();
  for (auto _ : state) {
    if (next == samples.size()) estimator->reset(samples[0]), next = 1;
    benchmark::DoNotOptimize(estimator->update(samples[next++]));
    while (estimator->revise(false)) {}
  }
}
BENCHMARK_CAPTURE(estimator_step, kinematics, &make_kinematics)->Name("EstimatorStep/kinematics");
BENCHMARK_CAPTURE(estimator_step, ekf, &make_ekf)->Name("EstimatorStep/ekf");
BENCHMARK_CAPTURE(estimator_step, sr_ukf, &make_sr_ukf)->Name("EstimatorStep/sr_ukf");
BENCHMARK_CAPTURE(estimator_step, disturbance_sr_ukf, &make_disturbance_sr_ukf)
    ->Name("EstimatorStep/disturbance_sr_ukf");
BENCHMARK_CAPTURE(estimator_step, camera_sr_ukf, &make_camera_sr_ukf)->Name("EstimatorStep/camera_sr_ukf");
BENCHMARK_CAPTURE(estimator_step, smoother, &make_smoother)->Name("EstimatorStep/smoother");

/// The process model's step, sigma points one by one in scalar code.
class OneByOne final : public ArmProcess {
 public:
  using ArmProcess::ArmProcess;
  void advance(Eigen::MatrixXd& X) const override {
    for (Eigen::Index c = 0; c < X.cols(); ++c) model_.advance(step_, X.col(c).data());
  }
};

/// Prediction and correction of the square-root UKF, the noise of the step given.
void sr_ukf_step(benchmark::State& state, bool in_lanes) {
  const ArmModel model = raven2();
  static const std::vector<Sample> samples = samples_of(simulate(sines(model, 2)).measured);
  const ProcessModel process(model);
  const EstimatorOptions none;
  OptionReader reader("sr_ukf", none);
  const ArmFilterOptions options = read_arm_filter_options(reader, model, process);
  ArmNoise noise(model, process, options.noise);
  const Eigen::VectorXd home = model.home();
  const Eigen::VectorXd start = process.state_at_rest(samples[0].motor_position, home);
  const Eigen::MatrixXd S = noise.initial_root(start, std::numeric_limits<double>::infinity());
  const Eigen::MatrixXd R_root = noise.encoder().asDiagonal();
  const Eigen::MatrixXd Q_root = noise.process_root({0, 1e-3}, start);
  SquareRootUkf filter;
  std::size_t next = samples.size();
  for (auto _ : state) {
    if (next == samples.size()) filter.reset(start, S), next = 1;
    const Step step{samples[next - 1].time_s, 1e-3, samples[next - 1].motor_torque.data()};
    if (in_lanes) filter.predict(ArmProcess(process, step), Q_root);
    else filter.predict(OneByOne(process, step), Q_root);
    filter.update(MotorReadings(process, 0, {0, 1, 2}), samples[next].motor_position, R_root, 1e9);
    benchmark::DoNotOptimize(filter.x());
    ++next;
  }
}
BENCHMARK_CAPTURE(sr_ukf_step, lanes, true)->Name("SrUkfStep/lanes");
BENCHMARK_CAPTURE(sr_ukf_step, scalar, false)->Name("SrUkfStep/scalar");

}  // namespace
}  // namespace halyard
