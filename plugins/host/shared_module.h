#pragma once
/// A shared module that is open as long as the object lives.

#include <filesystem>
#include <string>

namespace halyard {

class SharedModule {
 public:
  /// Loads the module and everything that it needs. Throws InputError `plugin PATH: what; remedy` for a path that is no
  /// complete ELF file, a module that cannot be loaded, and one that changes the floating-point mode of the process
  /// when it is loaded (linked with -ffast-math: numbers below 2e-308 become zero everywhere); the mode is restored.
  explicit SharedModule(const std::filesystem::path& path);
  SharedModule(const SharedModule&) = delete;
  SharedModule& operator=(const SharedModule&) = delete;
  ~SharedModule();

  /// Address of an exported symbol; null if there is none.
  void* symbol(const char* name) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  void* handle_ = nullptr;
};

/// Foreign text on one line: control characters as blanks, at most 500 bytes.
std::string one_line(std::string text);

}  // namespace halyard
