#pragma once

#include <algorithm>
#include <string_view>

namespace halyard {

/// Whether a name can be used in lists and keys and is no path: at most 64 letters, digits, '_' and '-'.
inline bool is_plain_name(std::string_view name) {
  constexpr std::size_t kMaxLength = 64;
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kMaxLength && std::all_of(name.begin(), name.end(), is_plain);
}

}  // namespace halyard
