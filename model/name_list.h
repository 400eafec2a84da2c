#pragma once
/// A user's texts in messages that have to fit on a screen.

#include <string>
#include <string_view>
#include <vector>

#include "model/input_error.h"

namespace halyard {

/// As in_quotes(), without the quotes: cut after 80 bytes, control characters replaced.
inline std::string shortened(std::string_view text) {
  const std::string quoted = in_quotes(text);
  return quoted.substr(1, quoted.size() - 2);
}

/// "a, b, c". Of a long list the first names, and how many are left out: "a, b and 250 more".
inline std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMostBytes = 1000;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0 && list.size() + names[i].size() > kMostBytes)
      return list + " and " + std::to_string(names.size() - i) + " more";
    list.append(i > 0 ? ", " : "").append(names[i]);
  }
  return list;
}

}  // namespace halyard
