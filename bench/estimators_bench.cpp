#include <benchmark/benchmark.h>

#include <memory>

#include "bench/bench_arm.h"
#include "estimators/built_in.h"

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

}  // namespace
}  // namespace halyard
