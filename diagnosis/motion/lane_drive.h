#pragma once
/// drive_record and replay_record over lanes, compiled once per instruction set.

#include <vector>

#include "diagnosis/motion/motion_kernel.h"

namespace halyard {

struct LaneDrive {
  void (*drive)(const Transmission<Lanes>&, const DrivenInput*, std::size_t size, double start, double dt,
                const RungeKuttaChebyshev& scheme, const CommandHistory*, DrivenState<Lanes>&, Lanes* out,
                Lanes* states);
  void (*replay)(const Transmission<Lanes>&, const DrivenInput*, std::size_t size, double start, double dt,
                 const CommandHistory*, const Lanes* states, Lanes* out);
};

/// The kernels that this processor can run, the widest first; the last is the generic one.
const std::vector<LaneDrive>& lane_drives();

}  // namespace halyard
