#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace halyard {

/// The operating system's words for an error number (errno).
inline std::string reason(int error_number) { return std::generic_category().message(error_number); }

/// An open file of the operating system, closed at the end of the object's life.
class Descriptor {
 public:
  Descriptor() = default;
  /// Flags are those of open(2); errno says why it failed. Programs that this one starts do not inherit the file.
  Descriptor(const std::filesystem::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  explicit operator bool() const { return number_ >= 0; }
  int operator*() const { return number_; }
  /// False if it failed: some file systems report a full disk only now.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_ = -1;
};

}  // namespace halyard
