#pragma once

#include <filesystem>
#include <string>

namespace halyard {

/// Memory that this process may use, bytes: the least of the machine's memory, the limit of the address space
/// (ulimit -v) and the limits of the control group and those it is in (containers, batch systems). root: where the
/// system's files of control groups lie.
double memory_limit_bytes(const std::filesystem::path& root = "/");

/// Throws InputError "WHERE: needs about 55 GB of memory, and 25 GB are there; REMEDY" if `bytes` exceeds the limit.
void check_memory(double bytes, const std::string& where, const std::string& remedy);

}  // namespace halyard
