#pragma once

#include <algorithm>
#include <string_view>

namespace halyard {

/// A name that can stand in a list of names and in a key, and is no path: letters, digits, '_' and '-', at most 64.
inline bool is_plain_name(std::string_view name) {
  constexpr std::size_t kMaxLength = 64;
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kMaxLength && std::all_of(name.begin(), name.end(), is_plain);
}

}  // namespace halyard
