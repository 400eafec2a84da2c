#pragma once
/// A shared module that is open as long as the object lives.

#include <exception>
#include <filesystem>
#include <string>

#include "model/input_error.h"

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

/// What the module's exported function of this name returns. Throws InputError if it lets an exception out.
template <class Function>
auto called(Function function, const SharedModule& module, const std::string& name) {
  const std::string start = "plugin " + module.path().string() + ": " + name + "() lets an exception out";
  try {
    return function();
  } catch (const std::exception& error) {
    throw InputError(start + ": " + one_line(error.what()));
  } catch (...) {
    throw InputError(start);
  }
}

}  // namespace halyard
