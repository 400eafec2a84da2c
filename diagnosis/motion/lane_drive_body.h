#pragma once
/// The code that each lane_drive_<set>.cpp compiles for its instruction set. It is in an unnamed namespace, so that the
/// linker cannot use it for other files.

#include "diagnosis/motion/lane_drive.h"

namespace halyard {
namespace {

void drive_lanes(const Transmission<Lanes>& transmission, const DrivenInput* samples, std::size_t size, double start,
                 double dt, const Chebyshev& scheme, const CommandHistory* history, DrivenState<Lanes>& x, Lanes* out,
                 Lanes* states) {
  drive_record(transmission, samples, size, start, dt, scheme, history, x, out, states);
}

void replay_lanes(const Transmission<Lanes>& transmission, const DrivenInput* samples, std::size_t size, double start,
                  double dt, const CommandHistory* history, const Lanes* states, Lanes* out) {
  replay_record(transmission, samples, size, start, dt, history, states, out);
}

}  // namespace
}  // namespace halyard
