#pragma once
/// Text that may reach a terminal. Names and paths in it are the user's or come from files of others: they may hold
/// escape sequences, which a terminal obeys, and may be as long as a file.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace halyard {

/// The text with '?' for each control character (C0 but the line break, DEL, and C1: U+0080 to U+009F) and for each
/// byte that is not UTF-8.
std::string without_controls(std::string_view text);

/// One line that fits on a screen: without_controls(), blanks for line breaks, and at most kMostOfMessage bytes. Of a
/// longer text the middle is left out: the place is at the start and the remedy at the end.
std::string one_message(std::string_view text);
inline constexpr std::size_t kMostOfMessage = 1900;

/// Writes one_message() and a line break to stderr as far as that is possible: a terminal that is gone ends no work.
void tell(std::string_view text);

/// Writes without_controls() to stdout.
void write_out(std::string_view text);

template <class... Arguments>
void print_out(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_out(fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace halyard
