#pragma once
/// The parts of a line of text, and numbers in them.

#include <optional>
#include <string_view>
#include <vector>

namespace halyard {

/// `text` without blanks, tabs and ends of lines at either end.
std::string_view trim(std::string_view text);

/// Splits `line` at its commas and replaces `cells` by the trimmed parts. There is always at least one part.
void split(std::string_view line, std::vector<std::string_view>& cells);

/// Parses the whole of `text` as a finite decimal number. Returns nothing for any other text, such as "nan", "inf", an
/// empty text or a number beyond the range of double.
std::optional<double> parse_number(std::string_view text);

}  // namespace halyard
