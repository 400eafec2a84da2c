#pragma once

#include <filesystem>

#include "model/output/descriptor.h"

namespace halyard {

/// Opens a file, made if it is missing, with the lock of the operating system on it (flock). The lock ends with the
/// descriptor, and with a process that is killed. Where the file system has no locks, the file is open without one.
/// False with errno EWOULDBLOCK if another holds the lock, and with another errno if the file cannot be opened.
Descriptor locked_file(const std::filesystem::path& path);

}  // namespace halyard
