#pragma once
/// Location of the running code on disk, from which halyard finds the folders that belong to it.

#include <dlfcn.h>

#include <filesystem>

namespace halyard {

/// Folder of the running program; empty if it is unknown.
inline std::filesystem::path program_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// Folder of the file that holds this function: one of halyard's libraries, or the program if they are linked into it.
/// Empty if it is unknown.
template <class Result, class... Arguments>
std::filesystem::path folder_of_code(Result (*function)(Arguments...)) {
  Dl_info info;
  if (!dladdr(reinterpret_cast<void*>(function), &info) || !info.dli_fname) return {};
  return std::filesystem::absolute(info.dli_fname).parent_path();
}

}  // namespace halyard
