#pragma once
/// A shared module that is open as long as the object lives.

#include <filesystem>
#include <string>

namespace halyard {

class SharedModule {
 public:
  /// Loads the module and everything that it needs. Throws InputError `plugin PATH: what; remedy` for a path that is no
  /// complete ELF file, a module that cannot be loaded, and a module whose loading changes the floating-point mode of
  /// the process (linked with -ffast-math: numbers below 2e-308 become zero everywhere); the mode is restored.
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

/// Foreign text as one line: control characters become blanks, at most 500 bytes are kept.
std::string one_line(std::string text);

}  // namespace halyard
