#include "model/machine/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "model/input_error.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

/// The smallest limit of a control group and those it is in; infinite without one, or with the word "max".
double limit_of_group(const fs::path& mount, fs::path group, const char* file) {
  double least = std::numeric_limits<double>::infinity();
  for (group = group.relative_path();; group = group.parent_path()) {
    double limit = 0;
    if (std::ifstream(mount / group / file) >> limit && limit > 0) least = std::min(least, limit);
    if (group.empty()) return least;
  }
}

/// Of the groups that this process is in: version 2 ("0::/path") and version 1 ("5:memory:/path"). A container sees its
/// own group as the root; a job of a batch system is in a group below it.
double limit_of_groups(const fs::path& root) {
  double least = std::numeric_limits<double>::infinity();
  const fs::path mount = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t kind = line.find(':'), path = line.find(':', kind + 1);
    if (path == line.npos) continue;
    const std::string controllers = line.substr(kind + 1, path - kind - 1);
    if (controllers.empty()) least = std::min(least, limit_of_group(mount, line.substr(path + 1), "memory.max"));
    else if (controllers == "memory")
      least = std::min(least, limit_of_group(mount / "memory", line.substr(path + 1), "memory.limit_in_bytes"));
  }
  return least;
}

std::string in_gigabytes(double bytes) { return with_digits(bytes / 1e9, 3) + " GB"; }

}  // namespace

double memory_limit_bytes(const fs::path& root) {
  double limit = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit address_space;
  if (::getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY)
    limit = std::min(limit, static_cast<double>(address_space.rlim_cur));
  return std::min(limit, limit_of_groups(root));
}

void check_memory(double bytes, const std::string& where, const std::string& remedy) {
  if (const double limit = memory_limit_bytes(); bytes > limit)
    throw InputError(where + ": needs about " + in_gigabytes(bytes) + " of memory, and " + in_gigabytes(limit) +
                     " are there; " + remedy);
}

}  // namespace halyard
