#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace halyard {

/// What a user can get wrong: a file, an option, a number in one of them. The program prints what() on one line and
/// exits with code 2. The message says where, what, what was expected and the remedy:
///
///   log.csv:12: column 'motor_torque_1': 'abc' is not a number; write a decimal number, or leave the cell empty
///
/// A mistake of the calling code is no InputError: that is std::invalid_argument or std::out_of_range.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A user's text in quotes for a message of one line: cut after 80 bytes, control characters as '?'.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 80;
  std::string shown(text.substr(0, kMaxLength));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return "'" + shown + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace halyard
