#pragma once

#include <string>

namespace halyard {

/// Memory that this process may use, bytes: the least of the machine's memory, the limit of the address space
/// (ulimit -v) and the limit of the control group (containers, batch systems).
double memory_limit_bytes();

/// Throws InputError "WHERE: needs about 55 GB of memory, and 25 GB are there; REMEDY" if `bytes` exceeds the limit.
void check_memory(double bytes, const std::string& where, const std::string& remedy);

}  // namespace halyard
