#pragma once
/// What the fuzzers share. Each NAME_fuzz.cpp defines LLVMFuzzerTestOneInput() for one reader: libFuzzer's program
/// calls it with inputs that it makes up, the ordinary build's program (replay.cpp) with those of corpus/NAME.
///
/// A reader has to answer every input with a value or with an InputError of one line that fits on a screen. Anything
/// else is a finding: it ends the process, and libFuzzer keeps the input.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "model/input_error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace halyard::fuzzing {

[[noreturn]] inline void finding(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

inline void check_message(const std::string& message) {
  constexpr std::size_t kScreen = 25 * 80;  // characters
  if (message.size() > kScreen) finding("a message of " + std::to_string(message.size()) + " bytes: " + message);
  if (std::ranges::any_of(message, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    finding("a message with control characters: " + message);
}

/// Calls read(); true if it returned a value.
template <class Read>
bool reads(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    check_message(error.what());
  } catch (const std::exception& error) {
    finding(std::string("an exception that is no InputError: ") + error.what());
  }
  return false;
}

/// A folder of this process with copies of the files in beside/, for readers that want a path. It is the current folder
/// as long as the object lives, so that messages name files as they do for a user.
class WorkFolder {
 public:
  WorkFolder() {
    namespace fs = std::filesystem;
    std::string name = (fs::temp_directory_path() / "halyard-fuzz-XXXXXX").string();
    if (!::mkdtemp(name.data())) finding("no temporary folder: " + name);
    path_ = name;
    fs::copy(HALYARD_FUZZ_FOLDER "/beside", path_, fs::copy_options::recursive);
    fs::current_path(path_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  void write(const std::string& name, std::string_view text) const {
    std::ofstream file(name, std::ios::binary | std::ios::trunc);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  }

 private:
  std::filesystem::path path_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Gives the input to a reader of files beside those of beside/.
template <class Read>
void reads_file(const std::uint8_t* data, std::size_t size, const Read& read) {
  constexpr const char* kName = "input.xml";
  static const WorkFolder folder;
  folder.write(kName, text_of(data, size));
  reads([&] { read(kName); });
}

/// Takes the text up to the next '\n' off the front.
inline std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// Numbers from an input; zeros after its end.
class Bytes {
 public:
  Bytes() = default;
  Bytes(const std::uint8_t* data, std::size_t size) : left_(text_of(data, size)) {}

  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = static_cast<std::uint8_t>(left_.front());
    left_.remove_prefix(1);
    return first;
  }
  /// Any double, half of the time a tame one.
  double number() {
    if (byte() % 2 == 0) return (byte() - 128) / 16.0;
    double x = 0;
    for (std::size_t i = 0; i < sizeof x; ++i) reinterpret_cast<std::uint8_t*>(&x)[i] = byte();
    return x;
  }
  /// At most `longest` bytes, none of them zero.
  std::string text(std::size_t longest) {
    std::string text;
    for (std::uint8_t c = byte(); c != 0 && text.size() < longest; c = byte()) text += static_cast<char>(c);
    return text;
  }

 private:
  std::string_view left_;
};

}  // namespace halyard::fuzzing
