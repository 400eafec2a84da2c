#pragma once

#include <ctime>

namespace halyard {

/// Processor time of this thread, s.
inline double thread_time_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace halyard
