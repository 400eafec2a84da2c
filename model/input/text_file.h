#pragma once
/// Reads the files that users give, and those that a command wrote before.

#include <filesystem>
#include <string>

namespace halyard {

/// The words in which a file that cannot be read is refused.
struct TextFileKind {
  const char* name;          ///< "a CSV log"
  const char* if_too_large;  ///< remedy: "cut the log into shorter ones"
  bool is_input = true;      ///< a command does not replace it by its outputs; false: a command's own earlier output
};

/// The whole file, to its last byte. Throws InputError `PATH: what; remedy` for a file that is missing, a directory,
/// not readable to its end, or too large for this machine's memory.
std::string read_text_file(const std::filesystem::path& path, const TextFileKind& kind);

}  // namespace halyard
