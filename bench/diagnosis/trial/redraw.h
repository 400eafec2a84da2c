#pragma once
/// Draws again what could not be recorded, and keeps why.

#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace halyard::blind {

inline constexpr int kMostDraws = 40;

/// The first draw that does not throw std::runtime_error; nothing after kMostDraws. `dropped` gets the reason of each
/// draw before it.
template <class Draw>
std::optional<std::invoke_result_t<Draw>> first_possible(const Draw& draw, std::vector<std::string>& dropped) {
  for (int i = 0; i < kMostDraws; ++i) {
    try {
      return draw();
    } catch (const std::runtime_error& error) {
      dropped.push_back(error.what());
    }
  }
  return std::nullopt;
}

}  // namespace halyard::blind
