#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace halyard {

/// An error in the user's input: a file, an option, a number in one of them. The program prints what() on one line and
/// exits with code 2. The message states the place, the error, what was expected, and the remedy:
///
///   log.csv:12: column 'motor_torque_1': 'abc' is not a number; write a decimal number, or leave the cell empty
///
/// A mistake in the calling code throws std::invalid_argument or std::out_of_range instead.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Quotes a user's text for a one-line message: cut after 80 bytes, control characters replaced by '?'.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 80;
  std::string shown(text.substr(0, kMaxLength));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return "'" + shown + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace halyard
