/// The kernels of lane_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: a part of exactly one lanes_<set>.cpp each.

#include "estimators/lane_kernels.h"

namespace halyard {
namespace {

void advance_lanes(const Transmission<Lanes>& transmission, const StateLayout& layout, double time, double dt,
                   int substeps, const CommandHistory* history, const Lanes* command, const Lanes* external,
                   Lanes* x) {
  const double h = dt / substeps;
  for (int i = 0; i < substeps; ++i)
    runge_kutta_4(transmission, layout, time + i * h, h, history, command, external, x);
}

}  // namespace
}  // namespace halyard
