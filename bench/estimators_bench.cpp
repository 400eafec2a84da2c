#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"
#include "estimators/built_in.h"

namespace halyard {
namespace {

std::vector<Sample> samples_of(const Log& log) {
  std::vector<Sample> samples(log.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    samples[i].time_s = log.time[i];
    samples[i].motor_torque.resize(log.n_joints);
    samples[i].motor_position.resize(log.n_joints);
    for (int k = 0; k < log.n_joints; ++k) {
      samples[i].motor_torque(k) = log.motor_torque[k][i];
      samples[i].motor_position(k) = log.motor_position[k][i];
    }
  }
  return samples;
}

using Make = std::unique_ptr<Estimator> (*)(const ArmModel&, const EstimatorOptions&);

void estimator_step(benchmark::State& state, Make make) {
  const ArmModel model = raven2();
  static const std::vector<Sample> samples = samples_of(simulate(sines(model, 2)).measured);
  const std::unique_ptr<Estimator> estimator = make(model, {});
  std::size_t next = samples.size();
  for (auto _ : state) {
    if (next == samples.size()) estimator->reset(samples[0]), next = 1;
    benchmark::DoNotOptimize(estimator->update(samples[next++]));
  }
}
BENCHMARK_CAPTURE(estimator_step, kinematics, &make_kinematics)->Name("EstimatorStep/kinematics");
BENCHMARK_CAPTURE(estimator_step, ekf, &make_ekf)->Name("EstimatorStep/ekf");
BENCHMARK_CAPTURE(estimator_step, sr_ukf, &make_sr_ukf)->Name("EstimatorStep/sr_ukf");

}  // namespace
}  // namespace halyard
