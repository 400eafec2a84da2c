#pragma once
/// The code that each lane_drive_<set>.cpp compiles for its instruction set. It is in an unnamed namespace, so that the
/// linker cannot use it for other files.

#include "diagnosis/motion/lane_drive.h"

namespace halyard {
namespace {

/// Calls f<n>() for arms of a few joints, where the compiler then unrolls the loops over joints, and f<0>() for others,
/// to save compile time. See joint_count().
template <class F>
void with_known_joints(int n, const F& f) {
  switch (n) {
    case 1: return f.template operator()<1>();
    case 2: return f.template operator()<2>();
    case 3: return f.template operator()<3>();
    default: return f.template operator()<0>();
  }
}

void drive_lanes(const Transmission<Lanes>& transmission, const DrivenInput* samples, std::size_t size, double start,
                 double dt, const RungeKuttaChebyshev& scheme, const CommandHistory* history, DrivenState<Lanes>& x,
                 Lanes* out, Lanes* states) {
  with_known_joints(transmission.arm().n, [&]<int known>() {
    drive_record<known>(transmission, samples, size, start, dt, scheme, history, x, out, states);
  });
}

void replay_lanes(const Transmission<Lanes>& transmission, const DrivenInput* samples, std::size_t size, double start,
                  double dt, const CommandHistory* history, const Lanes* states, Lanes* out) {
  with_known_joints(transmission.arm().n, [&]<int known>() {
    replay_record<known>(transmission, samples, size, start, dt, history, states, out);
  });
}

}  // namespace
}  // namespace halyard
