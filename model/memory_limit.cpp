#include "model/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "model/input_error.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

std::string in_gigabytes(double bytes) { return with_digits(bytes / 1e9, 3) + " GB"; }

}  // namespace

double memory_limit_bytes() {
  double limit = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit address_space;
  if (::getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY)
    limit = std::min(limit, static_cast<double>(address_space.rlim_cur));
  // Version 2 and 1 of control groups, as a container sees its own. Without a limit, "max" or a huge number.
  for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double group = 0;
    if (std::ifstream(path) >> group && group > 0) limit = std::min(limit, group);
  }
  return limit;
}

void check_memory(double bytes, const std::string& where, const std::string& remedy) {
  if (const double limit = memory_limit_bytes(); bytes > limit)
    throw InputError(where + ": needs about " + in_gigabytes(bytes) + " of memory, and " + in_gigabytes(limit) +
                     " are there; " + remedy);
}

}  // namespace halyard
