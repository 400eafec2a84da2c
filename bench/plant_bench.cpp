#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"

namespace halyard {
namespace {

void simulate_one_second(benchmark::State& state) {
  const Scenario scenario = sines(raven2(), 1);
  for (auto _ : state) {
    const SimulationResult result = simulate(scenario);
    benchmark::DoNotOptimize(result.energy.input);
    state.counters["derivatives"] = static_cast<double>(result.derivative_evaluations);
  }
}
BENCHMARK(simulate_one_second)->Name("Simulate")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halyard
