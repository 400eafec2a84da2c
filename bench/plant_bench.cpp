#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"

namespace halyard {
namespace {

void simulate_one_second(benchmark::State& state, Engine engine) {
  Scenario scenario = sines(raven2(), 1);
  scenario.engine = engine;
  for (auto _ : state) {
    const SimulationResult result = simulate(scenario);
    benchmark::DoNotOptimize(result.energy.input);
    state.counters["derivatives"] = static_cast<double>(result.derivative_evaluations);
  }
}
BENCHMARK_CAPTURE(simulate_one_second, simbody, Engine::simbody)
    ->Name("Simulate/simbody")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate_one_second, halyard, Engine::halyard)
    ->Name("Simulate/halyard")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halyard
