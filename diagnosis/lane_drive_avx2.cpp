#include "diagnosis/lane_drive.h"

namespace halyard {
namespace {

void drive(const Transmission<Lanes>& transmission, const DrivenInput* samples, std::size_t size, double start, double dt,
           const Chebyshev& scheme, int stride, const CommandHistory* history, DrivenState<Lanes>& x, Lanes* out) {
  drive_record(transmission, samples, size, start, dt, scheme, stride, history, x, out);
}

}  // namespace

LaneDrive avx2_lane_drive() { return drive; }

}  // namespace halyard
