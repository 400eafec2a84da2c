#pragma once
/// drive_record and replay_record over lanes, compiled once per instruction set. The widest set that the processor
/// supports is chosen at run time.

#include "diagnosis/motion/motion_kernel.h"

namespace halyard {

struct LaneDrive {
  void (*drive)(const Transmission<Lanes>&, const DrivenInput*, std::size_t size, double start, double dt,
                const Chebyshev& scheme, const CommandHistory*, DrivenState<Lanes>&, Lanes* out, Lanes* states);
  void (*replay)(const Transmission<Lanes>&, const DrivenInput*, std::size_t size, double start, double dt,
                 const CommandHistory*, const Lanes* states, Lanes* out);
};

LaneDrive generic_lane_drive();
#if defined(__x86_64__)
LaneDrive avx2_lane_drive();
LaneDrive avx512_lane_drive();
#endif

}  // namespace halyard
