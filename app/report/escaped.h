#pragma once

#include <string>
#include <string_view>

namespace halyard::report {

/// The text for HTML and SVG: & < > " ' as entities; U+FFFD for each control character but the line break, and for each
/// byte that is not UTF-8, which a reader of SVG would refuse.
std::string escaped(std::string_view text);

}  // namespace halyard::report
