#include <benchmark/benchmark.h>

#include "bench/bench_arm.h"
#include "estimators/process/process_model.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

template <class T>
const Transmission<T>& transmission_of(const ProcessModel& process) {
  if constexpr (std::is_same_v<T, Dual>) return process.dual_transmission();
  else if constexpr (std::is_same_v<T, Lanes>) return process.lane_transmission();
  else return process.transmission();
}

/// Compiled for the instruction set that every machine has.
template <class T>
void state_derivative_of(benchmark::State& state) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Transmission<T>& transmission = transmission_of<T>(process);
  const Eigen::VectorXd home = model.home();
  const Eigen::VectorXd rest = process.state_at_rest(unstretched_motors(process.arm(), home), home);
  T x[kMaxStates], x_dot[kMaxStates], command[kMaxJoints], external[kMaxJoints];
  for (int i = 0; i < process.n_states(); ++i) x[i] = rest(i) + 1e-4;
  for (int k = 0; k < kMaxJoints; ++k) command[k] = 0.01, external[k] = 0.0;
  for (auto _ : state) {
    state_derivative(transmission, process.layout(), 0, nullptr, command, external, x, x_dot);
    benchmark::DoNotOptimize(x_dot);
    benchmark::ClobberMemory();
  }
}
BENCHMARK_TEMPLATE(state_derivative_of, double)->Name("StateDerivative/double");
BENCHMARK_TEMPLATE(state_derivative_of, Dual)->Name("StateDerivative/Dual");
BENCHMARK_TEMPLATE(state_derivative_of, Lanes)->Name("StateDerivative/Lanes");

/// The same over lanes as the filters run it: a step of 1 ms of eight states, by the widest kernel that there is.
void lane_step(benchmark::State& state) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const Eigen::VectorXd home = model.home();
  const Eigen::VectorXd rest = process.state_at_rest(unstretched_motors(process.arm(), home), home);
  const Eigen::MatrixXd start = rest.replicate(1, kLaneWidth);
  const Eigen::VectorXd torque = Eigen::VectorXd::Constant(model.n(), 0.01);
  const Step step{0, 1e-3, torque.data(), nullptr, nullptr};
  Eigen::MatrixXd X = start;
  for (auto _ : state) {
    X = start;
    process.advance_many(step, X);
    benchmark::DoNotOptimize(X.data());
  }
  state.SetLabel(std::string(lane_kernels()[0].name) + ", " + std::to_string(process.substeps(1e-3)) + " sub-steps");
}
BENCHMARK(lane_step)->Name("EightStatesOneMillisecond")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace halyard
