#pragma once
/// Words of shell commands that are printed or run.

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace halyard {

/// The text as one word of a shell command: as it is, if it needs no quotes, or 'in quotes'.
inline std::string in_shell_quotes(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || (c != '\0' && std::strchr("/._-+=:,%@", c) != nullptr);
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// " --effects m.so ..." for these modules; empty without any.
inline std::string effects_options(const std::vector<std::filesystem::path>& modules) {
  std::string options;
  for (const std::filesystem::path& module : modules) options += " --effects " + in_shell_quotes(module.string());
  return options;
}

}  // namespace halyard
