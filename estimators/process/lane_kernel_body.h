/// The kernels of lane_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each lanes_<set>.cpp includes it exactly once.

#include "estimators/process/lane_kernels.h"

namespace halyard {
namespace {

template <class T>
void advance(const Transmission<T>& transmission, const StateLayout& layout, double time, double dt, int substeps,
             const CommandHistory* history, const T* command, const T* external, T* x) {
  const double h = dt / substeps;
  for (int i = 0; i < substeps; ++i)
    runge_kutta_4(transmission, layout, time + i * h, h, history, command, external, x);
}

// Local to each set. state_derivative() is inline: the linker keeps one copy for all sets, and its address would lead
// to that copy.
void derivative(const Transmission<Dual>& transmission, const StateLayout& layout, double time,
                const CommandHistory* history, const Dual* command, const Dual* external, const Dual* x, Dual* x_dot) {
  state_derivative(transmission, layout, time, history, command, external, x, x_dot);
}

constexpr LaneKernels kernels_named(const char* name) { return {name, advance<Lanes>, advance<Dual>, derivative}; }

}  // namespace
}  // namespace halyard
