#pragma once
/// The characters of a text that should be UTF-8: names and paths in it are the user's or come from files of others.

#include <functional>
#include <string_view>

namespace halyard {

/// Calls visit(character, is_printable) for each character. Not printable are a control character (C0 but the line
/// break, DEL, and C1: U+0080 to U+009F) and a byte that is not UTF-8.
void for_each_character(std::string_view text, const std::function<void(std::string_view, bool)>& visit);

}  // namespace halyard
