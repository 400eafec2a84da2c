#pragma once
/// Where the running code is on disk: folders that hold what belongs to it are found from there.

#include <dlfcn.h>

#include <filesystem>

namespace halyard {

/// Folder of the running program; empty if it cannot be told.
inline std::filesystem::path program_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// Folder of the file that holds this function: one of halyard's libraries, or the program if they are linked into it.
/// Empty if it cannot be told.
template <class Result, class... Arguments>
std::filesystem::path folder_of_code(Result (*function)(Arguments...)) {
  Dl_info info;
  if (!dladdr(reinterpret_cast<void*>(function), &info) || !info.dli_fname) return {};
  return std::filesystem::absolute(info.dli_fname).parent_path();
}

}  // namespace halyard
